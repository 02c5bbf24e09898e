// Tables computed once and uploaded as the same bytes to every backend: kernels of offsets in tangent space (normal along
// +z, unit radius) and the tile of rotations.
#pragma once

#include "ao/detail/elementary.hpp"
#include "ao/math.hpp"
#include "ao/settings.hpp"
#include "ao/slices.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ao {

// A fixed sequence of well-mixed 32-bit integers (PCG-RXS-M-XS; O'Neill 2014).
class random_stream {
public:
    constexpr explicit random_stream(std::uint32_t seed) : state_(seed * 747796405U + 2891336453U) { next(); }
    constexpr std::uint32_t next()
    {
        state_ = state_ * 747796405U + 2891336453U;
        const std::uint32_t word = ((state_ >> ((state_ >> 28U) + 4U)) ^ state_) * 277803737U;
        return (word >> 22U) ^ word;
    }
    // Uniform in [0, 1), a multiple of 2^-24.
    constexpr float uniform() { return static_cast<float>(next() >> 8U) * 5.9604644775390625e-8F; }

private:
    std::uint32_t state_;
};

// Uniform in the half box |x|, |y| <= 1, 0 <= z < 1 (paper 1: S = (2f - 1, 2f - 1, f)), from three numbers in [0, 1).
constexpr glm::vec3 box_offset(float u, float v, float w)
{
    return { 2.0F * u - 1.0F, 2.0F * v - 1.0F, w };
}

// Uniform in the half ball, from three numbers in [0, 1): height uniform on the half sphere, distance the cube root.
constexpr glm::vec3 half_ball_offset(double u, double v, double w)
{
    const double angle = 2 * detail::pi * u;
    const double distance = detail::cube_root(v);
    const double across = distance * detail::sqrt(1 - w * w);
    return { static_cast<float>(across * detail::cosine(angle)), static_cast<float>(across * detail::sine(angle)),
             static_cast<float>(distance * w) };
}

// Cosine-weighted direction, uniform in distance, from three numbers in [0, 1) (paper 2, eq. 14 with its radicand corrected):
// r (cos a sqrt(1 - w), sin a sqrt(1 - w), sqrt(w)), a = 2 pi u, r = v.
constexpr glm::vec3 cosine_linear_offset(double u, double v, double w)
{
    const double angle = 2 * detail::pi * u;
    const double across = v * detail::sqrt(1 - w);
    return { static_cast<float>(across * detail::cosine(angle)), static_cast<float>(across * detail::sine(angle)),
             static_cast<float>(v * detail::sqrt(w)) };
}

// `count` random numbers in [0, 1), one in each of `count` equal strata, in random order. Each is uniform by itself; together
// they leave out the chance that a small kernel has most of its offsets high or to one side.
constexpr std::array<float, max_taps> stratified(random_stream& random, int count)
{
    std::array<float, max_taps> numbers{};
    for (int i = 0; i < count; ++i) {
        numbers[static_cast<std::size_t>(i)] = (static_cast<float>(i) + random.uniform()) / static_cast<float>(count);
    }
    for (int i = count - 1; i > 0; --i) {
        const std::uint32_t j = random.next() % static_cast<std::uint32_t>(i + 1);
        const float number = numbers[static_cast<std::size_t>(i)];
        numbers[static_cast<std::size_t>(i)] = numbers[j];
        numbers[j] = number;
    }
    for (float& number : numbers) {
        number = number < 1.0F ? number : 0.99999994F;
    }
    return numbers;
}

// The `taps` offsets of a kernel, w = 0. Unused entries are zero. Not for bitmask.
constexpr std::array<glm::vec4, max_taps> make_kernel(method chosen, int taps, std::uint32_t seed)
{
    std::array<glm::vec4, max_taps> offsets{};
    random_stream random(seed);
    const std::array<float, max_taps> u = stratified(random, taps);
    const std::array<float, max_taps> v = stratified(random, taps);
    const std::array<float, max_taps> w = stratified(random, taps);
    for (std::size_t i = 0; i < static_cast<std::size_t>(taps); ++i) {
        glm::vec3 offset(0.0F);
        if (chosen == method::box) {
            offset = box_offset(u[i], v[i], w[i]);
        }
        else if (chosen == method::hemisphere) {
            offset = half_ball_offset(static_cast<double>(u[i]), static_cast<double>(v[i]), static_cast<double>(w[i]));
        }
        else {
            using reals = math<double>;
            const auto index = static_cast<std::uint32_t>(i + 1); // element 0 of the sequence is the pixel itself
            offset = cosine_linear_offset(reals::ao_radical_inverse(2, index), reals::ao_radical_inverse(3, index),
                                          reals::ao_radical_inverse(5, index));
        }
        offsets[i] = glm::vec4(offset, 0.0F);
    }
    return offsets;
}

inline constexpr int tile_size = math<float>::ao_tile_size;

// Row-major tile of helper vectors V_r = (2f - 1, 2f - 1) (paper 1).
constexpr std::array<glm::vec2, tile_size * tile_size> make_rotation_tile(std::uint32_t seed)
{
    std::array<glm::vec2, tile_size * tile_size> tile{};
    random_stream random(seed ^ 0x9e3779b9U);
    for (glm::vec2& helper : tile) {
        const float x = 2.0F * random.uniform() - 1.0F;
        helper = { x, 2.0F * random.uniform() - 1.0F };
    }
    return tile;
}

// The table of taps and the tile that the passes of these settings read.
constexpr std::array<glm::vec4, max_taps> make_taps(const settings& s)
{
    return s.method == method::bitmask ? make_slice_taps(s.taps, s.slices) : make_kernel(s.method, s.taps, s.seed);
}
constexpr std::array<glm::vec2, tile_size * tile_size> make_tile(const settings& s)
{
    return s.method == method::bitmask ? make_slice_tile(s.seed, s.slices) : make_rotation_tile(s.seed);
}

} // namespace ao
