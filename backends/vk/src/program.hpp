// What prepare() and bind() make.
#pragma once

#include "memory.hpp"

namespace ao::vk {

// Of a linearize pass, affine, that copies eye depth; what is no surface becomes 0.
linearize_constants copying_constants();
// Whether a pass reads its first input, which is then the program's own, as a storage image: what software devices are quick at.
bool is_stored(const device& d, const pass& each);
// The plan that is run for `p`: with the pass that copies the depth, where there is one. It leaves every bit of the result.
plan executed_plan(const device& d, const plan& p);

struct prepared {
    ao::plan given;
    ao::plan executed;
    ao::vk::tables tables;
    ao::vk::transients transients;
    owned<VkDescriptorSetLayout> set_layout;
    owned<VkPipelineLayout> layout;
    std::array<owned<VkPipeline>, 4> pipelines;
};

struct bound {
    owned<VkDescriptorPool> pool;
    std::array<VkDescriptorSet, 4> sets{};
};

// The first thing that the device cannot do for the plan, or nothing.
std::optional<error> unsupported(const device& d, const plan& p);

} // namespace ao::vk
