#include "raster_state.hpp"
#include "support.hpp"

namespace ao::vk {

std::array<raster_target, target_count> targets_of(const gbuffer_facts& f)
{
    return { { { "position", f.position_format, f.position },
               { "normal", f.normal_format, f.normal },
               { "motion", f.motion_format, f.motion },
               { "ids", pixel_format::rg32ui, f.ids },
               { "surface", pixel_format::rgba32f, f.surface },
               { "frame", pixel_format::rgba32f, f.frame } } };
}

std::vector<VkFormat> color_formats(const gbuffer_facts& f)
{
    std::vector<VkFormat> formats;
    for (const raster_target& each : targets_of(f)) {
        if (each.wanted) {
            formats.push_back(native_format(each.format));
        }
    }
    return formats;
}

result<owned<VkRenderPass>> make_render_pass(const device& d, const gbuffer_facts& f, const raster_targets_state* targets)
{
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> references;
    const auto add = [&](VkFormat format, VkImageLayout layout) {
        VkAttachmentDescription each{};
        each.format = format;
        each.samples = VK_SAMPLE_COUNT_1_BIT;
        each.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        each.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        each.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        each.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        each.initialLayout = layout;
        each.finalLayout = layout;
        references.push_back({ static_cast<std::uint32_t>(attachments.size()), layout });
        attachments.push_back(each);
    };
    const std::vector<VkFormat> formats = color_formats(f);
    for (std::size_t i = 0; i < formats.size(); ++i) {
        add(formats[i], targets != nullptr ? targets->colors[i].layout : VK_IMAGE_LAYOUT_GENERAL);
    }
    add(native_format(f.depth_format), targets != nullptr ? targets->depth.layout : VK_IMAGE_LAYOUT_GENERAL);
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
    subpass.pColorAttachments = references.data();
    subpass.pDepthStencilAttachment = &references.back();
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    return create<VkRenderPass>(d, d.call.CreateRenderPass, d.call.DestroyRenderPass, info, "vkCreateRenderPass");
}

std::optional<error> make_layouts(const device& d, bool hardware, raster_model_state& made)
{
    constexpr VkShaderStageFlags vertex = VK_SHADER_STAGE_VERTEX_BIT;
    constexpr VkShaderStageFlags fragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    const auto table = [](std::uint32_t slot, VkShaderStageFlags stage) {
        return VkDescriptorSetLayoutBinding{ slot, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, stage, nullptr };
    };
    const std::array<VkDescriptorSetLayoutBinding, raster_slot_count> bindings{ {
        { camera_slot, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, vertex | fragment, nullptr },
        table(instances_slot, vertex),
        table(previous_slot, vertex),
        table(materials_slot, fragment),
        table(raster_heap_slot, fragment),
    } };
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = raster_slot_count;
    set.pBindings = bindings.data();
    AO_VK_CREATE(made.set_layout, d, DescriptorSetLayout, set);
    const auto sampled = [](std::uint32_t slot) {
        return VkDescriptorSetLayoutBinding{ slot, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, fragment, nullptr };
    };
    const std::array<VkDescriptorSetLayoutBinding, 2> pictures{ { sampled(0), sampled(1) } };
    set.bindingCount = static_cast<std::uint32_t>(pictures.size());
    set.pBindings = pictures.data();
    AO_VK_CREATE(made.maps_layout, d, DescriptorSetLayout, set);

    const std::array<VkDescriptorSetLayout, 2> sets{ made.set_layout.get(), made.maps_layout.get() };
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = hardware ? 2 : 1;
    layout.pSetLayouts = sets.data();
    AO_VK_CREATE(made.layout, d, PipelineLayout, layout);
    return std::nullopt;
}

} // namespace ao::vk
