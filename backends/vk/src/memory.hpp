// Buffers and pictures of a program, and the memory they lie in.
#pragma once

#include "device.hpp"

#include <cstddef>
#include <span>

namespace ao::vk {

struct buffer {
    owned<VkDeviceMemory> memory; // outlives the buffer
    owned<VkBuffer> handle;
    VkDeviceSize size = 0;
};

inline constexpr VkMemoryPropertyFlags host_memory = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
// In the device's own memory where there is such that has the `needed` properties.
result<buffer> make_buffer(const device& d, VkDeviceSize size, VkBufferUsageFlags usage,
                           VkMemoryPropertyFlags needed = host_memory);
// Preconditions: in host_memory; inside the buffer; no command that uses these bytes executes.
std::optional<error> write(const device& d, const buffer& to, VkDeviceSize offset, std::span<const std::byte> bytes);
std::optional<error> read(const device& d, const buffer& from, std::span<std::byte> bytes);
// A storage buffer with this content. errc::out_of_memory: `what` is more than the device can bind.
result<buffer> make_table(const device& d, const char* what, std::span<const std::byte> bytes, VkBufferUsageFlags more = 0);

struct picture_shape {
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    std::uint32_t layers = 1;
    std::uint32_t levels = 1;
    VkImageUsageFlags usage = 0;
    VkImageViewType view = VK_IMAGE_VIEW_TYPE_2D;
};

struct picture {
    owned<VkDeviceMemory> memory; // outlives the image
    owned<VkImage> image;
    owned<VkImageView> view;
};

result<picture> make_picture(const device& d, const picture_shape& shape);

// The tables of a plan: kernel (uniform buffer) and rotation tile (uniform texel buffer of R32G32_SFLOAT), written once.
struct tables {
    buffer own;
    owned<VkBufferView> rotations;
    static constexpr VkDeviceSize kernel_bytes = 16384;
};

result<tables> make_tables(const device& d, const plan& p);

// The plan's own pictures, in the order of plan::transients, in one piece of memory.
struct transients {
    struct picture {
        owned<VkImage> image;
        owned<VkImageView> view;
    };
    owned<VkDeviceMemory> memory; // outlives the images
    inline_vector<image_id, 3> ids;
    std::array<picture, 3> pictures;
};

result<transients> make_transients(const device& d, const plan& p);

} // namespace ao::vk
