// What a device can do with pictures.
#pragma once

#include "device.hpp"

namespace ao::vk {

VkFormat native_format(pixel_format format);
// By usage as optimally tiled pictures. d24: in either of its formats.
bool can_sample(const device& d, pixel_format format);
bool can_store(const device& d, pixel_format format);
// As an attachment; d24: as X8_D24_UNORM_PACK32.
bool can_draw(const device& d, pixel_format format);

// errc::unsupported_format: "the Vulkan device cannot `what` ... pictures".
error lacks(const char* what, pixel_format format);

// The picture is too large for the device, or for a dispatch in groups of context::group, or for an attachment.
std::optional<error> wrong_size(const device& d, int width, int height);
std::optional<error> wrong_attachment_size(const device& d, int width, int height);

// How context::readers read.
VkAccessFlags access_of(VkPipelineStageFlags readers);

} // namespace ao::vk
