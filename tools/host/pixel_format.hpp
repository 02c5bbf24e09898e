#pragma once
#include <cstddef>

namespace ao::host {
/// Formats that a G-buffer, a map or a depth buffer comes in. In memory a pixel is its components in order, native
/// byte order, rows without padding. Packed ones: rgb10a2 is one 32-bit word with r in the low 10 bits and a in the
/// top 2; d24 is one 32-bit word with the depth in the low 24 bits, the rest written as anything and read as 0.
enum class pixel_format {
    r8,
    r16f,
    r32f,
    rg32f,
    rgba16f,
    rgba32f,
    rgb10a2,
    rg16,
    rg16_snorm,
    d32f,
    d24,
};

std::size_t bytes_per_pixel(pixel_format format);
bool is_depth(pixel_format format);
const char* name(pixel_format format);

struct extent {
    unsigned width = 0;
    unsigned height = 0;
    friend bool operator==(extent, extent) = default;
};

inline std::size_t byte_count(pixel_format format, extent size)
{
    return bytes_per_pixel(format) * size.width * size.height;
}
}
