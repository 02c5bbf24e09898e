// Pictures in host memory, and packing of depths, positions and normals into the formats that the passes read.
#pragma once

#include "ao/format.hpp"
#include "ao/half.hpp"
#include "ao/plan.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace ao {

// Rows from the first in memory on, tightly packed.
struct picture {
    pixel_format format = pixel_format::r32f;
    int width = 0;
    int height = 0;
    std::vector<std::byte> bytes;

    picture() = default;
    picture(pixel_format f, int w, int h)
        : format(f),
          width(w),
          height(h),
          bytes(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(bytes_per_pixel(f)))
    {
    }
    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

    // Texels of type T. Precondition: T has the size of a pixel.
    template <class T>
    T texel(std::size_t i) const
    {
        assert(static_cast<int>(sizeof(T)) == bytes_per_pixel(format));
        T value;
        std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
        return value;
    }
    template <class T>
    void set_texel(std::size_t i, const T& value)
    {
        assert(static_cast<int>(sizeof(T)) == bytes_per_pixel(format));
        std::memcpy(bytes.data() + i * sizeof(T), &value, sizeof(T));
    }
};

// Code of x in [0, 1] as an unsigned normalised integer, to nearest; 0 for NaN.
inline std::uint32_t unorm_code(double x, std::uint32_t top)
{
    const double inside = x > 0 ? (x < 1 ? x : 1.0) : 0.0;
    return static_cast<std::uint32_t>(std::lround(inside * top));
}

// Depths for a depth source: eye depths d > 0, and whatever is no finite d > 0 as background.
// A hardware depth is ndc z of the point at the pixel's centre, background the value a buffer is cleared to.
// Preconditions: the format fits the source, the projection is supported.
inline picture pack_depth(std::span<const float> eye_depth, int width, int height, depth_source source, pixel_format format,
                          const camera_projection& projection)
{
    picture packed(format, width, height);
    assert(eye_depth.size() == packed.pixels());
    const result<projection_constants> folded = fold_projection(projection, width, height);
    assert(folded);
    const auto element = [&](int row, int column) { return static_cast<double>(projection.matrix[column][row]); };
    for (std::size_t i = 0; i < packed.pixels(); ++i) {
        const double d = static_cast<double>(eye_depth[i]);
        const bool seen = d > 0 && d < 3e38;
        const auto column = static_cast<double>(i % static_cast<std::size_t>(width)) + 0.5;
        const auto row = static_cast<double>(i / static_cast<std::size_t>(width)) + 0.5;
        const double reach = folded->parallel ? 1.0 : d;
        const double x =
            (column * static_cast<double>(folded->projection.slope_x) + static_cast<double>(folded->projection.offset_x)) * reach;
        const double y =
            (row * static_cast<double>(folded->projection.slope_y) + static_cast<double>(folded->projection.offset_y)) * reach;
        if (source == depth_source::linear) {
            packed.set_texel(i, seen ? eye_depth[i] : 0.0F);
            continue;
        }
        if (source == depth_source::position) {
            const glm::vec4 position = seen ? glm::vec4(x, y, -d, 1) : glm::vec4(0.0F);
            if (format == pixel_format::rgba32f) {
                packed.set_texel(i, position);
            }
            else {
                packed.set_texel(i, std::array<std::uint16_t, 4>{ float_to_half(position.x), float_to_half(position.y),
                                                                  float_to_half(position.z), float_to_half(position.w) });
            }
            continue;
        }
        const double w = element(3, 0) * x + element(3, 1) * y - element(3, 2) * d + element(3, 3);
        const double z = (element(2, 0) * x + element(2, 1) * y - element(2, 2) * d + element(2, 3)) / w;
        const double stored = projection.range == depth_range::zero_to_one ? z : z * 0.5 + 0.5;
        const double value = seen ? stored : static_cast<double>(folded->decode.cleared);
        if (format == pixel_format::d24) {
            packed.set_texel(i, unorm_code(value, 0xffffffU));
        }
        else {
            packed.set_texel(i, static_cast<float>(value));
        }
    }
    return packed;
}

// Normals for a normal source, from unit vectors. Precondition: source is not from_depth.
inline picture pack_normals(std::span<const glm::vec3> normals, int width, int height, normal_source source, pixel_format format)
{
    picture packed(format, width, height);
    assert(normals.size() == packed.pixels());
    for (std::size_t i = 0; i < packed.pixels(); ++i) {
        const glm::vec3 n = normals[i];
        const double x = static_cast<double>(n.x);
        const double y = static_cast<double>(n.y);
        const double z = static_cast<double>(n.z);
        if (source == normal_source::unorm10) {
            packed.set_texel(i, unorm_code(x * 0.5 + 0.5, 1023) | unorm_code(y * 0.5 + 0.5, 1023) << 10U |
                                    unorm_code(z * 0.5 + 0.5, 1023) << 20U | 3U << 30U);
        }
        else if (source == normal_source::octahedral) {
            const double sum = std::abs(x) + std::abs(y) + std::abs(z);
            const double u = sum > 0 ? x / sum : 0;
            const double v = sum > 0 ? y / sum : 0;
            const double folded_u = z >= 0 ? u : (1 - std::abs(v)) * (u >= 0 ? 1 : -1);
            const double folded_v = z >= 0 ? v : (1 - std::abs(u)) * (v >= 0 ? 1 : -1);
            packed.set_texel(i, unorm_code(folded_u * 0.5 + 0.5, 65535) | unorm_code(folded_v * 0.5 + 0.5, 65535) << 16U);
        }
        else if (format == pixel_format::rgba32f) {
            packed.set_texel(i, glm::vec4(n, 0.0F));
        }
        else {
            packed.set_texel(i, std::array<std::uint16_t, 4>{ float_to_half(n.x), float_to_half(n.y), float_to_half(n.z), 0 });
        }
    }
    return packed;
}

} // namespace ao
