#include "raster_state.hpp"
#include "support.hpp"

#include "ao/texture.hpp"

#include <algorithm>
#include <cstdio>
#include <new>
#include <utility>

namespace ao::vk {

namespace {

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values)
{
    return std::as_bytes(std::span(values));
}

std::optional<error> unsupported(const device& d, const gbuffer_facts& f)
{
    if (const auto wrong = wrong_attachment_size(d, f.width, f.height)) {
        return wrong;
    }
    if (!can_draw(d, f.depth_format)) {
        return lacks("draw to", f.depth_format);
    }
    std::uint32_t colors = 0;
    for (const raster_target& each : targets_of(f)) {
        if (each.wanted && !can_draw(d, each.format)) {
            return lacks("draw to", each.format);
        }
        colors += each.wanted ? 1U : 0U;
    }
    if (colors > d.properties.limits.maxColorAttachments) {
        char text[128];
        std::snprintf(text, sizeof text, "the plan draws to %u color attachments, the Vulkan device has %u", colors,
                      d.properties.limits.maxColorAttachments);
        return error(errc::device, text);
    }
    return std::nullopt;
}

// Makes buffers until one fails.
class buffer_maker {
public:
    explicit buffer_maker(const device& d) : d_(&d) {}

    void fill(buffer& to, std::span<const std::byte> bytes, VkBufferUsageFlags usage)
    {
        if (!failed_) {
            take(to, make_buffer(*d_, std::max<std::size_t>(bytes.size(), 16), usage));
        }
        if (!failed_) {
            failed_ = write(*d_, to, 0, bytes);
        }
    }
    void table(buffer& to, const char* what, std::span<const std::byte> bytes, VkBufferUsageFlags more = 0)
    {
        if (!failed_) {
            take(to, make_table(*d_, what, bytes, more));
        }
    }
    const std::optional<error>& failed() const { return failed_; }

private:
    void take(buffer& to, result<buffer> made)
    {
        if (made) {
            to = std::move(*made);
        }
        else {
            failed_ = made.error();
        }
    }

