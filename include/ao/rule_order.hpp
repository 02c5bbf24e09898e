// How many spherical harmonics a rule integrates exactly, for rules that do not say so.
#pragma once

#include "ao/harmonics.hpp"
#include "ao/sphere_rule.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ao {

namespace detail {

// Sums over the rule of weight times harmonics up to degree `top`, scaled to mean square 1. The largest one of each degree, less
// 1 for degree 0.
inline std::vector<double> largest_harmonic_sums(const sphere_rule& rule, int top)
{
    using reals = harmonic_math<double>;
    const auto width = static_cast<std::size_t>(top) + 1;
    std::vector<double> even(width * width);
    std::vector<double> odd(width * width);
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const direction3& d = rule.directions[i];
        double c = rule.weights[i];
        double s = 0;
        for (int m = 0; m <= top; ++m) {
            double before = 0;
            double here = 1;
            for (int l = m; l <= top; ++l) {
                const std::size_t at = static_cast<std::size_t>(m) * width + static_cast<std::size_t>(l);
                even[at] += here * c;
                odd[at] += here * s;
                const double next = reals::ao_harmonic_next(d[2], here, before, harmonic_step(l, m));
                before = here;
                here = next;
            }
            const double turned = reals::ao_azimuth_real(c, s, d[0], d[1]);
            s = reals::ao_azimuth_imaginary(c, s, d[0], d[1]);
            c = turned;
        }
    }
    std::vector<double> largest(width);
    double sectoral = 1;
    for (int m = 0; m <= top; ++m) {
        double squared = sectoral;
        for (int l = m; l <= top; ++l) {
            const std::size_t at = static_cast<std::size_t>(m) * width + static_cast<std::size_t>(l);
            squared /= l > m ? harmonic_step(l, m) : 1;
            const double norm = std::sqrt(squared);
            double& most = largest[static_cast<std::size_t>(l)];
            most = std::fmax(most, std::abs(even[at] * norm - (l == 0 ? 1 : 0)));
            most = std::fmax(most, std::abs(odd[at] * norm));
        }
        sectoral *= (2.0 * m + 3) / (2.0 * m + 2) * (m == 0 ? 2 : 1);
    }
    return largest;
}

} // namespace detail

// The largest order up to `highest` such that all harmonics up to it, scaled to mean square 1, are integrated to `tolerance`; -1:
// not even a constant. Time grows with the points times the square of the order, 0.3 s for Lebedev's largest rule. Preconditions:
// the rule's domain is the sphere; 0 <= highest <= 200.
inline int exact_order(const sphere_rule& rule, int highest = 131, double tolerance = 1e-12)
{
    assert(rule.domain == rule_domain::sphere && highest >= 0 && highest <= 200);
    for (int top = highest < 7 ? highest : 7;; top = 5 * top < highest ? 5 * top : highest) {
        const std::vector<double> largest = detail::largest_harmonic_sums(rule, top);
        for (int l = 0; l <= top; ++l) {
            if (!(largest[static_cast<std::size_t>(l)] <= tolerance)) {
                return l - 1;
            }
        }
        if (top == highest) {
            return highest;
        }
    }
}

} // namespace ao
