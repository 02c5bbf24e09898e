#include "shading_state.hpp"
#include "support.hpp"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <new>

namespace ao::vk {

namespace {

struct input {
    const image* picture;
    const char* role;
    bool wanted;
};

std::array<input, shade_inputs> inputs_of(const shade_images<image>& images, const shade_plan& p)
{
    const shade_facts& f = p.facts;
    const shade_options& o = p.options;
    return { { f.stored_position ? input{ &images.position, "position", true } : input{ &images.depth, "depth", true },
               { &images.normal, "normal", true },
               { &images.ids, "ids", true },
               { &images.surface, "surface", o.maps || o.frames },
               { &images.frame, "frame", o.frames },
               { &images.visibility, "visibility", f.visibility } } };
}

std::optional<error> wrong_images(const shade_images<image>& images, const shade_plan& p)
{
    const auto null = [](const char* role) {
        char text[128];
        std::snprintf(text, sizeof text, "the plan needs a %s picture, but there is no image view of it", role);
        return error(errc::plan_mismatch, text);
    };
    for (const input& each : inputs_of(images, p)) {
        if (each.wanted && each.picture->view == VK_NULL_HANDLE) {
            return null(each.role);
        }
    }
    if (images.color.view == VK_NULL_HANDLE) {
        return null("color");
    }
    if (images.color.layout != VK_IMAGE_LAYOUT_GENERAL) {
        return error(errc::plan_mismatch, "color is written in VK_IMAGE_LAYOUT_GENERAL");
    }
    return std::nullopt;
}

void write_set(const device& d, VkDescriptorSet set, const shade_program_state& program, const shade_plan& p,
               const shade_images<image>& images)
{
    const auto inputs = inputs_of(images, p);
    std::array<VkDescriptorImageInfo, table_slot> pictures{};
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        // The shader names every picture even where the options take it out of use; any will do then.
        const image& from = inputs[i].wanted ? *inputs[i].picture : *inputs[0].picture;
        pictures[i] = { VK_NULL_HANDLE, from.view, from.layout };
    }
    pictures[color_slot] = { VK_NULL_HANDLE, images.color.view, VK_IMAGE_LAYOUT_GENERAL };
    pictures[targets_slot] = { VK_NULL_HANDLE, program.targets.view.get(), VK_IMAGE_LAYOUT_GENERAL };
    const std::array<VkDescriptorBufferInfo, 3> tables{ { { program.table.handle.get(), 0, VK_WHOLE_SIZE },
                                                          { program.heap.handle.get(), 0, VK_WHOLE_SIZE },
                                                          { program.statistics.handle.get(), 0, VK_WHOLE_SIZE } } };
    std::array<VkWriteDescriptorSet, shade_slot_count> writes{};
    for (std::uint32_t i = 0; i < shade_slot_count; ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        if (i < table_slot) {
            writes[i].descriptorType = i < shade_inputs ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            writes[i].pImageInfo = &pictures[i];
        }
        else {
            writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            writes[i].pBufferInfo = &tables[i - table_slot];
        }
    }
    d.call.UpdateDescriptorSets(d.host.device, shade_slot_count, writes.data(), 0, nullptr);
}

VkMemoryBarrier memory_barrier(VkAccessFlags from, VkAccessFlags to)
{
    return { VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, from, to };
}

constexpr VkPipelineStageFlags compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags shader_access = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;

// After the last frame is done with them: the targets lose their content, the counter keeps its own.
void begin_frame(const device& d, VkCommandBuffer commands, const shade_program_state& program)
{
    const VkMemoryBarrier memory = memory_barrier(VK_ACCESS_SHADER_WRITE_BIT, shader_access);
    VkImageMemoryBarrier targets{};
    targets.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    targets.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    targets.dstAccessMask = shader_access;
    targets.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    targets.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    targets.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    targets.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    targets.image = program.targets.image.get();
    targets.subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS };
    d.call.CmdPipelineBarrier(commands, compute, compute, 0, 1, &memory, 0, nullptr, 1, &targets);
}

