#include "program.hpp"
#include "support.hpp"
#include "temporal_state.hpp"

#include <cassert>
#include <span>

namespace ao::vk {

namespace {

constexpr VkPipelineStageFlags compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags copy = VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkPipelineStageFlags indirect = VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;

void barrier(const device& d, VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written, VkPipelineStageFlags to,
             VkAccessFlags access, std::span<const VkImageMemoryBarrier> pictures = {})
{
    const VkMemoryBarrier memory{ VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, written, access };
    d.call.CmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, static_cast<std::uint32_t>(pictures.size()),
                              pictures.data());
}

// The last frame is done with the histories, the constants, the tiles and the program's pictures, which lose their content. What
// it or a copy has written of a history is visible.
void begin_frame(const device& d, VkCommandBuffer commands, const temporal_program_state& program)
{
    std::array<VkImageMemoryBarrier, 2> discarded{};
    std::size_t count = 0;
    for (const picture* own : { &program.eye_depth, &program.rows }) {
        if (own->image.get() == VK_NULL_HANDLE) {
            continue;
        }
        VkImageMemoryBarrier& each = discarded[count++];
        each.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        each.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        each.dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        each.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        each.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        each.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        each.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        each.image = own->image.get();
        each.subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 };
    }
    barrier(d, commands, compute | copy | indirect, VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT, compute | copy,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
            std::span(discarded).first(count));
}

// In the command buffer, so that frames in flight keep theirs.
void upload_constants_and_clear_tiles(const device& d, VkCommandBuffer commands, const temporal_program_state& program,
                                      const temporal_plan& p, const temporal_frame& frame)
{
    for (const std::size_t i : frame.steps) {
        const temporal_step& step = p.steps[i];
        if (step.type == temporal_pass_type::accumulate) {
            d.call.CmdUpdateBuffer(commands, program.constants.handle.get(), 0, step.constants_size, step.constants.data());
        }
    }
    d.call.CmdFillBuffer(commands, program.tiles.handle.get(), 0, VK_WHOLE_SIZE, 0);
    barrier(d, commands, copy, VK_ACCESS_TRANSFER_WRITE_BIT, compute,
            VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
}

// `listed`: over the tiles to be filtered, else over the picture.
void dispatch(const device& d, VkCommandBuffer commands, const temporal_program_state& program, VkPipeline pipeline,
              VkDescriptorSet set, std::span<const std::byte> pushed, bool listed)
{
    const VkPipelineLayout layout = program.layout.get();
    d.call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    d.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    if (!pushed.empty()) {
        d.call.CmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(pushed.size()),
                                pushed.data());
    }
    if (listed) {
        d.call.CmdDispatchIndirect(commands, program.tiles.handle.get(), 0);
        return;
    }
    const group_size group = d.host.group;
    const auto width = static_cast<std::uint32_t>(program.plan.facts.frame.width);
    const auto height = static_cast<std::uint32_t>(program.plan.facts.frame.height);
    d.call.CmdDispatch(commands, (width + group.x - 1) / group.x, (height + group.y - 1) / group.y, 1);
}

void show_writes(const device& d, VkCommandBuffer commands)
{
    barrier(d, commands, compute, VK_ACCESS_SHADER_WRITE_BIT, compute | indirect,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT);
}

} // namespace

void temporal::record_temporal(VkCommandBuffer buffer, temporal_program& program, temporal_binding& bound, const temporal_plan& p,
                               const temporal_frame& frame, std::size_t index)
{
    const device& d = *device_;
    const temporal_program_state& state = *program.state_;
    const auto& sets = bound.state_->sets;
    assert(index < frame.steps.size() && p.steps.size() == state.plan.steps.size());
    if (index == 0) {
        begin_frame(d, buffer, state);
        upload_constants_and_clear_tiles(d, buffer, state, p, frame);
        if (state.copies_depth) {
            const linearize_constants identity = copying_constants();
            dispatch(d, buffer, state, state.copy.get(), sets[2 * p.steps.size()], std::as_bytes(std::span(&identity, 1)), false);
            show_writes(d, buffer);
        }
    }
    const std::size_t i = frame.steps[index];
    const temporal_step& step = p.steps[i];
    const bool pushes = step.type != temporal_pass_type::accumulate;
    const bool listed = step.type == temporal_pass_type::filter_rows || step.type == temporal_pass_type::filter_columns;
    dispatch(d, buffer, state, state.pipelines[i].get(), sets[set_of(i, frame.write)],
             std::span(step.constants).first(pushes ? step.constants_size : 0), listed);

    if (index + 1 < frame.steps.size()) {
        show_writes(d, buffer);
    }
    else if (const VkPipelineStageFlags readers = d.host.readers; readers != 0) {
        barrier(d, buffer, compute, VK_ACCESS_SHADER_WRITE_BIT, readers, access_of(readers));
    }
}

} // namespace ao::vk
