#pragma once
#include "host/pixel_format.hpp"

#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

// Seeded bits that a copy must return unchanged: any bits for normalised formats; for floats no NaN, whose payload an
// API may change, no subnormal, and depths in [0,1].
inline std::vector<std::byte> pixel_pattern(ao::pixel_format format, ao::host::extent size)
{
    using ao::pixel_format;
    std::mt19937 random(1);
    std::vector<std::byte> out(byte_count(format, size));
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<std::byte>(random() & 0xffu);
    for (std::size_t i = 0; i + 4 <= out.size(); i += 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, &out[i], 4);
        if (format == pixel_format::d24)
            word &= 0xffffffu;
        else if (format == pixel_format::d32f)
            word = 0x3f000000u | (word & 0x7fffffu);
        else if (format == pixel_format::rgba16f)
            word = (word & 0x83ff83ffu) | 0x3c003800u;
        else if (format == pixel_format::r32f || format == pixel_format::rg32f || format == pixel_format::rgba32f)
            word = (word & 0x80ffffffu) | 0x3f000000u;
        std::memcpy(&out[i], &word, 4);
    }
    return out;
}
