#include "host/vulkan_device.hpp"

#include <algorithm>
#include <cstring>

namespace ao::host {
VkFormat vulkan_format(pixel_format format)
{
    switch (format) {
    case pixel_format::r8:
        return VK_FORMAT_R8_UNORM;
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
    case pixel_format::rg32ui:
        return VK_FORMAT_R32G32_UINT;
    }
    return VK_FORMAT_UNDEFINED;
}

namespace {
VkFormatFeatureFlags format_features(VkPhysicalDevice physical, VkFormat format)
{
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
    return properties.optimalTilingFeatures;
}

VkImageUsageFlags usable_as(VkFormatFeatureFlags features)
{
    VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    if (features & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)
        usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT)
        usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (features & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
        usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return usage;
}

std::string code_text(VkResult code)
{
    return code == VK_ERROR_OUT_OF_DEVICE_MEMORY || code == VK_ERROR_OUT_OF_HOST_MEMORY ? std::string("out of memory")
                                                                                        : "VkResult " + std::to_string(code);
}

VkBufferImageCopy whole_image(VkImageAspectFlags aspect, extent size)
{
    VkBufferImageCopy copy{};
    copy.imageSubresource = { aspect, 0, 0, 1 };
    copy.imageExtent = { size.width, size.height, 1 };
    return copy;
}

VkImageAspectFlags data_aspect(pixel_format format)
{
    return is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}
}

result<vulkan_buffer> vulkan_buffer::create(vulkan_device& device, VkDeviceSize size, VkBufferUsageFlags usage)
{
    vulkan_buffer self;
    self.device_ = device.device;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    VkResult code = vkCreateBuffer(device.device, &info, nullptr, &self.buffer);
    if (code != VK_SUCCESS)
        return failure{ "a buffer of " + std::to_string(size) + " bytes: " + code_text(code) };

    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device.device, self.buffer, &needs);
    const int type =
        device.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = static_cast<uint32_t>(std::max(type, 0));
    code = vkAllocateMemory(device.device, &allocate, nullptr, &self.memory_);
    void* mapped = nullptr;
    if (code == VK_SUCCESS)
        code = vkBindBufferMemory(device.device, self.buffer, self.memory_, 0);
    if (code == VK_SUCCESS)
        code = vkMapMemory(device.device, self.memory_, 0, VK_WHOLE_SIZE, 0, &mapped);
    if (code != VK_SUCCESS)
        return failure{ "a buffer of " + std::to_string(size) + " bytes: " + code_text(code) };
    self.bytes = { static_cast<std::byte*>(mapped), static_cast<std::size_t>(size) };
    return self;
}

vulkan_buffer& vulkan_buffer::operator=(vulkan_buffer&& other) noexcept
{
    std::swap(buffer, other.buffer);
    std::swap(bytes, other.bytes);
    std::swap(device_, other.device_);
    std::swap(memory_, other.memory_);
    return *this;
}

vulkan_buffer::~vulkan_buffer()
{
    if (!device_)
        return;
    vkDestroyBuffer(device_, buffer, nullptr);
    vkFreeMemory(device_, memory_, nullptr);
}

result<vulkan_image> vulkan_image::create(vulkan_device& device, pixel_format format, extent size)
{
    const std::string what =
        std::string("a ") + host::name(format) + " image of " + std::to_string(size.width) + "x" + std::to_string(size.height);
    const uint32_t limit = device.properties.limits.maxImageDimension2D;
    if (size.width == 0 || size.height == 0)
        return failure{ what + " has no pixels" };
    if (size.width > limit || size.height > limit)
        return failure{ what + " exceeds the limit of the device, " + std::to_string(limit) };

    vulkan_image self;
    self.owner_ = &device;
    self.device_ = device.device;
    self.format = format;
    self.size = size;
    self.vk_format = vulkan_format(format);
    VkFormatFeatureFlags features = format_features(device.physical, self.vk_format);
    if (format == pixel_format::d24 && !(features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT)) {
        self.vk_format = VK_FORMAT_D24_UNORM_S8_UINT;
        features = format_features(device.physical, self.vk_format);
    }
    if (!(features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT))
        return failure{ what + ": the device does not support the format" };
    self.usage = usable_as(features);

    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = self.vk_format;
    info.extent = { size.width, size.height, 1 };
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = self.usage;
    VkResult code = vkCreateImage(device.device, &info, nullptr, &self.image);
    if (code != VK_SUCCESS)
        return failure{ what + ": " + code_text(code) };

    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device.device, self.image, &needs);
    const int local = device.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex =
        static_cast<uint32_t>(local >= 0 ? local : std::max(device.memory_type(needs.memoryTypeBits, 0), 0));
    code = vkAllocateMemory(device.device, &allocate, nullptr, &self.memory_);
    if (code == VK_SUCCESS)
        code = vkBindImageMemory(device.device, self.image, self.memory_, 0);

    VkImageViewCreateInfo view_info{};
    view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view_info.image = self.image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = self.vk_format;
    view_info.subresourceRange = { data_aspect(format), 0, 1, 0, 1 };
    if (code == VK_SUCCESS)
        code = vkCreateImageView(device.device, &view_info, nullptr, &self.view);
    if (code != VK_SUCCESS)
        return failure{ what + ": " + code_text(code) };
    return self;
}

