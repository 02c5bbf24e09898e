#include "host/runner_vk_evaluate.hpp"

#include "ao_runner_shaders.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace ao::host {

namespace {

// Deletes what the evaluation made, on every way out.
struct objects {
    VkDevice device;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkShaderModule shader = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;

    explicit objects(VkDevice d) : device(d) {}
    objects(const objects&) = delete;
    objects& operator=(const objects&) = delete;
    ~objects()
    {
        vkDestroyDescriptorPool(device, pool, nullptr);
        vkDestroyPipeline(device, pipeline, nullptr);
        vkDestroyShaderModule(device, shader, nullptr);
        vkDestroyPipelineLayout(device, layout, nullptr);
        vkDestroyDescriptorSetLayout(device, set_layout, nullptr);
    }
};

constexpr std::uint32_t binding_count = 4; // the call, a, b, out

VkResult make_pipeline(objects& o)
{
    std::array<VkDescriptorSetLayoutBinding, binding_count> bindings{};
    for (std::uint32_t i = 0; i < binding_count; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = binding_count;
    set_info.pBindings = bindings.data();
    if (const VkResult code = vkCreateDescriptorSetLayout(o.device, &set_info, nullptr, &o.set_layout); code != VK_SUCCESS) {
        return code;
    }
    VkPipelineLayoutCreateInfo layout_info{};
    layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &o.set_layout;
    if (const VkResult code = vkCreatePipelineLayout(o.device, &layout_info, nullptr, &o.layout); code != VK_SUCCESS) {
        return code;
    }
    VkShaderModuleCreateInfo shader_info{};
    shader_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    shader_info.codeSize = shaders_vk::runner_evaluate_comp_vk.size_bytes();
    shader_info.pCode = shaders_vk::runner_evaluate_comp_vk.data();
    if (const VkResult code = vkCreateShaderModule(o.device, &shader_info, nullptr, &o.shader); code != VK_SUCCESS) {
        return code;
    }
    VkComputePipelineCreateInfo pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipeline_info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline_info.stage.module = o.shader;
    pipeline_info.stage.pName = "main";
    pipeline_info.layout = o.layout;
    return vkCreateComputePipelines(o.device, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &o.pipeline);
}

VkResult make_set(objects& o, const std::vector<vulkan_buffer>& buffers)
{
    const VkDescriptorPoolSize size{ VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, binding_count };
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    if (const VkResult code = vkCreateDescriptorPool(o.device, &pool_info, nullptr, &o.pool); code != VK_SUCCESS) {
        return code;
    }
    VkDescriptorSetAllocateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set_info.descriptorPool = o.pool;
    set_info.descriptorSetCount = 1;
    set_info.pSetLayouts = &o.set_layout;
    if (const VkResult code = vkAllocateDescriptorSets(o.device, &set_info, &o.set); code != VK_SUCCESS) {
        return code;
    }
    for (std::uint32_t i = 0; i < binding_count; ++i) {
        const VkDescriptorBufferInfo buffer{ buffers[i].buffer, 0, VK_WHOLE_SIZE };
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = o.set;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = &buffer;
        vkUpdateDescriptorSets(o.device, 1, &write, 0, nullptr);
    }
    return VK_SUCCESS;
}

} // namespace

ao::result<success> evaluate_vk(vulkan_device& device, int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                                std::span<glm::vec4> out)
{
    const std::array<std::int32_t, 4> call{ function, static_cast<std::int32_t>(a.size()), 0, 0 };
    const std::array<std::span<const std::byte>, binding_count> contents{ std::as_bytes(std::span(call)), std::as_bytes(a),
                                                                          std::as_bytes(b), std::as_bytes(out) };
    std::vector<vulkan_buffer> buffers;
    for (const std::span<const std::byte> content : contents) {
        auto buffer = vulkan_buffer::create(device, content.size(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        if (!buffer) {
            return error(errc::device, buffer.reason());
        }
        std::memcpy(buffer->bytes.data(), content.data(), content.size());
        buffers.push_back(std::move(*buffer));
    }
    objects made(device.device);
    VkResult code = make_pipeline(made);
    code = code == VK_SUCCESS ? make_set(made, buffers) : code;
    if (code != VK_SUCCESS) {
        return error(errc::device, "evaluate: no Vulkan pipeline", code);
    }
    const auto done = device.submit([&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, made.pipeline);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, made.layout, 0, 1, &made.set, 0, nullptr);
        vkCmdDispatch(commands, static_cast<std::uint32_t>((a.size() + 63) / 64), 1, 1);
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                             nullptr, 0, nullptr);
    });
    if (!done) {
        return error(errc::device, done.reason());
    }
    std::memcpy(out.data(), buffers[3].bytes.data(), out.size_bytes());
    return success{};
}

} // namespace ao::host
