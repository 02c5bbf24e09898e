// Cubature rules on the unit sphere: directions and weights by whose weighted mean an integral over the sphere, in the measure
// whose total is 1, is approximated (paper 3). Made once on the host, in double.
#pragma once

#include "ao/detail/text.hpp"
#include "ao/kernel.hpp"
#include "ao/lebedev.hpp"
#include "ao/math.hpp"
#include "ao/result.hpp"
#include "ao/rotation.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ao {

// What a rule's weights integrate over. Directions of all but the first are about +z, all with z > 0, and are turned to each
// normal (rotation_to); they are never antipodal.
enum class rule_domain {
    sphere,
    hemisphere,        // uniformly
    cosine_hemisphere, // by z / pi
    lobe,              // by a power of z about a mirror direction, for light only (ao/lobe_rule.hpp)
};

// Directions are of unit length to 1e-15. `antipodal`: directions[2 i + 1] is exactly -directions[2 i], of the same weight.
// `order`: all spherical harmonics up to it are integrated exactly; -1: not even that is known. `random`: drawn independently of
// each other, so that errors fall with N^-1/2 and are estimated by that law.
struct sphere_rule {
    std::vector<direction3> directions;
    std::vector<double> weights; // sum to 1 but for rounding
    bool antipodal = false;
    int order = -1;
    rule_domain domain = rule_domain::sphere;
    bool random = false;

    std::size_t size() const { return directions.size(); }
};

inline constexpr int max_rule_points = 1 << 22;

// Antipodes stay exact.
inline void rotate(sphere_rule& rule, const rotation3& rotation)
{
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const direction3& before = rule.directions[i & ~std::size_t{ 1 }];
        rule.directions[i] = rule.antipodal && i % 2 == 1 ? direction3{ -before[0], -before[1], -before[2] }
                                                          : rotated(rotation, rule.directions[i]);
    }
}

namespace detail {

inline ao::error unknown_lebedev(int wanted)
{
    // Orders are odd, numbers of points even.
    const auto measure = [&](const lebedev_design& d) { return wanted % 2 == 0 ? d.points : d.order; };
    const lebedev_design* below = nullptr;
    const lebedev_design* above = nullptr;
    for (const lebedev_design& design : lebedev_designs) {
        if (measure(design) < wanted) {
            below = &design;
        }
        else if (above == nullptr) {
            above = &design;
        }
    }
    reason text("there is no Lebedev rule of ", wanted % 2 == 0 ? "" : "order ", wanted, wanted % 2 == 0 ? " points" : "",
                "; nearest:");
    for (const lebedev_design* design : { below, above }) {
        if (design != nullptr) {
            text.append(below != nullptr && design == above ? " or order " : " order ");
            text.append(design->order);
            text.append(", ");
            text.append(design->points);
            text.append(" points");
        }
    }
    return { errc::invalid_settings, text };
}

inline void append_pair(sphere_rule& rule, const direction3& d, double weight)
{
    rule.directions.push_back(d);
    rule.directions.push_back({ -d[0], -d[1], -d[2] });
    rule.weights.insert(rule.weights.end(), 2, weight);
}

inline bool countable(int count)
{
    return count >= 1 && count <= max_rule_points;
}

inline ao::error uncountable(int count)
{
    return { errc::invalid_settings, reason("a rule of ", count, " points; 1 to ", max_rule_points, " are possible") };
}

// Point i of a spiral of golden angles at this height; the fraction of a turn is exact to 2^-53 for every i.
constexpr direction3 spiral_point(std::uint64_t i, double z)
{
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U; // 2^64 / golden ratio
    const double turn = static_cast<double>((i * golden) >> 11U) * 1.1102230246251565e-16;
    const double angle = 2 * detail::pi * turn;
    const double across = detail::sqrt((1 - z) * (1 + z));
    return { across * detail::cosine(angle), across * detail::sine(angle), z };
}

} // namespace detail

enum class negative_weights { refused, allowed };

