#pragma once

#include <cstdint>
#include <vector>

namespace ao::tools {

// RGB. Red: too bright, blue: too dark, white: right; full colour at a difference of 0.5.
[[nodiscard]] std::vector<std::uint8_t> difference_picture(const std::vector<float>& x, const std::vector<float>& reference);

// Gray. White where any bit differs.
[[nodiscard]] std::vector<std::uint8_t> disagreement_picture(const std::vector<float>& x, const std::vector<float>& y);

} // namespace ao::tools
