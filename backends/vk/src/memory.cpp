#include "memory.hpp"

#include "ao/kernel.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace ao::vk {

namespace {

bool fits(const device& d, std::uint32_t type, std::uint32_t allowed, VkMemoryPropertyFlags needed)
{
    return (allowed >> type & 1U) != 0 && (d.memory.memoryTypes[type].propertyFlags & needed) == needed;
}

// In the device's own memory where there is room for it, else in any that fits.
result<owned<VkDeviceMemory>> allocate(const device& d, VkDeviceSize size, std::uint32_t allowed, VkMemoryPropertyFlags needed)
{
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = size;
    const VkMemoryPropertyFlags local = needed | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    error last(errc::device, "the device has no fitting type of memory");
    for (const bool wish : { true, false }) {
        for (std::uint32_t i = 0; i < d.memory.memoryTypeCount; ++i) {
            if (!fits(d, i, allowed, needed) || fits(d, i, allowed, local) != wish ||
                size > d.memory.memoryHeaps[d.memory.memoryTypes[i].heapIndex].size) {
                continue;
            }
            info.memoryTypeIndex = i;
            auto made = create<VkDeviceMemory>(d, d.call.AllocateMemory, d.call.FreeMemory, info, "vkAllocateMemory");
            if (made) {
                return made;
            }
            last = made.error();
        }
    }
    return last;
}

} // namespace

result<buffer> make_buffer(const device& d, VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags needed)
{
    buffer made;
    made.size = size;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    AO_VK_CREATE(made.handle, d, Buffer, info);
    VkMemoryRequirements needs{};
    d.call.GetBufferMemoryRequirements(d.host.device, made.handle.get(), &needs);
    auto memory = allocate(d, needs.size, needs.memoryTypeBits, needed);
    if (!memory) {
        return memory.error();
    }
    made.memory = std::move(*memory);
    if (const VkResult code = d.call.BindBufferMemory(d.host.device, made.handle.get(), made.memory.get(), 0);
        code != VK_SUCCESS) {
        return api_error(code, "vkBindBufferMemory");
    }
    return made;
}

std::optional<error> write(const device& d, const buffer& to, VkDeviceSize offset, std::span<const std::byte> bytes)
{
    if (bytes.empty()) {
        return std::nullopt;
    }
    void* mapped = nullptr;
    if (const VkResult code = d.call.MapMemory(d.host.device, to.memory.get(), offset, bytes.size(), 0, &mapped);
        code != VK_SUCCESS) {
        return api_error(code, "vkMapMemory");
    }
    std::memcpy(mapped, bytes.data(), bytes.size());
    d.call.UnmapMemory(d.host.device, to.memory.get());
    return std::nullopt;
}

std::optional<error> read(const device& d, const buffer& from, std::span<std::byte> bytes)
{
    void* mapped = nullptr;
    if (const VkResult code = d.call.MapMemory(d.host.device, from.memory.get(), 0, bytes.size(), 0, &mapped);
        code != VK_SUCCESS) {
        return api_error(code, "vkMapMemory");
    }
    std::memcpy(bytes.data(), mapped, bytes.size());
    d.call.UnmapMemory(d.host.device, from.memory.get());
    return std::nullopt;
}

result<buffer> make_table(const device& d, const char* what, std::span<const std::byte> bytes, VkBufferUsageFlags more)
{
    if (bytes.size() > d.properties.limits.maxStorageBufferRange) {
        char text[160];
        std::snprintf(text, sizeof text, "%s takes %zu bytes, a storage buffer of the Vulkan device at most %u", what,
                      bytes.size(), d.properties.limits.maxStorageBufferRange);
        return error(errc::out_of_memory, text);
    }
    // Nothing can be bound as nothing.
    auto made = make_buffer(d, std::max<std::size_t>(bytes.size(), 16), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | more);
    if (!made) {
        return made;
    }
    if (const auto wrong = write(d, *made, 0, bytes)) {
        return *wrong;
    }
    return made;
}

