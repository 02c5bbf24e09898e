#include "bake_state.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace ao::vk {

namespace {

struct table {
    bake_slot slot;
    const char* name;
    std::span<const std::byte> content;
    VkFormat format;
};

std::optional<error> too_large(const char* what, std::size_t wanted, const char* unit, std::size_t limit)
{
    if (wanted <= limit) {
        return std::nullopt;
    }
    char text[200];
    std::snprintf(text, sizeof text, "%s: %zu %s, a buffer of the Vulkan device holds %zu for a shader", what, wanted, unit,
                  limit);
    return error(errc::out_of_memory, text);
}

std::optional<error> make_texels(const device& d, const char* name, VkFormat format, bake_slot slot, VkDeviceSize size,
                                 VkBufferUsageFlags more, bake_buffers& made)
{
    const std::size_t texels = size / 16;
    if (auto wrong = too_large(name, texels, "texels", d.properties.limits.maxTexelBufferElements)) {
        return wrong;
    }
    auto own = make_buffer(d, size, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | more, 0);
    if (!own) {
        return own.error();
    }
    made.buffers[slot] = std::move(*own);
    VkBufferViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    view.buffer = made.buffers[slot].handle.get();
    view.format = format;
    view.range = VK_WHOLE_SIZE;
    AO_VK_CREATE(made.texels[slot], d, BufferView, view);
    return std::nullopt;
}

std::optional<error> make_storage(const device& d, const char* name, bake_slot slot, VkDeviceSize size, bake_buffers& made)
{
    if (auto wrong = too_large(name, size, "bytes", d.properties.limits.maxStorageBufferRange)) {
        return wrong;
    }
    auto own = make_buffer(
        d, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, 0);
    if (!own) {
        return own.error();
    }
    made.buffers[slot] = std::move(*own);
    return std::nullopt;
}

// By one buffer that the host writes, and copies into those that the shaders read.
std::optional<error> upload(bake_state& state, std::span<const table> tables, bake_buffers& made)
{
    const device& d = *state.on;
    VkDeviceSize size = 0;
    for (const table& t : tables) {
        size += t.content.size();
    }
    auto staging = make_buffer(d, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    if (!staging) {
        return staging.error();
    }
    VkDeviceSize at = 0;
    for (const table& t : tables) {
        if (auto wrong = write(d, *staging, at, t.content)) {
            return wrong;
        }
        at += t.content.size();
    }
    return state.submit.run([&](VkCommandBuffer commands) {
        VkDeviceSize from = 0;
        for (const table& t : tables) {
            const VkBufferCopy copy{ from, 0, t.content.size() };
            d.call.CmdCopyBuffer(commands, staging->handle.get(), made.buffers[t.slot].handle.get(), 1, &copy);
            from += t.content.size();
        }
        state.submit.call().CmdFillBuffer(commands, made.buffers[sums_slot].handle.get(), 0, VK_WHOLE_SIZE, 0);
    });
}

std::optional<error> make_set(const bake_state& state, bake_buffers& made)
{
    const device& d = *state.on;
    const std::array<VkDescriptorPoolSize, 2> sizes{ { { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, sums_slot },
                                                       { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, bake_slot_count - sums_slot } } };
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    AO_VK_CREATE(made.pool, d, DescriptorPool, pool);
    const VkDescriptorSetLayout layout = state.set_layout.get();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = made.pool.get();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    if (const VkResult code = d.call.AllocateDescriptorSets(d.host.device, &allocate, &made.set); code != VK_SUCCESS) {
        return api_error(code, "vkAllocateDescriptorSets");
    }
    std::array<VkWriteDescriptorSet, bake_slot_count> writes{};
    std::array<VkDescriptorBufferInfo, bake_slot_count> buffers{};
    std::array<VkBufferView, bake_slot_count> texels{};
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < bake_slot_count; ++i) {
        const buffer& from = made.buffers[i == seen_stored_slot ? seen_slot : i];
        const bool packed = made.buffers[words_slot].handle.get() != VK_NULL_HANDLE;
        if (from.handle.get() == VK_NULL_HANDLE || (i == seen_stored_slot && !packed)) {
            continue; // of other routes
        }
        const bool storage = i >= sums_slot;
        buffers[i] = { from.handle.get(), 0, VK_WHOLE_SIZE };
        texels[i] = storage ? VkBufferView{} : made.texels[i].get();
        VkWriteDescriptorSet& write = writes[count++];
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = made.set;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = storage ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
        write.pBufferInfo = &buffers[i];
        write.pTexelBufferView = &texels[i];
    }
    d.call.UpdateDescriptorSets(d.host.device, count, writes.data(), 0, nullptr);
    return std::nullopt;
}

} // namespace

