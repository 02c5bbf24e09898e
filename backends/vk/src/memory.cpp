#include "memory.hpp"

#include "ao/kernel.hpp"

#include <cstring>

namespace ao::vk {

namespace {

// A type among `allowed` with as many of the wishes as there are, in order of their weight; negative without `needed`.
int memory_type(const device& d, std::uint32_t allowed, VkMemoryPropertyFlags needed, VkMemoryPropertyFlags wished)
{
    int found = -1;
    for (std::uint32_t i = 0; i < d.memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags has = d.memory.memoryTypes[i].propertyFlags;
        if ((allowed >> i & 1U) == 0 || (has & needed) != needed) {
            continue;
        }
        if ((has & wished) == wished) {
            return static_cast<int>(i);
        }
        if (found < 0) {
            found = static_cast<int>(i);
        }
    }
    return found;
}

result<owned<VkDeviceMemory>> allocate(const device& d, VkDeviceSize size, std::uint32_t allowed, VkMemoryPropertyFlags needed)
{
    const int type = memory_type(d, allowed, needed, needed | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type < 0) {
        return error(errc::device, "the device has no fitting type of memory");
    }
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = size;
    info.memoryTypeIndex = static_cast<std::uint32_t>(type);
    return create<VkDeviceMemory>(d, d.call.AllocateMemory, d.call.FreeMemory, info, "vkAllocateMemory");
}

} // namespace

VkFormat native_format(pixel_format format)
{
    switch (format) {
    case pixel_format::r32f:
        return VK_FORMAT_R32_SFLOAT;
    case pixel_format::rg32f:
        return VK_FORMAT_R32G32_SFLOAT;
    case pixel_format::rgba16f:
        return VK_FORMAT_R16G16B16A16_SFLOAT;
    case pixel_format::rgba32f:
        return VK_FORMAT_R32G32B32A32_SFLOAT;
    case pixel_format::rgb10a2:
        return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    case pixel_format::rg16:
        return VK_FORMAT_R16G16_UNORM;
    case pixel_format::d32f:
        return VK_FORMAT_D32_SFLOAT;
    case pixel_format::d24:
        return VK_FORMAT_X8_D24_UNORM_PACK32;
    case pixel_format::r8:
        return VK_FORMAT_R8_UNORM;
    case pixel_format::rg32ui:
        return VK_FORMAT_R32G32_UINT;
    }
    return VK_FORMAT_UNDEFINED;
}

result<tables> make_tables(const device& d, const plan& p)
{
    const auto kernel = make_kernel(p.settings.kernel, p.settings.taps, p.settings.seed);
    const auto tile = make_rotation_tile(p.settings.seed);
    static_assert(sizeof(kernel) == tables::kernel_bytes && sizeof(glm::vec2) == 8);

    tables made;
    VkBufferCreateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    buffer.size = sizeof(kernel) + sizeof(tile);
    buffer.usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    AO_VK_CREATE(made.buffer, d, Buffer, buffer);

    VkMemoryRequirements needs{};
    d.call.GetBufferMemoryRequirements(d.host.device, made.buffer.get(), &needs);
    auto memory =
        allocate(d, needs.size, needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    if (!memory) {
        return memory.error();
    }
    made.memory = std::move(*memory);
    if (const VkResult code = d.call.BindBufferMemory(d.host.device, made.buffer.get(), made.memory.get(), 0);
        code != VK_SUCCESS) {
        return api_error(code, "vkBindBufferMemory");
    }
    void* mapped = nullptr;
    if (const VkResult code = d.call.MapMemory(d.host.device, made.memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped);
        code != VK_SUCCESS) {
        return api_error(code, "vkMapMemory");
    }
    std::memcpy(mapped, kernel.data(), sizeof(kernel));
    std::memcpy(static_cast<std::byte*>(mapped) + sizeof(kernel), tile.data(), sizeof(tile));
    d.call.UnmapMemory(d.host.device, made.memory.get());

    // 16384 is a multiple of every offset alignment that Vulkan allows (at most 256).
    VkBufferViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    view.buffer = made.buffer.get();
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
        info.extent = { static_cast<std::uint32_t>(p.facts.width), static_cast<std::uint32_t>(p.facts.height), 1 };
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
