#include "program.hpp"

#include <new>

namespace ao::vk {

namespace {

VkDescriptorImageInfo picture_of(image_id id, const prepared& program, const host_images<image>& images)
{
    switch (id) {
    case image_id::depth:
        return { VK_NULL_HANDLE, images.depth.view, images.depth.layout };
    case image_id::normal:
        return { VK_NULL_HANDLE, images.normal.view, images.normal.layout };
    case image_id::visibility:
        return { VK_NULL_HANDLE, images.visibility.view, VK_IMAGE_LAYOUT_GENERAL };
    default:
        break;
    }
    for (std::size_t i = 0; i < program.transients.ids.size(); ++i) {
        if (program.transients.ids[i] == id) {
            return { VK_NULL_HANDLE, program.transients.pictures[i].view.get(), VK_IMAGE_LAYOUT_GENERAL };
        }
    }
    return {};
}

void write_set(const device& d, VkDescriptorSet set, const pass& each, const prepared& program, const host_images<image>& images)
{
    const bool stored_source = is_stored(d, each);
    const VkDescriptorImageInfo first = picture_of(each.inputs[0], program, images);
    // The shader names a picture of normals even where the options take it out of use; any picture will do then.
    const VkDescriptorImageInfo second = each.inputs[1] == image_id::none ? first : picture_of(each.inputs[1], program, images);
    const bool coarse = each.inputs[2] != image_id::none && each.inputs[2] != image_id::rotation;
    const VkDescriptorImageInfo third = coarse ? picture_of(each.inputs[2], program, images) : first;
    const VkDescriptorImageInfo output = picture_of(each.output, program, images);
    const VkDescriptorBufferInfo kernel{ program.tables.own.handle.get(), 0, tables::kernel_bytes };
    const VkBufferView rotations = program.tables.rotations.get();

    std::array<VkWriteDescriptorSet, 6> writes{};
    for (std::uint32_t i = 0; i < writes.size(); ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
    }
    writes[0].dstBinding = stored_source ? 5 : 0;
    writes[0].descriptorType = stored_source ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    writes[0].pImageInfo = &first;
    writes[1].descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    writes[1].pImageInfo = &second;
    writes[2].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    writes[2].pBufferInfo = &kernel;
    writes[3].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    writes[3].pTexelBufferView = &rotations;
    writes[4].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    writes[4].pImageInfo = &output;
    writes[5].dstBinding = 6;
    writes[5].descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    writes[5].pImageInfo = &third;
    d.call.UpdateDescriptorSets(d.host.device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

std::optional<error> wrong_images(const plan& p, const host_images<image>& images)
{
    if (images.depth.view == VK_NULL_HANDLE || images.visibility.view == VK_NULL_HANDLE) {
        return error(errc::plan_mismatch, "depth and visibility need an image view each");
    }
    if (p.facts.normals != normal_source::from_depth && images.normal.view == VK_NULL_HANDLE) {
        return error(errc::plan_mismatch, "the plan reads stored normals, but there is no image view of them");
    }
    if (images.visibility.layout != VK_IMAGE_LAYOUT_GENERAL) {
        return error(errc::plan_mismatch, "visibility is written in VK_IMAGE_LAYOUT_GENERAL");
    }
    return std::nullopt;
}

} // namespace

result<binding> backend::bind(program& p, const plan& current, const host_images<image>& images)
{
    const device& d = *device_;
    const prepared& ready = *p.prepared_;
    if (!same_structure(ready.given, current)) {
        return error(errc::plan_mismatch, "the program was prepared for a plan of another structure");
    }
    if (const auto wrong = wrong_images(current, images)) {
        return *wrong;
    }
    std::unique_ptr<bound> made(new (std::nothrow) bound);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }

    const auto count = static_cast<std::uint32_t>(ready.executed.passes.size());
    const std::array<VkDescriptorPoolSize, 4> sizes{ { { VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 3 * count },
                                                       { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count },
                                                       { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, count },
                                                       { VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 2 * count } } };
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = count;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    AO_VK_CREATE(made->pool, d, DescriptorPool, pool);

    std::array<VkDescriptorSetLayout, 4> layouts{};
    layouts.fill(ready.set_layout.get());
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = made->pool.get();
    allocate.descriptorSetCount = count;
    allocate.pSetLayouts = layouts.data();
    if (const VkResult code = d.call.AllocateDescriptorSets(d.host.device, &allocate, made->sets.data()); code != VK_SUCCESS) {
        return api_error(code, "vkAllocateDescriptorSets");
    }
    for (std::size_t i = 0; i < count; ++i) {
        write_set(d, made->sets[i], ready.executed.passes[i], ready, images);
    }
    return binding(std::move(made));
}

} // namespace ao::vk