    const device* d_;
    std::optional<error> failed_;
};

std::optional<error> too_large(const device& d, const mesh_arrays& arrays)
{
    if (arrays.too_large) {
        return error(errc::out_of_memory, "the meshes have more than 2^31 vertices or indices");
    }
    const auto last = std::max_element(arrays.indices.begin(), arrays.indices.end());
    const std::uint32_t limit = d.properties.limits.maxDrawIndexedIndexValue;
    if (last != arrays.indices.end() && *last > limit) {
        char text[128];
        std::snprintf(text, sizeof text, "a mesh has vertex %u, the Vulkan device draws up to %u", *last, limit);
        return error(errc::invalid_size, text);
    }
    return std::nullopt;
}

std::optional<error> upload_meshes(const device& d, const scene& s, const draw_plan& p, bool hardware, raster_model_state& into)
{
    const mesh_arrays arrays = gather_meshes(s, p);
    if (const auto wrong = too_large(d, arrays)) {
        return wrong;
    }
    buffer_maker buffers(d);
    for (std::size_t i = 0; i < vertex_attribute_count; ++i) {
        if (!arrays.streams[i].empty()) {
            buffers.fill(into.attributes[i], bytes_of(arrays.streams[i]), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        }
    }
    buffers.fill(into.indices, bytes_of(arrays.indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    into.draws = make_draws(s, p, arrays, hardware);
    into.draw_calls = into.draws.draws.size();
    if (draws_indirectly(d)) {
        buffers.fill(into.indirect, bytes_of(into.draws.draws), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
        into.draw_calls = 0;
        for (const draw_batch& batch : into.draws.batches) {
            into.draw_calls += (batch.count - 1) / d.properties.limits.maxDrawIndirectCount + 1;
        }
    }
    return buffers.failed();
}

std::optional<error> upload_tables(const device& d, const scene& s, const draw_plan& p, const map_places& maps, bool hardware,
                                   raster_model_state& into)
{
    buffer_maker buffers(d);
    std::vector<geometry_instance> instances;
    std::vector<affine_map> previous;
    instances.reserve(into.objects.size());
    for (const drawn_object& o : into.objects) {
        instances.push_back(make_instance(s, o));
        if (p.facts.motion) {
            previous.push_back(make_previous_model(s, o));
        }
    }
    buffers.table(into.instances, "the table of objects", bytes_of(instances), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    buffers.table(into.previous, "the table of last frame's objects", bytes_of(previous), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    const bool reads = std::any_of(p.variants.begin(), p.variants.end(), reads_maps);
    buffers.table(into.materials, "the table of materials",
                  bytes_of(reads ? make_drawn_materials(s, maps) : std::vector<drawn_material>()));
    texel_heap heap;
    if (reads && !hardware) {
        result<texel_heap> made = make_texel_heap(maps.textures);
        if (!made) {
            return made.error();
        }
        heap = std::move(*made);
    }
    buffers.table(into.heap, "the heap of textures", bytes_of(heap.words));
    const std::array<geometry_camera, 1> camera{};
    buffers.fill(into.camera, std::as_bytes(std::span(camera)),
                 VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    return buffers.failed();
}

std::optional<error> make_set(const device& d, raster_model_state& into)
{
    const std::array<VkDescriptorPoolSize, 2> sizes{ { { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1 },
                                                       { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, raster_slot_count - 1 } } };
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    AO_VK_CREATE(into.pool, d, DescriptorPool, pool);
    const VkDescriptorSetLayout layout = into.set_layout.get();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = into.pool.get();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    if (const VkResult code = d.call.AllocateDescriptorSets(d.host.device, &allocate, &into.set); code != VK_SUCCESS) {
        return api_error(code, "vkAllocateDescriptorSets");
    }
    const std::array<VkBuffer, raster_slot_count> buffers{ into.camera.handle.get(), into.instances.handle.get(),
                                                           into.previous.handle.get(), into.materials.handle.get(),
                                                           into.heap.handle.get() };
    std::array<VkDescriptorBufferInfo, raster_slot_count> infos{};
    std::array<VkWriteDescriptorSet, raster_slot_count> writes{};
    for (std::uint32_t i = 0; i < raster_slot_count; ++i) {
        infos[i] = { buffers[i], 0, VK_WHOLE_SIZE };
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = into.set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = i == camera_slot ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        writes[i].pBufferInfo = &infos[i];
    }
    d.call.UpdateDescriptorSets(d.host.device, raster_slot_count, writes.data(), 0, nullptr);
    return std::nullopt;
}

} // namespace

bool draws_indirectly(const device& d)
{
    return d.host.enabled.multi_draw_indirect && d.host.enabled.draw_indirect_first_instance;
}

result<raster_model> rasterizer::load(const scene& s, const draw_plan& p)
{
    const device& d = *device_;
    if (const auto wrong = unsupported(d, p.facts)) {
        return *wrong;
    }
    std::unique_ptr<raster_model_state> made(new (std::nothrow) raster_model_state);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    made->facts = p.facts;
    made->variants = p.variants;
    made->scene_objects = s.objects.size();
    made->objects = make_drawn_objects(p);
    const bool hardware = options_.sampling == sampling::hardware;
    const map_places maps = find_maps(s, p);
    if (const auto wrong = upload_meshes(d, s, p, hardware, *made)) {
        return *wrong;
    }
    if (const auto wrong = upload_tables(d, s, p, maps, hardware, *made)) {
        return *wrong;
    }
    // Strides of the vertices are part of the pipelines.
    if (const auto wrong = make_pipelines(d, options_.sampling, p, *made)) {
        return *wrong;
    }
    if (const auto wrong = make_set(d, *made)) {
        return *wrong;
    }
    if (hardware) {
        if (const auto wrong = make_sampled_maps(d, s, maps, *made)) {
            return *wrong;
        }
    }
    return raster_model(std::move(made));
}

} // namespace ao::vk
