// Real spherical harmonics up to order 8: orthonormal over the unit sphere (the integral of Y_lm^2 over all directions is 1,
// Y_00 = 0.2821), without the Condon-Shortley sign: Y_1-1, Y_10 and Y_11 are 0.4886 times y, z and x. m > 0 goes with the cosine
// of m times the azimuth, m < 0 with the sine of |m| times it. Coefficients in the order (0 0), (1 -1), (1 0), (1 1), (2 -2) ...
#pragma once

#include "ao/detail/elementary.hpp"
#include "ao/math.hpp"
#include "ao/rotation.hpp"

#include <array>
#include <cassert>
#include <cstddef>

#include "ao/detail/shared_begin.inc"

namespace ao {

template <class Real>
struct harmonic_math {
#include "ao/detail/scope.inc"
#include "ao/shared/harmonics.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"

namespace ao {

inline constexpr int max_harmonic_order = 8;
inline constexpr std::size_t max_harmonics = (max_harmonic_order + 1) * (max_harmonic_order + 1);

// Precondition: 0 <= l, |m| <= l.
constexpr std::size_t harmonic_index(int l, int m)
{
    const int index = l * (l + 1) + m;
    return static_cast<std::size_t>(index);
}

constexpr std::size_t harmonic_count(int order)
{
    return harmonic_index(order, order) + 1;
}

// Factors g_lm of the recurrence and N_lm of ao/shared/harmonics.h.
struct harmonic_factors {
    std::array<double, max_harmonics> step{};
    std::array<double, max_harmonics> norm{};
};

// Of R_l+1,m = z R_lm - g R_l-1,m: the quotient of the squared norms of two successive monic polynomials, so N_lm^2 = N_l-1,m^2 /
// g.
constexpr double harmonic_step(int l, int m)
{
    return static_cast<double>(l * l - m * m) / static_cast<double>(4 * l * l - 1);
}

namespace detail {

constexpr harmonic_factors make_harmonic_factors()
{
    harmonic_factors factors;
    double sectoral = 1 / (4 * pi); // N_mm^2
    for (int m = 0; m <= max_harmonic_order; ++m) {
        double squared = sectoral;
        for (int l = m; l <= max_harmonic_order; ++l) {
            const double g = harmonic_step(l, m);
            squared /= l > m ? g : 1;
            factors.step[harmonic_index(l, m)] = factors.step[harmonic_index(l, -m)] = g;
            factors.norm[harmonic_index(l, m)] = factors.norm[harmonic_index(l, -m)] = detail::sqrt(squared);
        }
        sectoral *= (2.0 * m + 3) / (2.0 * m + 2) * (m == 0 ? 2 : 1);
    }
    return factors;
}

} // namespace detail

inline constexpr harmonic_factors harmonic_table = detail::make_harmonic_factors();

// Y_lm(d) for l <= order, then zeros. Precondition: d is of unit length; 0 <= order <= 8.
constexpr std::array<double, max_harmonics> harmonics(const direction3& d, int order = max_harmonic_order)
{
    assert(order >= 0 && order <= max_harmonic_order);
    using reals = harmonic_math<double>;
    std::array<double, max_harmonics> values{};
    double c = 1;
    double s = 0;
    for (int m = 0; m <= order; ++m) {
        double before = 0;
        double here = 1;
        for (int l = m; l <= order; ++l) {
            const std::size_t even = harmonic_index(l, m);
            values[harmonic_index(l, -m)] = harmonic_table.norm[even] * here * s;
            values[even] = harmonic_table.norm[even] * here * c;
            const double next = reals::ao_harmonic_next(d[2], here, before, harmonic_table.step[even]);
            before = here;
            here = next;
        }
        const double turned = reals::ao_azimuth_real(c, s, d[0], d[1]);
        s = reals::ao_azimuth_imaginary(c, s, d[0], d[1]);
        c = turned;
    }
    return values;
}

// Half the integral over t = 0 ... 1 of (2 a + 2) t^a P_l(t): by how much a coefficient of degree l is weakened when light is
// averaged by Phong's lobe (2 a + 2) (x . r)+^a about a direction r, the mean over the sphere of which is 1. a = 1 is the diffuse
// lobe 4 (n . x)+: 1, 2/3, 1/4, 0, -1/24 ... In paper 3's terms (2 l + 1)^-1/2 rho_l0. From the recurrence of Legendre
// polynomials, integrated by parts: k_l = k_l-2 (a - l + 2) / (a + l + 1). Precondition: a >= 0.
constexpr double lobe_factor(double a, int l)
{
    double factor = l % 2 == 0 ? 1 : (a + 1) / (a + 2);
    for (int k = 2 + l % 2; k <= l; k += 2) {
        factor *= (a - k + 2) / (a + k + 1);
    }
    return factor;
}

} // namespace ao
