// What a baker keeps between bakes, and what it makes for one.
#pragma once

#include "ao/bake_gpu_driver.hpp"
#include "ao/vk/bake.hpp"
#include "memory.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

// Of submitting, which passes that the host records do without.
#define AO_VK_SUBMIT_FUNCTIONS(X)                                                                                                \
    X(AllocateCommandBuffers)                                                                                                    \
    X(BeginCommandBuffer)                                                                                                        \
    X(CmdFillBuffer)                                                                                                             \
    X(CreateCommandPool)                                                                                                         \
    X(CreateFence)                                                                                                               \
    X(DestroyCommandPool)                                                                                                        \
    X(DestroyFence)                                                                                                              \
    X(EndCommandBuffer)                                                                                                          \
    X(QueueSubmit)                                                                                                               \
    X(ResetFences)                                                                                                               \
    X(WaitForFences)

namespace ao::vk {

struct submit_functions {
#define AO_VK_MEMBER(name) PFN_vk##name name = nullptr;
    AO_VK_SUBMIT_FUNCTIONS(AO_VK_MEMBER)
#undef AO_VK_MEMBER
};

// One command buffer, submitted and waited for.
class submitter {
public:
    static result<submitter> create(const device& d, const compute_queue& queue);
    // What `record` records, and all its writes, is done and visible to later submissions and to the host.
    std::optional<error> run(const std::function<void(VkCommandBuffer)>& record);
    const submit_functions& call() const { return call_; }

private:
    submit_functions call_;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    PFN_vkCmdPipelineBarrier pipeline_barrier_ = nullptr;
    owned<VkCommandPool> pool_;
    owned<VkFence> fence_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

// Descriptors by binding, as in shaders/bake.glsl; the last three are storage buffers.
enum bake_slot : std::uint32_t {
    vertices_slot,
    triangles_slot,
    points_slot,
    lines_slot,
    rotations_slot,
    seen_slot,
    nodes_slot = seen_slot, // of the hierarchy
    sums_slot,
    words_slot,
    seen_stored_slot,
    bake_slot_count
};

struct bake_pipeline {
    detail::bake_shader shader{};
    std::array<std::uint32_t, detail::bake_gpu_constants> constants{};
    owned<VkPipeline> pipeline;
};

struct bake_state {
    std::unique_ptr<device> on; // outlives the rest
    bake_gpu_options options;
    submitter submit;
    owned<VkDescriptorSetLayout> set_layout;
    owned<VkPipelineLayout> layout;
    std::vector<bake_pipeline> pipelines; // of the bakes so far
    std::uint32_t group = 0;
};

// The pipeline for these constants, made where there is none yet.
result<VkPipeline> bake_pipeline_of(bake_state& state, detail::bake_shader shader,
                                    const std::array<std::uint32_t, detail::bake_gpu_constants>& constants);

struct bake_buffers {
    std::array<buffer, bake_slot_count> buffers; // seen_stored_slot has none: it is seen_slot's
    std::array<owned<VkBufferView>, sums_slot> texels;
    owned<VkDescriptorPool> pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

// Makes the buffers of a part, uploads the tables and clears the sums.
std::optional<error> make_bake_buffers(bake_state& state, const bake_job& job, const bake_request& part, bake_route route,
                                       const detail::bake_room& room, bake_buffers& made);
std::optional<error> read_bake_sums(bake_state& state, const bake_buffers& from, std::span<bake_sum> sums);

} // namespace ao::vk
