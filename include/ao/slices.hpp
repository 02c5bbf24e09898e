// Tables of the method `bitmask`: where in a slice its taps lie, and how slices turn from pixel to pixel.
#pragma once

#include "ao/detail/elementary.hpp"
#include "ao/math.hpp"
#include "ao/settings.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ao {

// Place of a texel along the Hilbert curve over a square of `side` (a power of two) texels a side.
constexpr std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t side)
{
    std::uint32_t index = 0;
    for (std::uint32_t half = side / 2; half > 0; half /= 2) {
        const std::uint32_t right = (x & half) != 0 ? 1 : 0;
        const std::uint32_t low = (y & half) != 0 ? 1 : 0;
        index += half * half * ((3 * right) ^ low);
        if (low == 0) {
            if (right == 1) {
                x = side - 1 - x;
                y = side - 1 - y;
            }
            const std::uint32_t other = x;
            x = y;
            y = other;
        }
    }
    return index;
}

// Row-major tile: x the cosine of half the azimuth of the first slice, which is uniform in
// [0, 2 pi / slices), y where in their steps the
// taps lie, in [0, 1).
// The R2 sequence (Roberts 2018) along a Hilbert curve: neighbours have unlike slices, which the denoiser joins.
constexpr std::array<glm::vec2, math<float>::ao_tile_size * math<float>::ao_tile_size> make_slice_tile(std::uint32_t seed,
                                                                                                       int slices)
{
    constexpr std::uint32_t side = math<float>::ao_tile_size;
    std::array<glm::vec2, side * side> tile{};
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const double i = hilbert_index(x, y, side) + 288.0 * (seed - 1U);
            const auto fraction = [](double a) { return a - detail::floor(a); };
            const double turn = fraction(0.5 + i * 0.75487766624669276);
            const double step = fraction(0.5 + i * 0.56984029099805327);
            const auto below_one = [](double a) { return a < 0.99999994 ? static_cast<float>(a) : 0.99999994F; };
            tile[y * side + x] = { static_cast<float>(detail::cosine(detail::pi * turn / slices)), below_one(step) };
        }
    }
    return tile;
}

// A tap of a slice. x, y: cosine and sine of the angle between this slice and the first; z: steps before this one, as a share of
// all; w: added to the tile's y: the slice's own `shift` and the golden ratio from step to step, so that no two taps lie alike.
constexpr glm::vec4 slice_tap(double angle, std::uint32_t step, std::uint32_t steps, double shift)
{
    const double moved = shift + 0.61803398874989485 * step;
    return { static_cast<float>(detail::cosine(angle)), static_cast<float>(detail::sine(angle)),
             static_cast<float>(step) / static_cast<float>(steps), static_cast<float>(moved - detail::floor(moved)) };
}

// Taps of all slices, one slice after the other, steps outwards. Unused entries are zero.
// Precondition: `taps` is a multiple of `slices`.
constexpr std::array<glm::vec4, max_taps> make_slice_taps(int taps, int slices)
{
    std::array<glm::vec4, max_taps> table{};
    const auto steps = static_cast<std::uint32_t>(taps / slices);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(taps); ++i) {
        const std::uint32_t slice = i / steps;
        const double shift = 0.61803398874989485 * (slice * steps);
        table[i] = slice_tap(2 * detail::pi * slice / slices, i % steps, steps, shift);
    }
    return table;
}

} // namespace ao
