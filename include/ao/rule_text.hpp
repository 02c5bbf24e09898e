// Rules from text: the short names that programs take, and lists of points that users write.
#pragma once

#include "ao/sphere_rule.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace ao {

namespace detail {

// Pairs of antipodes of equal weight brought together, if the rule consists of such pairs; else it stays as it is.
inline void pair_antipodes(sphere_rule& rule)
{
    using point = std::pair<direction3, double>; // axis of the pair, weight
    std::vector<point> points;
    std::vector<point> opposites;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const direction3& d = rule.directions[i];
        // + 0.0: -0 and 0 are one coordinate
        const direction3 there{ d[0] + 0.0, d[1] + 0.0, d[2] + 0.0 };
        const direction3 back{ 0.0 - d[0], 0.0 - d[1], 0.0 - d[2] };
        (there < back ? opposites : points).emplace_back(there < back ? back : there, rule.weights[i]);
    }
    std::sort(points.begin(), points.end());
    std::sort(opposites.begin(), opposites.end());
    if (points != opposites) {
        return;
    }
    rule = { .directions = {}, .weights = {}, .antipodal = true, .order = 1 };
    for (const auto& [axis, weight] : points) {
        append_pair(rule, axis, weight);
    }
}

// The numbers of one line, or how many could be read if these are not four.
inline std::size_t read_numbers(std::string_view line, std::array<double, 4>& numbers)
{
    std::size_t count = 0;
    while (true) {
        const std::size_t start = line.find_first_not_of(" \t\r,");
        if (start == std::string_view::npos) {
            return count;
        }
        line.remove_prefix(start);
        double number = 0;
        const auto [end, failure] = std::from_chars(line.data(), line.data() + line.size(), number);
        if (failure != std::errc() || count == numbers.size()) {
            return numbers.size() + 1;
        }
        numbers[count] = number;
        ++count;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        if (!line.empty() && std::string_view(" \t\r,").find(line.front()) == std::string_view::npos) {
            return numbers.size() + 1;
        }
    }
}

inline result<int> read_count(std::string_view text)
{
    int count = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (failure != std::errc() || end != text.data() + text.size()) {
        return error(errc::invalid_settings, reason("'", text, "' is not a whole number"));
    }
    return count;
}

} // namespace detail

// Lines "x y z w": a unit direction (to 1e-6; it is normalised) and its weight, any number of them up to max_rule_points; "#"
// begins a comment. Weights are divided by their sum, so 1 and 4 pi serve as totals alike. Points that are all in antipodal pairs
// are paired. `order` stays -1, 1 for pairs; exact_order (ao/rule_order.hpp) finds it. Fails with the line's number where a line
// is anything else, a number is not finite, a weight is negative and this was not allowed, or no weight is left.
inline result<sphere_rule> parse_rule(std::string_view text, negative_weights negative = negative_weights::refused)
{
    sphere_rule rule;
    double sum = 0;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view whole = text.substr(0, end);
        const std::string_view line = whole.substr(0, whole.find('#'));
        text.remove_prefix(std::min(end + 1, text.size()));
        std::array<double, 4> values{};
        const std::size_t count = detail::read_numbers(line, values);
        const auto wrong = [&](std::string_view what) {
            return error(errc::invalid_settings, detail::reason("rule, line ", number, ": ", what));
        };
        if (count == 0) {
            continue;
        }
        if (count != values.size()) {
            return wrong("needs four numbers, x y z and a weight");
        }
        const auto [x, y, z, weight] = values;
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || !std::isfinite(weight)) {
            return wrong("a number is not finite");
        }
        const double length = std::hypot(x, y, z);
        if (!(length > 1 - 1e-6 && length < 1 + 1e-6)) {
            return wrong("the direction is not of length 1");
        }
        if (weight < 0 && negative == negative_weights::refused) {
            return wrong("the weight is negative: occlusion can leave [0, 1]; it must be asked for");
        }
        if (rule.size() == static_cast<std::size_t>(max_rule_points)) {
            return wrong(detail::reason("more than ", max_rule_points, " points"));
        }
        rule.directions.push_back({ x / length, y / length, z / length });
        rule.weights.push_back(weight);
        sum += weight;
    }
    if (rule.size() == 0) {
        return error(errc::invalid_settings, "the rule has no points");
    }
    double most = 0;
    for (const double weight : rule.weights) {
        most = std::max(most, std::abs(weight));
    }
    // Below this the rest of a sum of cancelling weights is rounding.
    if (!std::isfinite(sum) || !(sum > 1e-9 * most) || !(sum > std::numeric_limits<double>::min())) {
        return error(errc::invalid_settings, "the rule's weights have no positive, finite sum");
    }
    for (double& weight : rule.weights) {
        weight /= sum;
    }
    detail::pair_antipodes(rule);
    return rule;
}

// "lebedev:N" (N an order or a number of points), "fibonacci:N", "fibonacci-pairs:N", "marsaglia:N" or "marsaglia:N:SEED",
// "halton:N" (uniform on the hemisphere), "halton-cosine:N". In the generic orientation where the rule is on the sphere.
inline result<sphere_rule> named_rule(std::string_view name, negative_weights negative = negative_weights::refused)
{
    const std::size_t colon = std::min(name.find(':'), name.size());
    const std::string_view kind = name.substr(0, colon);
    const std::string_view rest = name.substr(std::min(colon + 1, name.size()));
    const bool monte_carlo = kind == "marsaglia";
    if (kind != "lebedev" && kind != "fibonacci" && kind != "fibonacci-pairs" && kind != "halton" && kind != "halton-cosine" &&
        !monte_carlo) {
        return error(errc::invalid_settings, detail::reason("there is no rule '", kind,
                                                            "'; there are lebedev, fibonacci, fibonacci-pairs, marsaglia, halton "
                                                            "and halton-cosine, each with :N"));
    }
    const std::size_t second = monte_carlo ? std::min(rest.find(':'), rest.size()) : rest.size();
    const result<int> count = detail::read_count(rest.substr(0, second));
    if (!count) {
        return count.error();
    }
    if (kind == "lebedev") {
        return lebedev_rule(*count, generic_rotation, negative);
    }
    if (kind == "fibonacci") {
        return fibonacci_rule(*count);
    }
    if (kind == "fibonacci-pairs") {
        return fibonacci_pairs_rule(*count);
    }
    if (!monte_carlo) {
        return halton_rule(*count, kind == "halton" ? rule_domain::hemisphere : rule_domain::cosine_hemisphere);
    }
    const result<int> seed = second == rest.size() ? result<int>(1) : detail::read_count(rest.substr(second + 1));
    if (!seed) {
        return seed.error();
    }
    return marsaglia_rule(*count, static_cast<std::uint32_t>(*seed));
}

} // namespace ao
