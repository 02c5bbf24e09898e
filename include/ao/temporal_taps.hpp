// The sequence of offsets that a pixel's samples run through, frame after frame: Halton points mapped to a density, computed once
// and uploaded as the same bytes to every backend.
#pragma once

#include "ao/kernel.hpp"
#include "ao/temporal_settings.hpp"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ao {

// On the unit disc from two numbers in [0, 1) (paper 2, eq. 13): r = sqrt(v), uniform in area, or r = v, linear in the radius.
constexpr glm::vec2 disc_offset(double u, double v, bool uniform_in_area)
{
    const double angle = 2 * detail::pi * u;
    const double r = uniform_in_area ? detail::sqrt(v) : v;
    return { static_cast<float>(r * detail::cosine(angle)), static_cast<float>(r * detail::sine(angle)) };
}

// Sample `index` of the sequence. Element 0 of Halton's sequence is the pixel itself: they begin with 1.
constexpr glm::vec4 temporal_tap(sample_density density, std::uint32_t index)
{
    using reals = math<double>;
    const double u = reals::ao_radical_inverse(2, index + 1);
    const double v = reals::ao_radical_inverse(3, index + 1);
    if (density == sample_density::hemisphere) {
        return glm::vec4(cosine_linear_offset(u, v, reals::ao_radical_inverse(5, index + 1)), 0.0F);
    }
    return glm::vec4(disc_offset(u, v, density == sample_density::disc_area), 0.0F, 0.0F);
}

// Tap `index` of slices of `taps` taps each, as in ao/slices.hpp: azimuths and places in the steps by Halton's sequence over the
// slices.
constexpr glm::vec4 temporal_slice_tap(int taps, std::uint32_t index)
{
    using reals = math<double>;
    const auto each = static_cast<std::uint32_t>(taps);
    const std::uint32_t slice = index / each;
    const double angle = 2 * detail::pi * reals::ao_radical_inverse(2, slice);
    return slice_tap(angle, index % each, each, reals::ao_radical_inverse(3, slice));
}

// Sample `index` of the settings' sequence.
constexpr glm::vec4 temporal_tap(const temporal_settings& s, std::uint32_t index)
{
    return s.density == sample_density::slices ? temporal_slice_tap(s.slice_taps, index) : temporal_tap(s.density, index);
}

// All `period` of them.
inline std::vector<glm::vec4> make_temporal_taps(const temporal_settings& s)
{
    std::vector<glm::vec4> taps(static_cast<std::size_t>(s.period));
    for (std::size_t i = 0; i < taps.size(); ++i) {
        taps[i] = temporal_tap(s, static_cast<std::uint32_t>(i));
    }
    return taps;
}

// What turns the pattern from pixel to pixel.
constexpr auto make_tile(const temporal_settings& s)
{
    return s.density == sample_density::slices ? make_slice_tile(s.seed, 1) : make_rotation_tile(s.seed);
}

} // namespace ao
