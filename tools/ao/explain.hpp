#pragma once

#include "ao/facts_cost.hpp"
#include "ao/options.hpp"
#include "ao/plan.hpp"

#include <optional>
#include <string>
#include <vector>

namespace ao::tools {

// Something that a plan leaves out because the facts make it do nothing.
struct elimination {
    std::string what;
    std::string reason;
    ao::plan full;                   // the same plan with it: the same picture, bit for bit
    std::optional<pixel_cost> saved; // of `full`, per pixel; absent where costs are not known
};

// Precondition: make_plan gave the plan.
[[nodiscard]] std::vector<elimination> eliminations_of(const ao::plan& p);

// What `ao render --explain` prints: passes with their costs, what is left out and why. Throws `error`.
[[nodiscard]] std::string explain(const render_options& o);

} // namespace ao::tools
