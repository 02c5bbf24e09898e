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

// Depth of a d24 code is the code times this, rounded once: what llvmpipe and lavapipe compute (measured for all 2^24 codes). For
// half of them that is not the float nearest to code / 16777215; hardware may deliver either.
inline constexpr float d24_step = 1.0F / 16777215.0F;

} // namespace ao
