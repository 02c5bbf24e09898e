// Pixel formats that inputs, outputs and the passes' own pictures may have.
#pragma once

namespace ao {

enum class pixel_format {
    r32f,
    rg32f,
    rgba16f,
    rgba32f,
    rgb10a2, // unsigned normalised
    rg16,    // unsigned normalised
    d32f,
    d24,    // unsigned normalised, in the low 24 bits of 32
    r8,     // unsigned normalised
    rg32ui, // unsigned integers
};

// Bytes per pixel in memory, rows tightly packed.
constexpr int bytes_per_pixel(pixel_format format)
{
    switch (format) {
    case pixel_format::rgba32f:
        return 16;
    case pixel_format::rg32f:
    case pixel_format::rgba16f:
    case pixel_format::rg32ui:
        return 8;
    case pixel_format::r8:
        return 1;
    default:
        return 4;
    }
}

} // namespace ao
