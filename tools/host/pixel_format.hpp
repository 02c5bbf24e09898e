#pragma once
#include "ao/format.hpp"

#include <cstddef>

namespace ao::host {
// Memory of every helper here is what ao/format.hpp says, in native byte order, rows without padding. Packed formats:
// rgb10a2 is one 32-bit word with r in the low 10 bits and a in the top 2; d24 has the depth in the low 24 bits, the rest
// is written as anything and read as 0.
bool is_depth(pixel_format format);
const char* name(pixel_format format);

inline constexpr pixel_format all_pixel_formats[] = {
    pixel_format::r32f, pixel_format::rg32f, pixel_format::rgba16f, pixel_format::rgba32f, pixel_format::rgb10a2,
    pixel_format::rg16, pixel_format::d32f,  pixel_format::d24,     pixel_format::r8,
};

struct extent {
    unsigned width = 0;
    unsigned height = 0;
    friend bool operator==(extent, extent) = default;
};

inline std::size_t byte_count(pixel_format format, extent size)
{
    return static_cast<std::size_t>(bytes_per_pixel(format)) * size.width * size.height;
}
}
