#include "program.hpp"
#include "support.hpp"

#include <cassert>

namespace ao::vk {

namespace {

// The program's pictures lose their content and take the layout they keep for the frame, after the last frame is done with them.
void discard_transients(const device& d, VkCommandBuffer commands, const prepared& program)
{
    const std::size_t count = program.transients.ids.size();
    std::array<VkImageMemoryBarrier, 3> barriers{};
    for (std::size_t i = 0; i < count; ++i) {
        VkImageMemoryBarrier& barrier = barriers[i];
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = program.transients.pictures[i].image.get();
        barrier.subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 };
    }
    if (count != 0) {
        d.call.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 0,
                                  nullptr, 0, nullptr, static_cast<std::uint32_t>(count), barriers.data());
    }
}

void show_writes(const device& d, VkCommandBuffer commands, VkPipelineStageFlags stages, VkAccessFlags access)
{
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = access;
    d.call.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void dispatch(const device& d, VkCommandBuffer commands, const prepared& program, const bound& b, const pass& each,
              std::size_t slot)
{
    const VkPipelineLayout layout = program.layout.get();
    d.call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipelines[slot].get());
    d.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &b.sets[slot], 0, nullptr);
    d.call.CmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(each.constants_size),
                            each.constants.data());
    const group_size group = d.host.group;
    const extent size = extent_of(program.executed, each.output);
    const auto width = static_cast<std::uint32_t>(size.width);
    const auto height = static_cast<std::uint32_t>(size.height);
    d.call.CmdDispatch(commands, (width + group.x - 1) / group.x, (height + group.y - 1) / group.y, 1);
}

} // namespace

void backend::record_pass(VkCommandBuffer buffer, program& p, binding& b, const plan& current, std::size_t index)
{
    const device& d = *device_;
    const prepared& ready = *p.prepared_;
    assert(index < current.passes.size() && same_structure(ready.given, current));

    if (index == 0) {
        discard_transients(d, buffer, ready);
    }
    const std::size_t added = ready.executed.passes.size() - current.passes.size();
    if (index == 0 && added != 0) {
        dispatch(d, buffer, ready, *b.bound_, ready.executed.passes[0], 0);
        show_writes(d, buffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
    }
    dispatch(d, buffer, ready, *b.bound_, current.passes[index], index + added);

    if (index + 1 < current.passes.size()) {
        show_writes(d, buffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
    }
    else if (const VkPipelineStageFlags readers = d.host.readers; readers != 0) {
        show_writes(d, buffer, readers, access_of(readers));
    }
}

} // namespace ao::vk
