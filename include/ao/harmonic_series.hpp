// Functions on the sphere as coefficients of real spherical harmonics (ao/harmonics.hpp): projection, rotation, averaging by a
// lobe.
#pragma once

#include "ao/detail/elementary.hpp"
#include "ao/harmonics.hpp"
#include "ao/sphere_rule.hpp"

#include <array>
#include <cassert>
#include <cstddef>

namespace ao {

// A function on the sphere as coefficients: their sum times Y_lm. Value: double, or glm::dvec3 for RGB.
template <class Value>
struct harmonic_series {
    int order = 0;
    std::array<Value, max_harmonics> coefficients{};

    constexpr Value operator()(const direction3& d) const
    {
        const std::array<double, max_harmonics> values = harmonics(d, order);
        Value sum(0);
        for (std::size_t i = 0; i < harmonic_count(order); ++i) {
            sum += coefficients[i] * values[i];
        }
        return sum;
    }
};

// Coefficients up to `order` of f(direction3), by a rule over the sphere: exact if f has no harmonics above rule.order - order,
// else as good as the rule is for f times a harmonic. Preconditions: rule.domain is the sphere; 0 <= order <= 8.
template <class Value, class Function>
harmonic_series<Value> project(const sphere_rule& rule, int order, const Function& f)
{
    assert(rule.domain == rule_domain::sphere);
    harmonic_series<Value> series{ .order = order, .coefficients = {} };
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const std::array<double, max_harmonics> values = harmonics(rule.directions[i], order);
        const Value scaled = Value(f(rule.directions[i])) * (4 * detail::pi * rule.weights[i]);
        for (std::size_t k = 0; k < harmonic_count(order); ++k) {
            series.coefficients[k] += scaled * values[k];
        }
    }
    return series;
}

// The function turned with the rotation: rotated(r, f)(d) = f(inverse(r) d). By projection with a rule that is exact for products
// of two harmonics of the order, so exact to about 1e-14 of the largest coefficient.
template <class Value>
harmonic_series<Value> rotated(const rotation3& rotation, const harmonic_series<Value>& series)
{
    // The least rule of order 2 l or more with positive weights: that of order 13 has negative ones, order 1 does not exist.
    const int exact = series.order == 6 ? 15 : series.order == 0 ? 3 : 2 * series.order + 1;
    const rotation3 back = inverse(rotation);
    return project<Value>(*lebedev_rule(exact), series.order, [&](const direction3& d) { return series(rotated(back, d)); });
}

// Light by the direction about which it is averaged by Phong's lobe of exponent a: B~ of paper 3, by PRT. For a = 1 the direction
// is the normal and the result is irradiance / pi; else the direction is the eye's, mirrored at the normal.
template <class Value>
constexpr harmonic_series<Value> averaged(const harmonic_series<Value>& light, double a)
{
    harmonic_series<Value> result = light;
    for (int l = 0; l <= light.order; ++l) {
        for (int m = -l; m <= l; ++m) {
            result.coefficients[harmonic_index(l, m)] *= lobe_factor(a, l);
        }
    }
    return result;
}

} // namespace ao
