// A picture in the host's memory.
#pragma once

#include "ao/format.hpp"
#include "ao/picture.hpp"

#include <cstddef>

namespace ao::cpu {

// Rows from the first in memory on, `row_bytes` apart. `data` may have any alignment; 64 bytes, with rows a multiple of 64
// bytes apart, is fastest. Owns nothing. Inputs are never written.
struct image_view {
    void* data = nullptr;
    int width = 0; // pixels
    int height = 0;
    std::size_t row_bytes = 0; // at least a row's pixels; a multiple of 4 unless the format is r8
    pixel_format format = pixel_format::r32f;
};

inline image_view view_of(picture& p)
{
    const std::size_t row_bytes = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(bytes_per_pixel(p.format));
    return { p.bytes.data(), p.width, p.height, row_bytes, p.format };
}

// For inputs only.
inline image_view view_of(const picture& p)
{
    return view_of(const_cast<picture&>(p));
}

} // namespace ao::cpu
