// Comparisons for constant expressions.
#pragma once

#include "ao/math.hpp"

#include <limits>

namespace static_test {

template <class Real>
inline constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

template <class Real>
constexpr bool near(Real a, Real b, Real most)
{
    return a - b <= most && b - a <= most;
}

template <class Vec>
constexpr bool equal(const Vec& a, const Vec& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

template <class Vec, class Real>
constexpr bool near(const Vec& a, const Vec& b, Real most)
{
    return near<Real>(a.x, b.x, most) && near<Real>(a.y, b.y, most) && near<Real>(a.z, b.z, most);
}

// Largest deviation of a frame from orthonormal and right-handed; NaN counts as infinite.
template <class Real>
constexpr Real frame_error(const typename ao::math<Real>::ao_frame& f)
{
    const auto dot = [](const auto& a, const auto& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const auto& t = f.tangent;
    const auto& b = f.bitangent;
    const auto& n = f.normal;
    const Real handed = n.x * (t.y * b.z - t.z * b.y) + n.y * (t.z * b.x - t.x * b.z) + n.z * (t.x * b.y - t.y * b.x);
    Real worst = 0;
    for (const Real e : { dot(t, t) - 1, dot(b, b) - 1, dot(n, n) - 1, dot(t, b), dot(t, n), dot(b, n), handed - 1 }) {
        const Real size = e < 0 ? -e : e;
        worst =
            size <= worst ? worst : (size < std::numeric_limits<Real>::infinity() ? size : std::numeric_limits<Real>::infinity());
    }
    return worst;
}

} // namespace static_test