std::optional<error> make_bake_buffers(bake_state& state, const bake_job& job, const bake_request& part, bake_route route,
                                       const detail::bake_room& room, bake_buffers& made)
{
    const device& d = *state.on;
    const detail::bake_gpu_tables t = detail::make_bake_gpu_tables(job, part);
    constexpr VkFormat words = VK_FORMAT_R32G32B32A32_UINT;
    constexpr VkFormat reals = VK_FORMAT_R32G32B32A32_SFLOAT;
    const std::array<table, nodes_slot + 1> tables{
        { { vertices_slot, "the vertices of the bake", std::as_bytes(std::span(t.vertices)), words },
          { triangles_slot, "the triangles of the bake", std::as_bytes(std::span(t.triangles)), words },
          { points_slot, "the points of the bake", std::as_bytes(std::span(t.points)), reals },
          { lines_slot, "the lines of the bake", std::as_bytes(std::span(t.lines)), reals },
          { rotations_slot, "the rotations of the bake", std::as_bytes(std::span(t.rotations)), reals },
          { nodes_slot, "the tree of the bake", std::as_bytes(t.nodes), words } }
    };
    const auto read = std::span(tables).first(route == bake_route::hierarchy ? tables.size() : tables.size() - 1);
    for (const table& each : read) {
        if (auto wrong =
                make_texels(d, each.name, each.format, each.slot, each.content.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, made)) {
            return wrong;
        }
    }
    const std::size_t vertices = part.last_vertex - part.first_vertex;
    if (auto wrong = make_storage(d, "the sums of the bake", sums_slot, vertices * sizeof(bake_sum), made)) {
        return wrong;
    }
    if (room.lines > 0) {
        const std::size_t kept = room.texels() * sizeof(glm::vec4);
        if (auto wrong =
                too_large("the points along lines of the bake", kept, "bytes", d.properties.limits.maxStorageBufferRange)) {
            return wrong;
        }
        if (auto wrong = make_texels(d, "the points along lines of the bake", reals, seen_slot, kept,
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, made)) {
            return wrong;
        }
    }
    if (room.words > 0) {
        if (auto wrong = make_storage(d, "what the bake finds", words_slot, room.words * sizeof(std::uint32_t), made)) {
            return wrong;
        }
    }
    if (auto wrong = upload(state, read, made)) {
        return wrong;
    }
    return make_set(state, made);
}

std::optional<error> read_bake_sums(bake_state& state, const bake_buffers& from, std::span<bake_sum> sums)
{
    if (sums.empty()) {
        return std::nullopt;
    }
    const device& d = *state.on;
    auto to = make_buffer(d, sums.size_bytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    if (!to) {
        return to.error();
    }
    if (auto wrong = state.submit.run([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{ 0, 0, sums.size_bytes() };
            d.call.CmdCopyBuffer(commands, from.buffers[sums_slot].handle.get(), to->handle.get(), 1, &copy);
        })) {
        return wrong;
    }
    return read(d, *to, std::as_writable_bytes(sums));
}

} // namespace ao::vk
