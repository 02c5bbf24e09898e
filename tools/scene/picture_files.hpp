#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ao::tools {

// RGBA, rows from the top.
struct picture {
    int width = 0;
    int height = 0;
    bool has_alpha = false; // in the file
    std::vector<std::uint8_t> rgba;
};

// 2^26 texels, a quarter of a gigabyte: what a file of a few bytes may make us reserve.
inline constexpr long largest_picture = 1L << 26;

// PNG, JPEG, TGA or BMP; 16 bits per channel become 8. Throws `error` that says what is wrong but not with which file: no such
// picture, cut short, 0 or more than 16384 pixels a side, more than largest_picture in all.
[[nodiscard]] picture decode_picture(std::span<const std::uint8_t> bytes);
// The same from a file of at most half a gigabyte, errors without its name, too.
[[nodiscard]] picture read_picture(const std::filesystem::path& path);

// The file that a model in `directory` means by `name`: relative to the directory, or absolute; backslashes separate as slashes
// do, %20 and the like count as written and decoded, and letters of either case are the same where no name fits exactly. Where
// all this finds nothing, a file of that name beside the model. Empty if there is none.
[[nodiscard]] std::filesystem::path find_picture(const std::filesystem::path& directory, const std::string& name);

} // namespace ao::tools
