// Answers to the callbacks of the pass bodies. Texels arrive as the floats that a graphics API would deliver.
#pragma once

#include "kernels.hpp"
#include "memory.hpp"

#include "ao/math.hpp"

namespace ao::cpu::detail {

template <class Real>
struct reader {
    using memory = detail::memory<Real>;
    using integer = typename math<Real>::integer;
    using ivec2 = typename math<Real>::ivec2;
    using vec4 = typename math<Real>::vec4;

    const std::byte* data = nullptr;
    int row_words = 0;
    int pixel_words = 1;
    pixel_format format = pixel_format::r32f;

    reader() = default;
    explicit reader(const plane& p)
        : data(p.data),
          row_words(static_cast<int>(p.row_bytes / 4)),
          pixel_words(p.pixel_words),
          format(p.format)
    {
    }
    // r32f, anywhere.
    Real gathered(ivec2 pixel) const { return memory::as_real(memory::gather(data, pixel.y * integer(row_words) + pixel.x)); }
    // r32f, mostly side by side.
    Real loaded(ivec2 pixel) const { return memory::as_real(word(pixel, 0)); }
    // Word `i` of the texel.
    integer word(ivec2 pixel, int i) const
    {
        return memory::load(data + 4 * i, pixel.y * integer(row_words) + pixel.x * integer(pixel_words));
    }
    // Component `i` of rgba16f.
    Real half(ivec2 pixel, int i) const { return memory::half(memory::shift_right(word(pixel, i / 2), i % 2 * 16)); }
    // Bits low ... low + bits - 1 as an unsigned normalised number.
    Real unorm(ivec2 pixel, int low, int bits) const
    {
        const int top = (1 << bits) - 1;
        return Real(memory::shift_right(word(pixel, 0), low) & integer(top)) / Real(top);
    }
    // d24.
    Real depth24(ivec2 pixel) const { return Real(word(pixel, 0) & integer(0xffffff)) * Real(d24_step); }
    // Of any format of normals; w is of no use.
    vec4 normal(ivec2 pixel) const
    {
        switch (format) {
        case pixel_format::rgba16f: {
            const auto words = memory::load_pairs(data, pixel.y * integer(row_words) + pixel.x * integer(pixel_words));
            return vec4(memory::half(words[0]), memory::half(memory::shift_right(words[0], 16)), memory::half(words[1]), Real(0));
        }
        case pixel_format::rgb10a2:
            return vec4(unorm(pixel, 0, 10), unorm(pixel, 10, 10), unorm(pixel, 20, 10), Real(0));
        case pixel_format::rg16:
            return vec4(unorm(pixel, 0, 16), unorm(pixel, 16, 16), Real(0), Real(0));
        default: {
            const auto words = memory::gather_triples(data, pixel.y * integer(row_words) + pixel.x * integer(pixel_words));
            return vec4(memory::as_real(words[0]), memory::as_real(words[1]), memory::as_real(words[2]), Real(0));
        }
        }
    }
    // Component `i` of rgba32f.
    Real component(ivec2 pixel, int i) const { return memory::as_real(word(pixel, i)); }
};

template <class Real>
struct linearize_resources {
    using ivec2 = typename math<Real>::ivec2;
    reader<Real> depth;

    Real stored_depth(ivec2 pixel) const
    {
        switch (depth.format) {
        case pixel_format::rgba32f:
            return depth.component(pixel, 2);
        case pixel_format::rgba16f:
            return depth.half(pixel, 2);
        case pixel_format::d24:
            return depth.depth24(pixel);
        default:
            return depth.loaded(pixel);
        }
    }
};

template <class Real>
struct occlusion_resources {
    using memory = detail::memory<Real>;
    using ivec2 = typename math<Real>::ivec2;
    using vec2 = typename math<Real>::vec2;
    using vec4 = typename math<Real>::vec4;
    reader<Real> eye_depth;
    reader<Real> normals;
    reader<Real> rotation_x;
    reader<Real> rotation_y;
    const float* kernel = nullptr;

    Real depth(ivec2 pixel) const { return eye_depth.gathered(pixel); }
    vec4 normal(ivec2 pixel) const { return normals.normal(pixel); }
    vec2 rotation(ivec2 texel) const { return vec2(rotation_x.loaded(texel), rotation_y.loaded(texel)); }
    vec4 tap(int i) const
    {
        const float* offset = kernel + 4 * i;
        return vec4(Real(offset[0]), Real(offset[1]), Real(offset[2]), Real(offset[3]));
    }
};

template <class Real>
struct denoise_resources {
    using ivec2 = typename math<Real>::ivec2;
    using vec2 = typename math<Real>::vec2;
    using vec4 = typename math<Real>::vec4;
    reader<Real> visibility;
    reader<Real> depths;    // beside the visibilities
    reader<Real> eye_depth; // of every pixel
    reader<Real> normals;

    vec2 packed(ivec2 texel) const { return vec2(visibility.loaded(texel), depths.loaded(texel)); }
    Real depth(ivec2 pixel) const { return eye_depth.loaded(pixel); }
    vec4 normal(ivec2 pixel) const { return normals.normal(pixel); }
};

template <class Real>
struct filter_resources {
    using ivec2 = typename math<Real>::ivec2;
    using vec2 = typename math<Real>::vec2;
    reader<Real> first; // visibility, or sums
    reader<Real> counts;

    Real visibility(ivec2 pixel) const { return first.loaded(pixel); }
    vec2 row_sum(ivec2 pixel) const { return vec2(first.loaded(pixel), counts.loaded(pixel)); }
};

} // namespace ao::cpu::detail
