// What prepare_shading() and bind_shading() make.
#pragma once

#include "ao/vk/shading.hpp"
#include "memory.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ao::vk {

// Descriptors by binding, as in shaders/shading.glsl.
enum shade_slot : std::uint32_t {
    geometry_slot,
    normal_slot,
    ids_slot,
    surface_slot,
    frame_slot,
    visibility_slot,
    color_slot,
    targets_slot,
    table_slot,
    heap_slot,
    statistics_slot,
    shade_slot_count
};
inline constexpr std::uint32_t shade_inputs = color_slot; // sampled

struct shade_program_state {
    shade_facts facts;
    shade_options options;
    std::size_t passes = 0;
    int target_count = 0;

    buffer table;
    buffer heap;
    buffer statistics; // a counter
    picture targets;   // one texel where the plan has none
    owned<VkDescriptorSetLayout> set_layout;
    owned<VkPipelineLayout> layout;
    owned<VkPipeline> shade;
    owned<VkPipeline> segment; // where the plan has any

    std::vector<std::uint32_t> words;
    std::size_t changed_first = 0; // words that are to be written to the table
    std::size_t changed_end = 0;
};

struct shade_binding_state {
    owned<VkDescriptorPool> pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

} // namespace ao::vk
