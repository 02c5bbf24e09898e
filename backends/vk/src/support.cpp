#include "support.hpp"

#include <algorithm>
#include <cstdio>

namespace ao::vk {

namespace {

const char* name(pixel_format format)
{
    constexpr const char* names[] = { "r32f", "rg32f", "rgba16f", "rgba32f", "rgb10a2", "rg16", "d32f", "d24", "r8", "rg32ui" };
    return names[static_cast<int>(format)];
}

bool has(const device& d, VkFormat format, VkFormatFeatureFlags wanted)
{
    VkFormatProperties properties{};
    d.call.GetPhysicalDeviceFormatProperties(d.host.physical_device, format, &properties);
    return (properties.optimalTilingFeatures & wanted) == wanted;
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

bool can_sample(const device& d, pixel_format format)
{
    return has(d, native_format(format), VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) ||
           (format == pixel_format::d24 && has(d, VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT));
}

bool can_store(const device& d, pixel_format format)
{
    const bool base = format == pixel_format::r32f || format == pixel_format::rgba32f;
    return has(d, native_format(format), VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) &&
           (base || d.features.shaderStorageImageExtendedFormats != VK_FALSE);
}

bool can_draw(const device& d, pixel_format format)
{
    const bool depth = format == pixel_format::d32f || format == pixel_format::d24;
    return has(d, native_format(format),
               depth ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT);
}

error lacks(const char* what, pixel_format format)
{
    char text[128];
    std::snprintf(text, sizeof text, "the Vulkan device cannot %s %s pictures", what, name(format));
    return error(errc::unsupported_format, text);
}

namespace {

std::optional<error> beyond(int width, int height, std::uint32_t most_wide, std::uint32_t most_high)
{
    if (static_cast<std::uint32_t>(width) <= most_wide && static_cast<std::uint32_t>(height) <= most_high) {
        return std::nullopt;
    }
    char text[160];
    std::snprintf(text, sizeof text, "picture of %dx%d exceeds the Vulkan device's limit of %u pixels a side", width, height,
                  std::min(most_wide, most_high));
    return error(errc::invalid_size, text);
}

} // namespace

std::optional<error> wrong_size(const device& d, int width, int height)
{
    const VkPhysicalDeviceLimits& limits = d.properties.limits;
    if (const auto wrong = beyond(width, height, limits.maxImageDimension2D, limits.maxImageDimension2D)) {
        return wrong;
    }
    const group_size group = d.host.group;
    if ((static_cast<std::uint32_t>(width) - 1) / group.x >= limits.maxComputeWorkGroupCount[0] ||
        (static_cast<std::uint32_t>(height) - 1) / group.y >= limits.maxComputeWorkGroupCount[1]) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "picture of %dx%d takes more compute groups of %ux%u than the Vulkan device can dispatch", width, height,
                      group.x, group.y);
        return error(errc::invalid_size, text);
    }
    return std::nullopt;
}

std::optional<error> wrong_attachment_size(const device& d, int width, int height)
{
    const VkPhysicalDeviceLimits& limits = d.properties.limits;
    const auto most = [&](std::uint32_t framebuffer, std::uint32_t viewport) {
        return std::min({ limits.maxImageDimension2D, framebuffer, viewport });
    };
    return beyond(width, height, most(limits.maxFramebufferWidth, limits.maxViewportDimensions[0]),
                  most(limits.maxFramebufferHeight, limits.maxViewportDimensions[1]));
}

VkAccessFlags access_of(VkPipelineStageFlags readers)
{
    constexpr VkPipelineStageFlags shaders = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    return ((readers & shaders) != 0 ? static_cast<VkAccessFlags>(VK_ACCESS_SHADER_READ_BIT) : 0) |
           ((readers & VK_PIPELINE_STAGE_TRANSFER_BIT) != 0 ? static_cast<VkAccessFlags>(VK_ACCESS_TRANSFER_READ_BIT) : 0);
}

} // namespace ao::vk
