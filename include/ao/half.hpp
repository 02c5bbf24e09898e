// IEEE binary16 as 16 bits.
#pragma once

#include <bit>
#include <cstdint>

namespace ao {

// Exact. NaN payloads keep their top bits.
constexpr float half_to_float(std::uint16_t h)
{
    const std::uint32_t sign = static_cast<std::uint32_t>(h & 0x8000U) << 16U;
    const std::uint32_t exponent = (h >> 10U) & 0x1fU;
    std::uint32_t fraction = h & 0x3ffU;
    if (exponent == 31) {
        return std::bit_cast<float>(sign | 0x7f800000U | (fraction << 13U));
    }
    if (exponent != 0) {
        return std::bit_cast<float>(sign | ((exponent + 112U) << 23U) | (fraction << 13U));
    }
    const float magnitude = static_cast<float>(fraction) * 5.9604644775390625e-8F; // 2^-24
    return sign != 0 ? -magnitude : magnitude;
}

// Rounds to nearest, ties to even; beyond 65519.996 infinite.
constexpr std::uint16_t float_to_half(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const auto sign = static_cast<std::uint16_t>((bits >> 16U) & 0x8000U);
    const std::uint32_t magnitude = bits & 0x7fffffffU;
    if (magnitude > 0x7f800000U) {
        return static_cast<std::uint16_t>(sign | 0x7e00U);
    }
    if (magnitude >= 0x477ff000U) {
        return static_cast<std::uint16_t>(sign | 0x7c00U);
    }
    if (magnitude < 0x38800000U) {
        // Below 2^-14: adding 0.5 leaves the rounded fraction in the low bits.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5F;
        return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3f000000U));
    }
    const std::uint32_t rounded = magnitude + 0xfffU + ((magnitude >> 13U) & 1U) - 0x38000000U;
    return static_cast<std::uint16_t>(sign | (rounded >> 13U));
}

} // namespace ao
