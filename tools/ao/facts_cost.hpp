#pragma once

#include "ao/plan.hpp"
#include "ao/temporal.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace ao::tools {

// What a frame asks of any device for each pixel, known before it runs.
struct pixel_cost {
    std::size_t passes = 0;
    double fetches = 0;    // texels that shaders read; tables in uniform buffers, which stay in caches, are none
    double operations = 0; // on scalars: arithmetic, comparisons, selects, conversions
    double bytes = 0;      // each picture that a pass reads or writes, once

    pixel_cost& operator+=(const pixel_cost& c);
};

// Of one module with its options (specialisation constants) by their names in the shaders; others keep their defaults.
// A loop whose trips the module does not tell counts `trips` times; what stands behind a condition counts as if it held.
// Throws `error` for what is no SPIR-V.
[[nodiscard]] pixel_cost cost_of_module(std::span<const std::uint32_t> module,
                                        const std::map<std::string, std::uint32_t>& options, double trips);

// By the shaders of the Vulkan backend for GPUs, which are the shared bodies of all of them. Nothing where the program was built
// without that backend.
[[nodiscard]] std::optional<pixel_cost> cost_of(const ao::plan& p, const ao::pass& each);
[[nodiscard]] std::optional<pixel_cost> cost_of(const ao::plan& p);

// Of a frame in which every pixel takes `samples`. `steps`: indices into plan.steps, in order.
[[nodiscard]] std::optional<pixel_cost> cost_of(const ao::temporal_plan& p, std::span<const std::size_t> steps, int samples);

} // namespace ao::tools
