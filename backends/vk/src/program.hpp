// What prepare() and bind() make.
#pragma once

#include "memory.hpp"

namespace ao::vk {

struct prepared {
    ao::plan plan; // as prepared for
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