// Changed words travel in the command buffer, so that frames in flight keep theirs.
void upload_table(const device& d, VkCommandBuffer commands, shade_program_state& program)
{
    constexpr std::size_t piece = 65536 / sizeof(std::uint32_t); // vkCmdUpdateBuffer's limit
    constexpr VkPipelineStageFlags copy = VK_PIPELINE_STAGE_TRANSFER_BIT;
    const VkMemoryBarrier before = memory_barrier(VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_TRANSFER_WRITE_BIT);
    d.call.CmdPipelineBarrier(commands, compute | copy, copy, 0, 1, &before, 0, nullptr, 0, nullptr);
    for (std::size_t at = program.changed_first; at < program.changed_end; at += piece) {
        const std::size_t count = std::min(piece, program.changed_end - at);
        d.call.CmdUpdateBuffer(commands, program.table.handle.get(), at * sizeof(std::uint32_t), count * sizeof(std::uint32_t),
                               program.words.data() + at);
    }
    const VkMemoryBarrier after = memory_barrier(VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT);
    d.call.CmdPipelineBarrier(commands, copy, compute, 0, 1, &after, 0, nullptr, 0, nullptr);
    program.changed_first = program.changed_end = 0;
}

// Color to the host's readers, the counter to the host itself.
void end_frame(const device& d, VkCommandBuffer commands)
{
    const VkPipelineStageFlags readers = d.host.readers;
    const VkAccessFlags access = access_of(readers) | VK_ACCESS_HOST_READ_BIT;
    const VkMemoryBarrier memory = memory_barrier(VK_ACCESS_SHADER_WRITE_BIT, access);
    d.call.CmdPipelineBarrier(commands, compute, readers | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

} // namespace

result<shade_binding> shading::bind_shading(shade_program& program, const shade_plan& p, const shade_images<image>& images)
{
    const device& d = *device_;
    const shade_program_state& from = *program.state_;
    const shade_facts& f = p.facts;
    if (from.options != p.options || from.facts.visibility_format != f.visibility_format || from.facts.width != f.width ||
        from.facts.height != f.height || from.passes != p.passes.size() || from.target_count != p.targets) {
        return error(errc::plan_mismatch, "the program was prepared for another plan");
    }
    if (const auto wrong = wrong_images(images, p)) {
        return *wrong;
    }
    std::unique_ptr<shade_binding_state> made(new (std::nothrow) shade_binding_state);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    const std::array<VkDescriptorPoolSize, 3> sizes{ { { VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, shade_inputs },
                                                       { VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, table_slot - color_slot },
                                                       { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, shade_slot_count - table_slot } } };
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    AO_VK_CREATE(made->pool, d, DescriptorPool, pool);

    const VkDescriptorSetLayout layout = from.set_layout.get();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = made->pool.get();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    if (const VkResult code = d.call.AllocateDescriptorSets(d.host.device, &allocate, &made->set); code != VK_SUCCESS) {
        return api_error(code, "vkAllocateDescriptorSets");
    }
    write_set(d, made->set, from, p, images);
    return shade_binding(std::move(made));
}

void shading::record_shading(VkCommandBuffer buffer, shade_program& program, shade_binding& bound, const shade_plan& p,
                             std::size_t index)
{
    const device& d = *device_;
    shade_program_state& state = *program.state_;
    assert(index < p.passes.size() && p.passes.size() == state.passes);
    const shade_pass& each = p.passes[index];
    if (index == 0) {
        begin_frame(d, buffer, state);
        if (state.changed_first != state.changed_end) {
            upload_table(d, buffer, state);
        }
    }
    shade_constants constants = each.constants;
    constants.reserved = static_cast<float>(each.output);
    const VkPipelineLayout layout = state.layout.get();
    d.call.CmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_COMPUTE,
                           each.type == shade_pass_type::shade ? state.shade.get() : state.segment.get());
    d.call.CmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &bound.state_->set, 0, nullptr);
    d.call.CmdPushConstants(buffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants, &constants);
    const auto groups = [](int pixels, std::uint32_t size) { return (static_cast<std::uint32_t>(pixels) + size - 1) / size; };
    d.call.CmdDispatch(buffer, groups(state.facts.width, d.host.group.x), groups(state.facts.height, d.host.group.y), 1);

    if (index + 1 < state.passes) {
        const VkMemoryBarrier memory = memory_barrier(VK_ACCESS_SHADER_WRITE_BIT, shader_access);
        d.call.CmdPipelineBarrier(buffer, compute, compute, 0, 1, &memory, 0, nullptr, 0, nullptr);
    }
    else {
        end_frame(d, buffer);
    }
}

} // namespace ao::vk