// By order (odd, 3 to 131) or number of points (even, 6 to 5810). Antipodal. Fails where there is no such rule, naming the
// nearest; orders 13, 25 and 27 have negative weights, by which an occlusion can leave [0, 1], and are refused unless asked for.
inline result<sphere_rule> lebedev_rule(int order_or_points, const rotation3& rotation = generic_rotation,
                                        negative_weights negative = negative_weights::refused)
{
    const lebedev_design* design = find_lebedev(order_or_points);
    if (design == nullptr) {
        return detail::unknown_lebedev(order_or_points);
    }
    if (design->negative && negative == negative_weights::refused) {
        return error(errc::invalid_settings,
                     detail::reason("the Lebedev rule of order ", design->order, ", ", design->points,
                                    " points, has negative weights: occlusion can leave [0, 1]; it must be asked for"));
    }
    sphere_rule rule{ .directions = {}, .weights = {}, .antipodal = true, .order = design->order };
    rule.directions.reserve(static_cast<std::size_t>(design->points));
    rule.weights.reserve(static_cast<std::size_t>(design->points));
    for (std::size_t i = design->first; i < design->first + design->rows; ++i) {
        for_half_orbit(lebedev_rows[i], [&](const direction3& d, double weight) { detail::append_pair(rule, d, weight); });
    }
    rotate(rule, rotation);
    return rule;
}

// `count` spiral points of equal weight (R. Swinbank and R. J. Purser, "Fibonacci grids", Q. J. R. Meteorol. Soc. 132, 2006, with
// heights in the middles of equal bands). Not antipodal.
inline result<sphere_rule> fibonacci_rule(int count, const rotation3& rotation = generic_rotation)
{
    if (!detail::countable(count)) {
        return detail::uncountable(count);
    }
    sphere_rule rule;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count;
        rule.directions.push_back(detail::spiral_point(static_cast<std::uint64_t>(i), z));
    }
    rule.weights.assign(rule.size(), 1.0 / count);
    rotate(rule, rotation);
    return rule;
}

// `count` / 2 spiral points of the upper hemisphere and their antipodes; order 1. Fails for odd counts.
inline result<sphere_rule> fibonacci_pairs_rule(int count, const rotation3& rotation = generic_rotation)
{
    if (!detail::countable(count)) {
        return detail::uncountable(count);
    }
    if (count % 2 != 0) {
        return error(errc::invalid_settings, detail::reason("pairs of antipodes need an even number of points, not ", count));
    }
    sphere_rule rule{ .directions = {}, .weights = {}, .antipodal = true, .order = 1 };
    for (int i = 0; i < count / 2; ++i) {
        const double z = 1 - (2.0 * i + 1) / count;
        detail::append_pair(rule, detail::spiral_point(static_cast<std::uint64_t>(i), z), 1.0 / count);
    }
    rotate(rule, rotation);
    return rule;
}

// Independent uniform points of equal weight (G. Marsaglia, "Choosing a point from the surface of a sphere", Ann. Math. Stat. 43,
// 1972; paper 3), from multiples of 2^-24. Not antipodal.
inline result<sphere_rule> marsaglia_rule(int count, std::uint32_t seed)
{
    if (!detail::countable(count)) {
        return detail::uncountable(count);
    }
    sphere_rule rule;
    rule.random = true;
    random_stream random(seed);
    while (rule.size() < static_cast<std::size_t>(count)) {
        const double first = 2 * static_cast<double>(random.uniform()) - 1;
        const double second = 2 * static_cast<double>(random.uniform()) - 1;
        const double s = first * first + second * second;
        if (s < 1) {
            const double across = 2 * detail::sqrt(1 - s);
            rule.directions.push_back({ first * across, second * across, 1 - 2 * s });
        }
    }
    rule.weights.assign(rule.size(), 1.0 / count);
    return rule;
}

// Halton's sequence in bases 2 and 3 on the hemisphere about +z, for either hemisphere domain. Equal weights.
inline result<sphere_rule> halton_rule(int count, rule_domain domain)
{
    if (!detail::countable(count)) {
        return detail::uncountable(count);
    }
    if (domain != rule_domain::hemisphere && domain != rule_domain::cosine_hemisphere) {
        return error(errc::invalid_settings, "Halton rules are for hemispheres");
    }
    using reals = math<double>;
    sphere_rule rule;
    rule.domain = domain;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        const double angle = 2 * detail::pi * reals::ao_radical_inverse(2, i);
        const double height = 1 - reals::ao_radical_inverse(3, i);
        const double squared = domain == rule_domain::hemisphere ? height * height : height;
        const double across = detail::sqrt(1 - squared);
        rule.directions.push_back({ across * detail::cosine(angle), across * detail::sine(angle), detail::sqrt(squared) });
    }
    rule.weights.assign(rule.size(), 1.0 / count);
    return rule;
}

} // namespace ao
