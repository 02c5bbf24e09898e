// What prepare_temporal() and bind_temporal() make.
#pragma once

#include "ao/vk/temporal.hpp"
#include "memory.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ao::vk {

// Descriptors by binding, as in shaders/temporal.glsl and, the first five, shaders/resources.glsl.
enum temporal_slot : std::uint32_t {
    source_slot, // the host's depth, or eye depth where it is sampled
    normals_slot,
    motion_slot,
    rotations_slot,
    target_slot,
    stored_depth_slot, // eye depth on devices that are CPUs
    rows_slot,
    constants_slot,
    taps_slot,
    history_slot,
    written_slot,
    tiles_slot, // ao/shared/temporal_tiles.glsl
    temporal_slot_count
};
inline constexpr std::uint32_t temporal_inputs = rotations_slot; // sampled

constexpr VkDescriptorType type_of(temporal_slot slot)
{
    return slot < temporal_inputs                      ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE
           : slot == rotations_slot                    ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
           : slot < constants_slot                     ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
           : slot == constants_slot                    ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
           : slot == taps_slot || slot == history_slot ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                                                       : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

struct temporal_program_state {
    temporal_plan plan; // that it was prepared for
    // Linear depth of the host's is copied first: it leaves every bit of the result, and lavapipe is faster with storage images.
    bool copies_depth = false;

    buffer tables; // rotations, then taps
    owned<VkBufferView> rotations;
    owned<VkBufferView> taps;
    buffer constants; // of accumulate; rewritten in every frame's commands
    std::array<buffer, 2> histories;
    std::array<owned<VkBufferView>, 2> history_texels; // a pixel each
    picture eye_depth;                                 // where the plan linearizes or depth is copied
    picture rows;                                      // where the plan filters
    buffer tiles;                                      // to be filtered, and the dispatch over them
    owned<VkDescriptorSetLayout> set_layout;
    owned<VkPipelineLayout> layout;
    std::array<owned<VkPipeline>, 6> pipelines; // by step of the plan
    owned<VkPipeline> copy;
};

// Sets by step, twice: for frames that write history 0 and 1. Then the copy's.
struct temporal_binding_state {
    static constexpr std::size_t most_sets = 13;
    owned<VkDescriptorPool> pool;
    std::array<VkDescriptorSet, most_sets> sets{};
};

inline std::size_t set_of(std::size_t step, int written)
{
    return 2 * step + static_cast<std::size_t>(written);
}

} // namespace ao::vk
