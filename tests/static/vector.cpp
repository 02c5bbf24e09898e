// Vector functions as constant expressions. NaN and infinity are no results of those: tests/unit/core_frame.cpp.
#include "static/support.hpp"

#include <bit>

namespace {

using namespace static_test;

template <class Real>
struct suite {
    using m = ao::math<Real>;
    using vec3 = typename m::vec3;
    static constexpr Real inf = std::numeric_limits<Real>::infinity();
    static constexpr vec3 spare{ Real(7), Real(8), Real(9) };
    static constexpr vec3 normalized(Real x, Real y, Real z) { return m::ao_normalize_or(vec3(x, y, z), spare); }

    static_assert(m::ao_dot(vec3(1, 2, 3), vec3(4, 5, 6)) == 32);
    static_assert(m::ao_dot(vec3(1, 2, 3), vec3(-4, 5, -2)) == 0);
    static_assert(equal(m::ao_cross(vec3(1, 0, 0), vec3(0, 1, 0)), vec3(0, 0, 1)));
    static_assert(equal(m::ao_cross(vec3(1, 2, 3), vec3(4, 5, 6)), vec3(-3, 6, -3)));
    static_assert(equal(m::ao_cross(vec3(1, 2, 3), vec3(2, 4, 6)), vec3(0, 0, 0)));
    static_assert(equal(m::ao_select(vec3(1, 2, 3), spare, true), spare));
    static_assert(equal(m::ao_select(vec3(1, 2, 3), spare, false), vec3(1, 2, 3)));

    static_assert(equal(normalized(0, 0, -5), vec3(0, 0, -1)));
    static_assert(near(normalized(3, 0, 4), vec3(Real(0.6), 0, Real(0.8)), epsilon<Real>));
    static_assert(near(normalized(Real(1e-14), 0, 0), vec3(1, 0, 0), epsilon<Real>));
    static_assert(near(normalized(Real(9e14), 0, 0), vec3(1, 0, 0), epsilon<Real>));
    static_assert(equal(normalized(0, 0, 0), spare));
    static_assert(equal(normalized(Real(1e-30), 0, 0), spare));
    static_assert(equal(normalized(Real(1e18), 0, 0), spare));

    // Rows, not columns.
    static constexpr typename m::ao_rotation turn{ 0, 1, 0, 99, 0, 0, 1, 99, 1, 0, 0, 99 };
    static_assert(equal(m::ao_rotate(turn, vec3(1, 2, 3)), vec3(2, 3, 1)));

    static_assert(m::sqrt(Real(2)) * m::sqrt(Real(2)) - 2 <= 4 * epsilon<Real> && m::sqrt(Real(1.5625)) == Real(1.25));
    static_assert(m::sqrt(Real(0)) == 0 && m::sqrt(inf) == inf);
    static_assert(m::floor(Real(-0.5)) == -1 && m::floor(Real(2.75)) == 2 && m::floor(Real(-3)) == -3 &&
                  m::floor(Real(1e20)) == Real(1e20));
    // The sign of -0 survives, as it does at run time.
    using bits = std::array<unsigned char, sizeof(Real)>;
    static_assert(std::bit_cast<bits>(m::floor(-Real(0))) == std::bit_cast<bits>(-Real(0)));
    static_assert(m::abs(Real(-2)) == 2 && m::abs(Real(2)) == 2);
    static_assert(m::min(Real(1), Real(2)) == 1 && m::max(Real(1), Real(2)) == 2);
    static_assert(m::mix(Real(1), Real(2), true) == 2 && m::mix(Real(1), Real(2), false) == 1);
};

template struct suite<float>;
template struct suite<double>;

} // namespace
