// G-buffers to try passes with: a small scene seen by rays, noise, and either with poison in it.
#pragma once

#include "ao/conformance/functions.hpp"
#include "ao/picture.hpp"
#include "ao/projection.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace ao::conformance {

// Eye depth (0: background) and unit normal in view space per pixel, the first row in memory first.
struct surfaces {
    int width = 0;
    int height = 0;
    std::vector<float> depth;
    std::vector<glm::vec3> normals;
};

namespace detail {

struct surface_hit {
    double depth = 0;
    glm::vec3 normal{ 0, 0, 1 };
};

// First of a tilted floor, a sphere on it, a step and a wall with an open top. The direction has z = -1, so that the ray's
// parameter is eye depth.
inline surface_hit see_scene(const std::array<double, 3>& from, const std::array<double, 3>& to)
{
    surface_hit nearest;
    const auto keep = [&](double d, double x, double y, double z) {
        if (d > 0.2 && (nearest.depth == 0 || d < nearest.depth)) {
            nearest = { d, glm::vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) };
        }
    };
    const auto plane = [&](double nx, double ny, double nz, double distance) {
        return (distance - (nx * from[0] + ny * from[1] + nz * from[2])) / (nx * to[0] + ny * to[1] + nz * to[2]);
    };
    const auto at = [&](double d, std::size_t axis) { return from[axis] + d * to[axis]; };

    const double floor = plane(0, 0.8, 0.6, -3.6);
    keep(floor, 0, 0.8, 0.6);
    const double wall = plane(0, 0, 1, -9);
    if (at(wall, 1) < 1.5 && at(wall, 0) < 2.5) {
        keep(wall, 0, 0, 1);
    }
    const double step = plane(-0.6, 0, 0.8, -4.5);
    if (at(step, 0) < -0.5 && at(step, 1) < 0.3) {
        keep(step, -0.6, 0, 0.8);
    }
    const double px = from[0] - 0.7;
    const double py = from[1] + 0.1;
    const double pz = from[2] + 4.5;
    const double a = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    const double b = px * to[0] + py * to[1] + pz * to[2];
    const double c = px * px + py * py + pz * pz - 0.81;
    if (b * b > a * c) {
        const double d = (-b - std::sqrt(b * b - a * c)) / a;
        keep(d, (px + d * to[0]) / 0.9, (py + d * to[1]) / 0.9, (pz + d * to[2]) / 0.9);
    }
    return nearest;
}

} // namespace detail

// What the projection sees of the scene. Precondition: the projection is supported.
inline surfaces make_scene(int width, int height, const camera_projection& projection)
{
    const projection_constants folded = *fold_projection(projection, width, height);
    const auto& p = folded.projection;
    surfaces seen{ width, height, {}, {} };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double u = (x + 0.5) * static_cast<double>(p.slope_x) + static_cast<double>(p.offset_x);
            const double v = (y + 0.5) * static_cast<double>(p.slope_y) + static_cast<double>(p.offset_y);
            const detail::surface_hit hit =
                folded.parallel ? detail::see_scene({ u, v, 0 }, { 0, 0, -1 }) : detail::see_scene({ 0, 0, 0 }, { u, v, -1 });
            seen.depth.push_back(static_cast<float>(hit.depth));
            seen.normals.push_back(hit.normal);
        }
    }
    return seen;
}

// Unrelated depths between 1 and 30, a tenth of them background, and directions of every kind.
inline surfaces make_noise(int width, int height, std::uint32_t seed)
{
    surfaces noise{ width, height, {}, {} };
    random_stream random(seed);
    for (int i = 0; i < width * height; ++i) {
        const float d = std::exp(3.4F * random.uniform());
        noise.depth.push_back(random.next() % 10 == 0 ? 0.0F : d);
        noise.normals.push_back(detail::unit_vector(random));
    }
    return noise;
}

// Overwrites a fifth of a picture with values that no renderer means to write: NaN, infinities, denormals, 1e38, zeros of both
// signs and negative numbers in float formats (in d32f what a depth buffer can hold), any codes in others.
inline void poison(picture& p, std::uint32_t seed)
{
    constexpr float infinite = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr std::array<float, 12> floats{ nan,  infinite, -infinite, 1e-40F, 1e38F, -1e38F,
                                            0.0F, -0.0F,    -1.0F,     1.0F,   3e38F, 1e-30F };
    constexpr std::array<float, 6> depths{ 0.0F, 1.0F, 1e-40F, 0.99999994F, 1e-30F, 0.5F };
    constexpr std::array<std::uint16_t, 8> halves{ 0x7e00, 0x7c00, 0xfc00, 0x0001, 0x7bff, 0x8000, 0x0000, 0xfbff };
    random_stream random(seed ^ 0x51ed270bU);
    const auto channels = static_cast<std::size_t>(bytes_per_pixel(p.format)) / 4;
    for (std::size_t i = 0; i < p.pixels(); ++i) {
        if (random.next() % 5 != 0) {
            continue;
        }
        const std::uint32_t pick = random.next();
        const std::uint32_t channel = random.next();
        switch (p.format) {
        case pixel_format::d32f:
            p.set_texel(i, depths[pick % depths.size()]);
            break;
        case pixel_format::rgba16f: {
            auto texel = p.texel<std::array<std::uint16_t, 4>>(i);
            texel[channel % 3] = halves[pick % halves.size()];
            p.set_texel(i, texel);
            break;
        }
        case pixel_format::r32f:
        case pixel_format::rgba32f: {
            const float value = floats[pick % floats.size()];
            std::memcpy(p.bytes.data() + (i * channels + channel % (channels > 1 ? 3 : 1)) * sizeof(float), &value,
                        sizeof(float));
            break;
        }
        case pixel_format::d24:
            p.set_texel(i, pick & 0xffffffU);
            break;
        default:
            p.set_texel(i, pick);
            break;
        }
    }
}

} // namespace ao::conformance