vulkan_image& vulkan_image::operator=(vulkan_image&& other) noexcept
{
    std::swap(image, other.image);
    std::swap(view, other.view);
    std::swap(vk_format, other.vk_format);
    std::swap(usage, other.usage);
    std::swap(format, other.format);
    std::swap(size, other.size);
    std::swap(layout, other.layout);
    std::swap(owner_, other.owner_);
    std::swap(device_, other.device_);
    std::swap(memory_, other.memory_);
    return *this;
}

vulkan_image::~vulkan_image()
{
    if (!device_)
        return;
    vkDestroyImageView(device_, view, nullptr);
    vkDestroyImage(device_, image, nullptr);
    vkFreeMemory(device_, memory_, nullptr);
}

VkImageAspectFlags vulkan_image::aspects() const
{
    VkImageAspectFlags all = data_aspect(format);
    if (vk_format == VK_FORMAT_D24_UNORM_S8_UINT)
        all |= VK_IMAGE_ASPECT_STENCIL_BIT;
    return all;
}

void vulkan_image::record_transition(VkCommandBuffer commands, VkImageLayout after)
{
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = layout;
    barrier.newLayout = after;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = { aspects(), 0, 1, 0, 1 };
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0,
                         nullptr, 1, &barrier);
    layout = after;
}

result<done> vulkan_image::transition(VkImageLayout after)
{
    return owner_->submit([&](VkCommandBuffer commands) { record_transition(commands, after); });
}

result<done> vulkan_image::upload(std::span<const std::byte> pixels, VkImageLayout after)
{
    if (pixels.size() != byte_count(format, size))
        return failure{ "upload: " + std::to_string(pixels.size()) + " bytes for an image of " +
                        std::to_string(byte_count(format, size)) };
    auto staging = vulkan_buffer::create(*owner_, pixels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    if (!staging)
        return failure{ staging.reason() };
    std::memcpy(staging->bytes.data(), pixels.data(), pixels.size());
    return owner_->submit([&](VkCommandBuffer commands) {
        record_transition(commands, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        const VkBufferImageCopy copy = whole_image(data_aspect(format), size);
        vkCmdCopyBufferToImage(commands, staging->buffer, image, layout, 1, &copy);
        record_transition(commands, after);
    });
}

result<done> vulkan_image::download(std::span<std::byte> pixels)
{
    if (pixels.size() != byte_count(format, size))
        return failure{ "download: " + std::to_string(pixels.size()) + " bytes for an image of " +
                        std::to_string(byte_count(format, size)) };
    if (layout == VK_IMAGE_LAYOUT_UNDEFINED)
        return failure{ "download: the image was never written" };
    auto staging = vulkan_buffer::create(*owner_, pixels.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    if (!staging)
        return failure{ staging.reason() };
    const VkImageLayout before = layout;
    auto copied = owner_->submit([&](VkCommandBuffer commands) {
        record_transition(commands, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkBufferImageCopy copy = whole_image(data_aspect(format), size);
        vkCmdCopyImageToBuffer(commands, image, layout, staging->buffer, 1, &copy);
        record_transition(commands, before);
        VkMemoryBarrier to_host{};
        to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr, 0,
                             nullptr);
    });
    if (!copied)
        return copied;
    std::memcpy(pixels.data(), staging->bytes.data(), pixels.size());
    if (format == pixel_format::d24)
        for (std::size_t i = 3; i < pixels.size(); i += 4)
            pixels[i] = std::byte{ 0 };
    return done{};
}
}
