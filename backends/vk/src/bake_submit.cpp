#include "bake_state.hpp"

#include <limits>

namespace ao::vk {

result<submitter> submitter::create(const device& d, const compute_queue& queue)
{
    if (queue.queue == VK_NULL_HANDLE) {
        return error(errc::device, "a baker needs a queue");
    }
    submitter made;
#define AO_VK_LOAD(name)                                                                                                         \
    made.call_.name = reinterpret_cast<PFN_vk##name>(d.call.GetDeviceProcAddr(d.host.device, "vk" #name));                       \
    if (made.call_.name == nullptr) {                                                                                            \
        return error(errc::device, "the Vulkan loader does not know vk" #name);                                                  \
    }
    AO_VK_SUBMIT_FUNCTIONS(AO_VK_LOAD)
#undef AO_VK_LOAD
    made.device_ = d.host.device;
    made.queue_ = queue.queue;
    made.pipeline_barrier_ = d.call.CmdPipelineBarrier;

    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = queue.family;
    auto made_pool =
        vk::create<VkCommandPool>(d, made.call_.CreateCommandPool, made.call_.DestroyCommandPool, pool, "vkCreateCommandPool");
    if (!made_pool) {
        return made_pool.error();
    }
    made.pool_ = std::move(*made_pool);
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    auto made_fence = vk::create<VkFence>(d, made.call_.CreateFence, made.call_.DestroyFence, fence, "vkCreateFence");
    if (!made_fence) {
        return made_fence.error();
    }
    made.fence_ = std::move(*made_fence);
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = made.pool_.get();
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    if (const VkResult code = made.call_.AllocateCommandBuffers(d.host.device, &allocate, &made.commands_); code != VK_SUCCESS) {
        return api_error(code, "vkAllocateCommandBuffers");
    }
    return made;
}

std::optional<error> submitter::run(const std::function<void(VkCommandBuffer)>& record)
{
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (const VkResult code = call_.BeginCommandBuffer(commands_, &begin); code != VK_SUCCESS) {
        return api_error(code, "vkBeginCommandBuffer");
    }
    record(commands_);
    constexpr VkPipelineStageFlags stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    pipeline_barrier_(commands_, stages, stages | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    if (const VkResult code = call_.EndCommandBuffer(commands_); code != VK_SUCCESS) {
        return api_error(code, "vkEndCommandBuffer");
    }
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    if (const VkResult code = call_.QueueSubmit(queue_, 1, &submit, fence_.get()); code != VK_SUCCESS) {
        return api_error(code, "vkQueueSubmit");
    }
    const VkFence fence = fence_.get();
    if (const VkResult code = call_.WaitForFences(device_, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
        code != VK_SUCCESS) {
        return api_error(code, "vkWaitForFences");
    }
    if (const VkResult code = call_.ResetFences(device_, 1, &fence); code != VK_SUCCESS) {
        return api_error(code, "vkResetFences");
    }
    return std::nullopt;
}

} // namespace ao::vk
