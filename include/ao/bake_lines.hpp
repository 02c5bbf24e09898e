// A rule on the sphere as ambient occlusion per vertex shoots it: lines, one for two antipodes, sorted so that neighbours in the
// list are neighbours on the sphere, with weights in whole numbers.
#pragma once

#include "ao/bake_passes.hpp"
#include "ao/result.hpp"
#include "ao/sphere_rule.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ao {

using bake_line = bake_pass<float>::ao_bake_line;

struct bake_lines {
    std::vector<bake_line> lines;
    // Of the rule, that d of each line is, up to sign where the line has both.
    std::vector<std::uint32_t> directions;
};

namespace detail {

// Along Morton's curve on the octahedron unfolded to a square.
inline std::uint64_t place_on_sphere(const glm::dvec3& d)
{
    const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    double x = d.x / sum;
    double y = d.y / sum;
    if (d.z < 0) {
        const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
        y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
        x = folded;
    }
    const auto spread = [](double v) {
        auto bits = static_cast<std::uint64_t>((v + 1) * 0.5 * 65535.0);
        bits = (bits | (bits << 8U)) & 0x00ff00ff00ff00ffU;
        bits = (bits | (bits << 4U)) & 0x0f0f0f0f0f0f0f0fU;
        bits = (bits | (bits << 2U)) & 0x3333333333333333U;
        return (bits | (bits << 1U)) & 0x5555555555555555U;
    };
    return spread(x) | (spread(y) << 1U);
}

inline bake_line line_along(const glm::dvec3& d, double weight, bool opposite)
{
    using reals = math<double>;
    const glm::dvec3 u = reals::ao_any_tangent(d);
    const glm::dvec3 w = reals::ao_cross(d, u);
    // Whole and even, and a float holds it.
    const auto rounded = static_cast<float>(weight * static_cast<double>(bake_pass<float>::ao_bake_weight_one));
    const float whole = 2 * std::round(rounded / 2);
    const auto f = [](double x) { return static_cast<float>(x); };
    return { f(u.x), f(u.y), f(u.z), f(w.x), f(w.y), f(w.z), f(d.x), f(d.y), f(d.z), whole, opposite ? 1.0F : 0.0F, 0.0F };
}

} // namespace detail

// errc::invalid_settings for rules without directions, with directions that are not of unit length, or with weights that do not
// sum to 1 or whose magnitudes sum to more than 1.9.
inline result<bake_lines> make_bake_lines(const sphere_rule& rule)
{
    if (rule.size() == 0 || rule.weights.size() != rule.size()) {
        return error(errc::invalid_settings, "a rule needs directions, and as many weights");
    }
    if (rule.antipodal && rule.size() % 2 != 0) {
        return error(errc::invalid_settings, "an antipodal rule has an even number of directions");
    }
    double sum = 0;
    double magnitudes = 0;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const direction3& d = rule.directions[i];
        const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (!(std::abs(squared - 1) < 1e-6)) {
            return error(errc::invalid_settings, "the directions of a rule must be of unit length");
        }
        sum += rule.weights[i];
        magnitudes += std::abs(rule.weights[i]);
    }
    if (!(std::abs(sum - 1) < 1e-6) || !(magnitudes < 1.9)) {
        return error(errc::invalid_settings, "the weights of a rule must sum to 1, and their magnitudes to less than 1.9");
    }
    struct entry {
        std::uint64_t place;
        std::uint32_t direction;
        glm::dvec3 d;
    };
    std::vector<entry> entries;
    const std::size_t step = rule.antipodal ? 2 : 1;
    for (std::size_t i = 0; i < rule.size(); i += step) {
        glm::dvec3 d(rule.directions[i][0], rule.directions[i][1], rule.directions[i][2]);
        d = glm::normalize(d);
        if (rule.antipodal && d.z < 0) {
            d = -d;
        }
        entries.push_back({ detail::place_on_sphere(d), static_cast<std::uint32_t>(i), d });
    }
    std::sort(entries.begin(), entries.end(),
              [](const entry& a, const entry& b) { return std::pair(a.place, a.direction) < std::pair(b.place, b.direction); });
    bake_lines made;
    for (const entry& e : entries) {
        made.lines.push_back(detail::line_along(e.d, rule.weights[e.direction], rule.antipodal));
        made.directions.push_back(e.direction);
    }
    return made;
}

} // namespace ao
