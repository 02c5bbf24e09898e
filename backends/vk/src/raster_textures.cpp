#include "raster_state.hpp"

#include "ao/texture.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace ao::vk {

namespace {

VkSamplerAddressMode addressing(std::size_t mode)
{
    constexpr std::array<VkSamplerAddressMode, 3> modes{ VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                                         VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT };
    return modes[mode];
}

std::size_t sampler_of(const texture& t)
{
    return 3 * static_cast<std::size_t>(t.wrap_v) + static_cast<std::size_t>(t.wrap_u);
}

std::optional<error> make_sampler(const device& d, const texture& t, sampled_maps& maps)
{
    owned<VkSampler>& sampler = maps.samplers[sampler_of(t)];
    if (sampler.get() != VK_NULL_HANDLE) {
        return std::nullopt;
    }
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = VK_FILTER_LINEAR;
    info.minFilter = VK_FILTER_LINEAR;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.addressModeU = addressing(static_cast<std::size_t>(t.wrap_u));
    info.addressModeV = addressing(static_cast<std::size_t>(t.wrap_v));
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    AO_VK_CREATE(sampler, d, Sampler, info);
    return std::nullopt;
}

// A picture with the levels that the heap has, whose texels are appended to `words`.
std::optional<error> add_picture(const device& d, const texture& t, std::vector<std::uint32_t>& words, sampled_maps& maps)
{
    using layout = ao::detail::heap_layout;
    const auto limit = static_cast<int>(std::min(d.properties.limits.maxImageDimension2D, 65536U));
    if (t.width > limit || t.height > limit) {
        char text[128];
        std::snprintf(text, sizeof text, "a texture of %dx%d, the Vulkan device takes %d", t.width, t.height, limit);
        return error(errc::invalid_size, text);
    }
    const result<texel_heap> heap = make_texel_heap({ &t, 1 });
    if (!heap) {
        return heap.error();
    }
    const std::uint32_t* descriptor = heap->words.data() + layout::ao_heap_table;
    picture_shape shape;
    shape.format = t.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
    shape.width = static_cast<std::uint32_t>(t.width);
    shape.height = static_cast<std::uint32_t>(t.height);
    shape.levels = descriptor[2];
    shape.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    auto made = make_picture(d, shape);
    if (!made) {
        return made.error();
    }
    maps.pictures.push_back(std::move(*made));
    maps.copies_of.push_back(shape.levels);
    for (std::uint32_t level = 0; level < shape.levels; ++level) {
        const std::uint32_t width = std::max(shape.width >> level, 1U);
        const std::uint32_t height = std::max(shape.height >> level, 1U);
        const std::uint32_t* texels =
            heap->words.data() + descriptor[static_cast<std::size_t>(layout::ao_descriptor_levels) + level];
        VkBufferImageCopy copy{};
        copy.bufferOffset = words.size() * sizeof(std::uint32_t);
        copy.imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1 };
        copy.imageExtent = { width, height, 1 };
        maps.copies.push_back(copy);
        words.insert(words.end(), texels, texels + std::size_t{ width } * height);
    }
    return make_sampler(d, t, maps);
}

// Sets of the batches that read maps.
std::optional<error> make_sets(const device& d, const scene& s, const map_places& found, raster_model_state& into)
{
    sampled_maps& maps = into.maps;
    const auto reading = static_cast<std::uint32_t>(std::count_if(into.draws.batches.begin(), into.draws.batches.end(),
                                                                  [](const draw_batch& b) { return b.material != no_texture; }));
    const VkDescriptorPoolSize size{ VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2 * reading };
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = reading;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    AO_VK_CREATE(maps.pool, d, DescriptorPool, pool);
    for (const draw_batch& batch : into.draws.batches) {
        maps.sets.push_back(VK_NULL_HANDLE);
        if (batch.material == no_texture) {
            continue;
        }
        const VkDescriptorSetLayout layout = into.maps_layout.get();
        VkDescriptorSetAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        allocate.descriptorPool = maps.pool.get();
        allocate.descriptorSetCount = 1;
        allocate.pSetLayouts = &layout;
        if (const VkResult code = d.call.AllocateDescriptorSets(d.host.device, &allocate, &maps.sets.back());
            code != VK_SUCCESS) {
            return api_error(code, "vkAllocateDescriptorSets");
        }
        const draw_variant& v = into.variants[batch.variant];
        const standard_material& m = s.materials[static_cast<std::size_t>(batch.material)];
        // The shader names both maps even where it reads one; the other will do then.
        const std::array<int, 2> read{ v.alpha_map ? m.alpha_map : m.normal_map, v.normal_map ? m.normal_map : m.alpha_map };
        std::array<VkDescriptorImageInfo, 2> infos{};
        std::array<VkWriteDescriptorSet, 2> writes{};
        for (std::uint32_t i = 0; i < 2; ++i) {
            const auto place = static_cast<std::size_t>(found.places[static_cast<std::size_t>(read[i])]);
            infos[i] = { maps.samplers[sampler_of(found.textures[place])].get(), maps.pictures[place].view.get(),
                         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL };
            writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
            writes[i].dstSet = maps.sets.back();
            writes[i].dstBinding = i;
            writes[i].descriptorCount = 1;
            writes[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            writes[i].pImageInfo = &infos[i];
        }
        d.call.UpdateDescriptorSets(d.host.device, 2, writes.data(), 0, nullptr);
    }
    return std::nullopt;
}

void change_layout(const device& d, VkCommandBuffer commands, const picture& of, bool before)
{
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = before ? 0 : VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = before ? VK_ACCESS_TRANSFER_WRITE_BIT : VK_ACCESS_SHADER_READ_BIT;
    barrier.oldLayout = before ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.newLayout = before ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = of.image.get();
    barrier.subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, 1 };
    d.call.CmdPipelineBarrier(commands, before ? VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT : VK_PIPELINE_STAGE_TRANSFER_BIT,
                              before ? VK_PIPELINE_STAGE_TRANSFER_BIT : VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr, 0,
                              nullptr, 1, &barrier);
}

} // namespace

std::optional<error> make_sampled_maps(const device& d, const scene& s, const map_places& found, raster_model_state& into)
{
    if (found.textures.empty()) {
        return std::nullopt;
    }
    std::vector<std::uint32_t> words;
    for (const texture& t : found.textures) {
        if (const auto wrong = add_picture(d, t, words, into.maps)) {
            return wrong;
        }
    }
    const auto bytes = std::as_bytes(std::span(words));
    auto texels = make_buffer(d, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    if (!texels) {
        return texels.error();
    }
    into.maps.texels = std::move(*texels);
    if (const auto wrong = write(d, into.maps.texels, 0, bytes)) {
        return wrong;
    }
    return make_sets(d, s, found, into);
}

void upload_maps(const device& d, VkCommandBuffer commands, sampled_maps& maps)
{
    std::size_t first = 0;
    for (std::size_t i = 0; i < maps.pictures.size(); ++i) {
        change_layout(d, commands, maps.pictures[i], true);
        d.call.CmdCopyBufferToImage(commands, maps.texels.handle.get(), maps.pictures[i].image.get(),
                                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, maps.copies_of[i], maps.copies.data() + first);
        change_layout(d, commands, maps.pictures[i], false);
        first += maps.copies_of[i];
    }
    maps.uploaded = true;
}

} // namespace ao::vk
