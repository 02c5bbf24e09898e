#include "raster_state.hpp"
#include "support.hpp"

#include <algorithm>
#include <utility>

namespace ao::vk {

namespace {

constexpr VkPipelineStageFlags shader_stages = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags attachment_stages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                   VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                   VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;

void memory_barrier(const device& d, VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
                    VkPipelineStageFlags to, VkAccessFlags read)
{
    const VkMemoryBarrier barrier{ VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, written, read };
    d.call.CmdPipelineBarrier(commands, from, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void copy_moved(const device& d, VkCommandBuffer commands, raster_model_state& state)
{
    const VkBuffer from = state.moved.pieces[state.moved.ready].handle.get();
    const VkBufferCopy instances{ 0, 0, state.objects.size() * sizeof(geometry_instance) };
    d.call.CmdCopyBuffer(commands, from, state.instances.handle.get(), 1, &instances);
    if (state.facts.motion) {
        const VkBufferCopy previous{ instances.size, 0, state.objects.size() * sizeof(affine_map) };
        d.call.CmdCopyBuffer(commands, from, state.previous.handle.get(), 1, &previous);
    }
    state.moved.waiting = false;
}

// What the shaders read, after earlier frames have read theirs.
void update(const device& d, VkCommandBuffer commands, raster_model_state& state, const geometry_camera& camera)
{
    constexpr VkPipelineStageFlags copy = VK_PIPELINE_STAGE_TRANSFER_BIT;
    memory_barrier(d, commands, shader_stages | copy, VK_ACCESS_TRANSFER_WRITE_BIT, copy, VK_ACCESS_TRANSFER_WRITE_BIT);
    d.call.CmdUpdateBuffer(commands, state.camera.handle.get(), 0, sizeof camera, &camera);
    if (state.moved.waiting) {
        copy_moved(d, commands, state);
    }
    if (!state.maps.uploaded) {
        upload_maps(d, commands, state.maps);
    }
    memory_barrier(d, commands, copy, VK_ACCESS_TRANSFER_WRITE_BIT, shader_stages,
                   VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_SHADER_READ_BIT);
}

VkClearValue cleared_depth(float far_end)
{
    VkClearValue value{};
    value.depthStencil = { far_end, 0 };
    return value;
}

void begin_pass(const device& d, VkCommandBuffer commands, const gbuffer_facts& f, const raster_targets_state& targets,
                float far_end)
{
    std::array<VkClearValue, target_count + 1> values{};
    values[targets.colors.size()] = cleared_depth(far_end);
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = targets.pass.get();
    info.framebuffer = targets.framebuffer.get();
    info.renderArea.extent = { static_cast<std::uint32_t>(f.width), static_cast<std::uint32_t>(f.height) };
    info.clearValueCount = static_cast<std::uint32_t>(targets.colors.size() + 1);
    info.pClearValues = values.data();
    d.call.CmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

void begin_rendering(const device& d, VkCommandBuffer commands, const gbuffer_facts& f, const raster_targets_state& targets,
                     float far_end)
{
    const auto attachment = [](const image& of) {
        VkRenderingAttachmentInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        info.imageView = of.view;
        info.imageLayout = of.layout;
        info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        return info;
    };
    std::array<VkRenderingAttachmentInfo, target_count> colors{};
    for (std::size_t i = 0; i < targets.colors.size(); ++i) {
        colors[i] = attachment(targets.colors[i]);
    }
    VkRenderingAttachmentInfo depth = attachment(targets.depth);
    depth.clearValue = cleared_depth(far_end);
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea.extent = { static_cast<std::uint32_t>(f.width), static_cast<std::uint32_t>(f.height) };
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(targets.colors.size());
    info.pColorAttachments = colors.data();
    info.pDepthAttachment = &depth;
    d.call.CmdBeginRendering(commands, &info);
}

void draw_batch_of(const device& d, VkCommandBuffer commands, const raster_model_state& state, const draw_batch& batch)
{
    if (!draws_indirectly(d)) {
        for (std::size_t i = batch.first; i < batch.first + batch.count; ++i) {
            const indirect_draw& each = state.draws.draws[i];
            d.call.CmdDrawIndexed(commands, each.index_count, each.instances, each.first_index, each.base_vertex,
                                  each.first_slot);
        }
        return;
    }
    for (std::size_t done = 0; done < batch.count;) {
        const std::size_t count = std::min<std::size_t>(batch.count - done, d.properties.limits.maxDrawIndirectCount);
        d.call.CmdDrawIndexedIndirect(commands, state.indirect.handle.get(), (batch.first + done) * sizeof(indirect_draw),
                                      static_cast<std::uint32_t>(count), sizeof(indirect_draw));
        done += count;
    }
}

void draw_all(const device& d, VkCommandBuffer commands, const raster_model_state& state, const geometry_view& view)
{
    const VkPipelineLayout layout = state.layout.get();
    const bool reversed = view.far_end == 0;
    const bool dynamic = d.host.enabled.extended_dynamic_state;
    std::array<VkBuffer, vertex_attribute_count> vertices{};
    constexpr std::array<VkDeviceSize, vertex_attribute_count> offsets{};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const VkBuffer own = state.attributes[i].handle.get();
        vertices[i] = own != VK_NULL_HANDLE ? own : state.attributes[position_attribute].handle.get();
    }
    d.call.CmdBindVertexBuffers(commands, 0, vertex_attribute_count, vertices.data(), offsets.data());
    d.call.CmdBindIndexBuffer(commands, state.indices.handle.get(), 0, VK_INDEX_TYPE_UINT32);
    d.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &state.set, 0, nullptr);
    if (dynamic) {
        d.call.CmdSetDepthCompareOp(commands, reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS);
    }
    for (std::size_t i = 0; i < state.draws.batches.size(); ++i) {
        const draw_batch& batch = state.draws.batches[i];
        const draw_variant& v = state.variants[batch.variant];
        // Vulkan calls a triangle clockwise as it is with rows downwards; front faces are counter-clockwise with rows upwards.
        const bool clockwise = v.mirrored == view.turned;
        const std::size_t pipeline = state.first_pipeline[batch.variant] + (dynamic ? 0 : pipeline_state(clockwise, reversed));
        d.call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, state.pipelines[pipeline].get());
        if (dynamic) {
            d.call.CmdSetCullMode(commands, v.cull_back ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE);
            d.call.CmdSetFrontFace(commands, clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        }
        if (batch.material != no_texture) {
            d.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 1, 1, &state.maps.sets[i], 0,
                                         nullptr);
        }
        draw_batch_of(d, commands, state, batch);
    }
}

} // namespace

std::optional<error> rasterizer::move(model& loaded, const scene& s)
{
    const device& d = *device_;
    raster_model_state& state = *loaded.state_;
    if (const auto wrong = check_moved(s, state.scene_objects, state.objects)) {
        return wrong;
    }
    if (state.objects.empty()) {
        return std::nullopt;
    }
    moved_objects& moved = state.moved;
    const VkDeviceSize previous_at = state.objects.size() * sizeof(geometry_instance);
    const VkDeviceSize size = previous_at + (state.facts.motion ? state.objects.size() * sizeof(affine_map) : 0);
    if (moved.next == moved.pieces.size()) {
        auto made = make_buffer(d, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
        if (!made) {
            return made.error();
        }
        moved.pieces.push_back(std::move(*made));
    }
    const buffer& to = moved.pieces[moved.next];
    constexpr std::size_t step = 4096;
    std::vector<geometry_instance> instances;
    std::vector<affine_map> previous;
    for (std::size_t first = 0; first < state.objects.size(); first += step) {
        instances.clear();
        previous.clear();
        for (std::size_t slot = first; slot < std::min(first + step, state.objects.size()); ++slot) {
            instances.push_back(make_instance(s, state.objects[slot]));
            if (state.facts.motion) {
                previous.push_back(make_previous_model(s, state.objects[slot]));
            }
        }
        if (const auto wrong = write(d, to, first * sizeof(geometry_instance), std::as_bytes(std::span(instances)))) {
            return wrong;
        }
        if (const auto wrong = write(d, to, previous_at + first * sizeof(affine_map), std::as_bytes(std::span(previous)))) {
            return wrong;
        }
    }
    moved.ready = moved.next;
    moved.waiting = true;
    moved.next = (moved.next + 1) % static_cast<std::size_t>(std::max(options_.moves_in_flight, 1));
    return std::nullopt;
}

void rasterizer::record(VkCommandBuffer buffer, model& loaded, targets& bound, const gbuffer_camera& camera)
{
    const device& d = *device_;
    raster_model_state& state = *loaded.state_;
    const raster_targets_state& onto = *bound.state_;
    const geometry_view view = make_geometry_view(camera, state.facts, true);
    update(d, buffer, state, view.camera);
    const bool dynamic = d.host.enabled.dynamic_rendering;
    dynamic ? begin_rendering(d, buffer, state.facts, onto, view.far_end)
            : begin_pass(d, buffer, state.facts, onto, view.far_end);
    if (!state.draws.batches.empty()) {
        draw_all(d, buffer, state, view);
    }
    dynamic ? d.call.CmdEndRendering(buffer) : d.call.CmdEndRenderPass(buffer);
    if (const VkPipelineStageFlags readers = d.host.readers; readers != 0) {
        memory_barrier(d, buffer, attachment_stages,
                       VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, readers,
                       access_of(readers));
    }
}

} // namespace ao::vk
