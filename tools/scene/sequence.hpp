#pragma once

#include <cstdint>

namespace ao::tools {

// 32 bits well mixed (the finaliser of MurmurHash3).
[[nodiscard]] constexpr std::uint32_t mix_bits(std::uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

[[nodiscard]] constexpr std::uint32_t combine(std::uint32_t seed, std::uint32_t value)
{
    return mix_bits(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2)));
}

[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

// Point i of the second Sobol dimension, bits reversed (the first one, reversed, is i itself).
[[nodiscard]] constexpr std::uint32_t sobol_1_reversed(std::uint32_t i)
{
    std::uint32_t result = 0;
    for (std::uint32_t direction = 0x80000000u; i != 0; i >>= 1, direction ^= direction >> 1)
        result ^= (i & 1u) != 0 ? direction : 0u;
    return reverse_bits(result);
}

// A nested uniform (Owen) scramble in base 2 of the number whose bits come reversed; the hash after Laine and Karras,
// Stratified Sampling for Stochastic Transparency (2011), with the constants of Vegdahl, Building a Better LK Hash (2021).
[[nodiscard]] constexpr std::uint32_t owen_scramble(std::uint32_t reversed, std::uint32_t seed)
{
    std::uint32_t x = reversed;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

// [0,1), never rounded up to 1.
[[nodiscard]] constexpr float unit_float(std::uint32_t bits)
{
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

} // namespace ao::tools
