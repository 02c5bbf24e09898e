// Ambient light from spherical harmonics or from a picture of the surroundings.
#pragma once

#include "ao/color.hpp"
#include "ao/detail/elementary.hpp"
#include "ao/harmonics.hpp"
#include "ao/scene.hpp"

#include <array>
#include <cassert>
#include <cstddef>

namespace ao {

// From the coefficients of light L_lm, order (0 0), (1 -1), (1 0), (1 1), (2 -2) ... (2 2), real and orthonormal over the unit
// sphere: irradiance / pi, that is convolved with the clamped cosine (Ramamoorthi and Hanrahan, SIGGRAPH 2001).
constexpr ambient_light ambient_of_harmonics(const std::array<glm::dvec3, 9>& light)
{
    // Of z^2 - 1/3, which the harmonics' recurrence has, 3 z^2 - 1 is three times, and xy half of the imaginary part of (x + i
    // y)^2.
    constexpr std::array<double, 9> polynomials{ 1, 1, 1, 1, 2, 1, 1.0 / 3, 1, 1 };
    constexpr std::array<int, 9> degrees{ 0, 1, 1, 1, 2, 2, 2, 2, 2 };
    ambient_light ambient;
    for (std::size_t i = 0; i < 9; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double factor = harmonic_table.norm[i] * polynomials[i] * lobe_factor(1, degrees[i]);
            ambient.coefficients[i][channel] = static_cast<float>(light[i][channel] * factor);
        }
    }
    return ambient;
}

// From an equirectangular picture: its middle is -Z, right of it +X, its first row +Y. light(row, column) is linear RGB.
// Preconditions: width, height > 0; light is finite.
template <class Light>
ambient_light ambient_of_environment(std::size_t width, std::size_t height, const Light& light)
{
    std::array<glm::dvec3, 9> sums{};
    for (std::size_t row = 0; row < height; ++row) {
        const double top = detail::pi * static_cast<double>(row) / static_cast<double>(height);
        const double bottom = detail::pi * static_cast<double>(row + 1) / static_cast<double>(height);
        const double solid = 2 * detail::pi / static_cast<double>(width) * (detail::cosine(top) - detail::cosine(bottom));
        const double y = detail::cosine((top + bottom) / 2);
        const double across = detail::sine((top + bottom) / 2);
        for (std::size_t column = 0; column < width; ++column) {
            const double angle = 2 * detail::pi * ((static_cast<double>(column) + 0.5) / static_cast<double>(width) - 0.5);
            const double x = across * detail::sine(angle);
            const double z = -across * detail::cosine(angle);
            const auto basis = harmonics({ x, y, z }, 2);
            const glm::dvec3 value = light(row, column);
            for (int channel = 0; channel < 3; ++channel) {
                for (std::size_t i = 0; i < 9; ++i) {
                    sums[i][channel] += value[channel] * solid * basis[i];
                }
            }
        }
    }
    return ambient_of_harmonics(sums);
}

// Precondition: a valid texture.
inline ambient_light ambient_of_environment(const texture& t)
{
    const auto width = static_cast<std::size_t>(t.width);
    const auto height = static_cast<std::size_t>(t.height);
    assert(t.texels.size() == 4 * width * height);
    return ambient_of_environment(width, height, [&](std::size_t row, std::size_t column) {
        glm::dvec3 light(0.0);
        for (int channel = 0; channel < 3; ++channel) {
            const std::uint8_t code = t.texels[4 * (row * width + column) + static_cast<std::size_t>(channel)];
            light[channel] = t.srgb ? static_cast<double>(srgb_table[code]) : static_cast<double>(code) / 255;
        }
        return light;
    });
}

} // namespace ao
