// Buffers and pictures of a program, and the memory they lie in.
#pragma once

#include "device.hpp"

#include <cstddef>
#include <span>

namespace ao::vk {

VkFormat native_format(pixel_format format);

// The tables of a plan: kernel (uniform buffer) and rotation tile (uniform texel buffer of R32G32_SFLOAT), written once.
struct tables {
    owned<VkBuffer> buffer;
    owned<VkDeviceMemory> memory;
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