result<picture> make_picture(const device& d, const picture_shape& shape)
{
    picture made;
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = shape.format;
    info.extent = { shape.width, shape.height, 1 };
    info.mipLevels = shape.levels;
    info.arrayLayers = shape.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = shape.usage;
    AO_VK_CREATE(made.image, d, Image, info);
    VkMemoryRequirements needs{};
    d.call.GetImageMemoryRequirements(d.host.device, made.image.get(), &needs);
    auto memory = allocate(d, needs.size, needs.memoryTypeBits, 0);
    if (!memory) {
        return memory.error();
    }
    made.memory = std::move(*memory);
    if (const VkResult code = d.call.BindImageMemory(d.host.device, made.image.get(), made.memory.get(), 0); code != VK_SUCCESS) {
        return api_error(code, "vkBindImageMemory");
    }
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = made.image.get();
    view.viewType = shape.view;
    view.format = shape.format;
    view.subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, shape.levels, 0, shape.layers };
    AO_VK_CREATE(made.view, d, ImageView, view);
    return made;
}

result<tables> make_tables(const device& d, const plan& p)
{
    const auto kernel = make_taps(p.settings);
    const auto tile = make_tile(p.settings);
    static_assert(sizeof(kernel) == tables::kernel_bytes && sizeof(glm::vec2) == 8);

    tables made;
    auto own = make_buffer(d, sizeof(kernel) + sizeof(tile),
                           VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    if (!own) {
        return own.error();
    }
    made.own = std::move(*own);
    if (const auto wrong = write(d, made.own, 0, std::as_bytes(std::span(kernel)))) {
        return *wrong;
    }
    if (const auto wrong = write(d, made.own, sizeof(kernel), std::as_bytes(std::span(tile)))) {
        return *wrong;
    }

    // 16384 is a multiple of every offset alignment that Vulkan allows (at most 256).
    VkBufferViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    view.buffer = made.own.handle.get();
    view.format = VK_FORMAT_R32G32_SFLOAT;
    view.offset = tables::kernel_bytes;
    view.range = sizeof(tile);
    AO_VK_CREATE(made.rotations, d, BufferView, view);
    return made;
}

result<transients> make_transients(const device& d, const plan& p)
{
    transients made;
    std::array<VkDeviceSize, 3> offsets{};
    VkDeviceSize size = 0;
    std::uint32_t allowed = ~0U;
    for (const transient_image& each : p.transients) {
        const std::size_t i = made.ids.size();
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = native_format(each.format);
        info.extent = { static_cast<std::uint32_t>(each.width), static_cast<std::uint32_t>(each.height), 1 };
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.tiling = VK_IMAGE_TILING_OPTIMAL;
        info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
        AO_VK_CREATE(made.pictures[i].image, d, Image, info);

        VkMemoryRequirements needs{};
        d.call.GetImageMemoryRequirements(d.host.device, made.pictures[i].image.get(), &needs);
        offsets[i] = (size + needs.alignment - 1) / needs.alignment * needs.alignment;
        size = offsets[i] + needs.size;
        allowed &= needs.memoryTypeBits;
        made.ids.push_back(each.id);
    }
    if (made.ids.empty()) {
        return made;
    }
    auto memory = allocate(d, size, allowed, 0);
    if (!memory) {
        return memory.error();
    }
    made.memory = std::move(*memory);
    for (std::size_t i = 0; i < made.ids.size(); ++i) {
        const VkImage image = made.pictures[i].image.get();
        if (const VkResult code = d.call.BindImageMemory(d.host.device, image, made.memory.get(), offsets[i]);
            code != VK_SUCCESS) {
            return api_error(code, "vkBindImageMemory");
        }
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = image;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = native_format(p.transients[i].format);
        view.subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 };
        AO_VK_CREATE(made.pictures[i].view, d, ImageView, view);
    }
    return made;
}

} // namespace ao::vk
