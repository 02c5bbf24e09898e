#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ao::tools {

// Row 0 on top, no padding. Preconditions everywhere: 0 < width, height; as many values as the size asks for.
struct extent {
    int width = 0;
    int height = 0;
    [[nodiscard]] std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

// 0..1 to the nearest of 256 codes, without a transfer curve; outside and NaN: clamped, NaN to 0.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(std::span<const float> values);

// The whole file as bytes. `channels` is 1 (gray) or 3 (RGB).
[[nodiscard]] std::string encode_png(extent size, int channels, std::span<const std::uint8_t> pixels);

// 32-bit float, ZIP. One channel Y; three channels named by the letters of `names`, "RGB" or "XYZ".
[[nodiscard]] std::string encode_exr(extent size, std::span<const float> values);
[[nodiscard]] std::string encode_exr(extent size, std::span<const glm::vec3> values, const char (&names)[4]);

} // namespace ao::tools
