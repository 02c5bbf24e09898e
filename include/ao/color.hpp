// sRGB tables, computed once: decoding of the 256 codes, and where rounding goes from one code to the next.
#pragma once

#include "ao/detail/elementary.hpp"
#include "ao/math.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace ao {

namespace detail {

// Of x in [0, 1]; error below 1e-15.
constexpr double fifth_root(double x)
{
    if (!(x > 0)) {
        return 0;
    }
    double root = 1;
    for (int i = 0; i < 200; ++i) {
        const double next = (4 * root + x / (root * root * root * root)) / 5;
        if (!(next < root)) {
            break;
        }
        root = next;
    }
    return root;
}

} // namespace detail

// Linear light of an sRGB value in [0, 1] (IEC 61966-2-1).
constexpr double linear_of_srgb(double encoded)
{
    if (encoded <= 0.04045) {
        return encoded / 12.92;
    }
    const double base = (encoded + 0.055) / 1.055;
    const double root = detail::fifth_root(base);
    return base * base * root * root; // base^2.4
}

inline constexpr std::array<float, 256> srgb_table = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<float>(linear_of_srgb(static_cast<double>(i) / 255));
    }
    return table;
}();

namespace detail {

// Linear light half a code above each code but the last.
inline constexpr std::array<double, 255> srgb_steps = [] {
    std::array<double, 255> steps{};
    for (std::size_t i = 0; i < steps.size(); ++i) {
        steps[i] = linear_of_srgb((static_cast<double>(i) + 0.5) / 255);
    }
    return steps;
}();

} // namespace detail

// The nearest code of linear light in [0, 1], in double precision.
constexpr std::uint8_t srgb_code(double linear)
{
    return static_cast<std::uint8_t>(std::upper_bound(detail::srgb_steps.begin(), detail::srgb_steps.end(), linear) -
                                     detail::srgb_steps.begin());
}

// sRGB value in [0, 1] and 8-bit code of linear light, as shaders compute them; 0 for NaN.
template <class Real>
constexpr Real srgb_of_linear(Real linear)
{
    return math<Real>::ao_srgb_of_linear(linear);
}
template <class Real>
constexpr std::uint8_t display_code(Real linear)
{
    return static_cast<std::uint8_t>(math<Real>::ao_srgb_code(linear));
}

} // namespace ao
