#pragma once

#include "tools_support.hpp"

#include <stb_image_write.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// Pictures as files in memory, for tests.
struct test_picture {
    int width;
    int height;
    std::vector<std::uint8_t> rgba;
};

// The upper half of one color, the lower one of another.
inline test_picture two_rows(int width, int height, const std::array<std::uint8_t, 4>& above,
                             const std::array<std::uint8_t, 4>& below)
{
    test_picture p{ width, height, {} };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto& c = y < height / 2 ? above : below;
            p.rgba.insert(p.rgba.end(), c.begin(), c.end());
        }
    return p;
}

inline void append_to_string(void* to, void* data, int size)
{
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

inline std::string png_of(const test_picture& p)
{
    std::string bytes;
    stbi_write_png_to_func(append_to_string, &bytes, p.width, p.height, 4, p.rgba.data(), 4 * p.width);
    return bytes;
}

// Without the alpha channel.
inline std::string opaque_png_of(const test_picture& p)
{
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < p.rgba.size(); i += 4)
        rgb.insert(rgb.end(), { p.rgba[i], p.rgba[i + 1], p.rgba[i + 2] });
    std::string bytes;
    stbi_write_png_to_func(append_to_string, &bytes, p.width, p.height, 3, rgb.data(), 3 * p.width);
    return bytes;
}

inline std::string jpeg_of(const test_picture& p)
{
    std::string bytes;
    stbi_write_jpg_to_func(append_to_string, &bytes, p.width, p.height, 4, p.rgba.data(), 95);
    return bytes;
}

inline std::string tga_of(const test_picture& p, bool run_lengths)
{
    std::string bytes;
    stbi_write_tga_with_rle = run_lengths ? 1 : 0;
    stbi_write_tga_to_func(append_to_string, &bytes, p.width, p.height, 4, p.rgba.data());
    return bytes;
}
