#include "temporal_state.hpp"

#include <new>

namespace ao::vk {

namespace {

std::optional<error> wrong_images(const temporal_plan& p, const temporal_images<image>& images)
{
    if (images.depth.view == VK_NULL_HANDLE || images.visibility.view == VK_NULL_HANDLE) {
        return error(errc::plan_mismatch, "depth and visibility need an image view each");
    }
    if (p.facts.frame.normals != normal_source::from_depth && images.normal.view == VK_NULL_HANDLE) {
        return error(errc::plan_mismatch, "the plan reads stored normals, but there is no image view of them");
    }
    if (p.facts.motion && images.motion.view == VK_NULL_HANDLE) {
        return error(errc::plan_mismatch, "the plan reads motion, but there is no image view of it");
    }
    if (images.visibility.layout != VK_IMAGE_LAYOUT_GENERAL) {
        return error(errc::plan_mismatch, "visibility is written in VK_IMAGE_LAYOUT_GENERAL");
    }
    return std::nullopt;
}

// What the slots of one set hold; a slot without either is left alone.
struct set_content {
    std::array<VkDescriptorImageInfo, temporal_slot_count> pictures{};
    std::array<VkDescriptorBufferInfo, temporal_slot_count> buffers{};
    std::array<VkBufferView, temporal_slot_count> texels{};
};

VkDescriptorImageInfo own(const picture& p)
{
    return { VK_NULL_HANDLE, p.view.get(), VK_IMAGE_LAYOUT_GENERAL };
}

void set_target(set_content& content, const temporal_program_state& program, temporal_pass_type type,
                const VkDescriptorImageInfo& visibility)
{
    switch (type) {
    case temporal_pass_type::linearize:
        content.pictures[target_slot] = own(program.eye_depth);
        break;
    case temporal_pass_type::accumulate:
        break;
    case temporal_pass_type::filter_rows:
        content.pictures[target_slot] = own(program.rows);
        break;
    case temporal_pass_type::filter_columns:
    case temporal_pass_type::resolve:
        content.pictures[target_slot] = visibility;
        break;
    }
}

set_content content_of(const temporal_program_state& program, const temporal_images<image>& images, temporal_pass_type type,
                       int written)
{
    const auto info = [](const image& i) { return VkDescriptorImageInfo{ VK_NULL_HANDLE, i.view, i.layout }; };
    const auto whole = [](const buffer& b) { return VkDescriptorBufferInfo{ b.handle.get(), 0, VK_WHOLE_SIZE }; };
    const temporal_plan& p = program.plan;
    set_content c;
    const bool own_depth = type != temporal_pass_type::linearize && program.eye_depth.view.get() != VK_NULL_HANDLE;
    c.pictures[source_slot] = own_depth ? own(program.eye_depth) : info(images.depth);
    // The shader names pictures even where the options take them out of use; any will do then.
    c.pictures[normals_slot] = p.facts.frame.normals == normal_source::from_depth ? c.pictures[source_slot] : info(images.normal);
    c.pictures[motion_slot] = p.facts.motion ? info(images.motion) : c.pictures[source_slot];
    set_target(c, program, type, info(images.visibility));
    if (own_depth) {
        c.pictures[stored_depth_slot] = own(program.eye_depth);
    }
    if (program.rows.view.get() != VK_NULL_HANDLE) {
        c.pictures[rows_slot] = own(program.rows);
    }
    c.buffers[constants_slot] = whole(program.constants);
    c.buffers[tiles_slot] = whole(program.tiles);
    c.texels[rotations_slot] = program.rotations.get();
    c.texels[taps_slot] = program.taps.get();
    const bool accumulates = type == temporal_pass_type::accumulate;
    c.texels[history_slot] = program.history_texels[static_cast<std::size_t>(accumulates ? 1 - written : written)].get();
    if (accumulates) {
        c.buffers[written_slot] = whole(program.histories[static_cast<std::size_t>(written)]);
    }
    return c;
}

void write_set(const device& d, VkDescriptorSet set, const set_content& content)
{
    std::array<VkWriteDescriptorSet, temporal_slot_count> writes{};
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < temporal_slot_count; ++i) {
        const VkDescriptorImageInfo& picture = content.pictures[i];
        const VkDescriptorBufferInfo& buffer = content.buffers[i];
        if (picture.imageView == VK_NULL_HANDLE && buffer.buffer == VK_NULL_HANDLE && content.texels[i] == VK_NULL_HANDLE) {
            continue;
        }
        VkWriteDescriptorSet& write = writes[count++];
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = type_of(static_cast<temporal_slot>(i));
        write.pImageInfo = &picture;
        write.pBufferInfo = &buffer;
        write.pTexelBufferView = &content.texels[i];
    }
    d.call.UpdateDescriptorSets(d.host.device, count, writes.data(), 0, nullptr);
}

std::optional<error> make_sets(const device& d, const temporal_program_state& program, std::uint32_t count,
                               temporal_binding_state& made)
{
    std::array<VkDescriptorPoolSize, temporal_slot_count> sizes{};
    for (std::uint32_t i = 0; i < temporal_slot_count; ++i) {
        sizes[i] = { type_of(static_cast<temporal_slot>(i)), count };
    }
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = count;
    pool.poolSizeCount = temporal_slot_count;
    pool.pPoolSizes = sizes.data();
    AO_VK_CREATE(made.pool, d, DescriptorPool, pool);

    std::array<VkDescriptorSetLayout, temporal_binding_state::most_sets> layouts{};
    layouts.fill(program.set_layout.get());
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = made.pool.get();
    allocate.descriptorSetCount = count;
    allocate.pSetLayouts = layouts.data();
    if (const VkResult code = d.call.AllocateDescriptorSets(d.host.device, &allocate, made.sets.data()); code != VK_SUCCESS) {
        return api_error(code, "vkAllocateDescriptorSets");
    }
    return std::nullopt;
}

} // namespace

result<temporal_binding> temporal::bind_temporal(temporal_program& program, const temporal_plan& p,
                                                 const temporal_images<image>& images)
{
    const device& d = *device_;
    const temporal_program_state& from = *program.state_;
    if (!same_program(from.plan, p)) {
        return error(errc::plan_mismatch, "the program was prepared for a plan of another structure");
    }
    if (const auto wrong = wrong_images(p, images)) {
        return *wrong;
    }
    std::unique_ptr<temporal_binding_state> made(new (std::nothrow) temporal_binding_state);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    const std::size_t steps = p.steps.size();
    if (const auto wrong = make_sets(d, from, static_cast<std::uint32_t>(2 * steps + (from.copies_depth ? 1 : 0)), *made)) {
        return *wrong;
    }
    for (std::size_t i = 0; i < steps; ++i) {
        for (const int written : { 0, 1 }) {
            write_set(d, made->sets[set_of(i, written)], content_of(from, images, p.steps[i].type, written));
        }
    }
    if (from.copies_depth) {
        write_set(d, made->sets[2 * steps], content_of(from, images, temporal_pass_type::linearize, 0));
    }
    return temporal_binding(std::move(made));
}

} // namespace ao::vk
