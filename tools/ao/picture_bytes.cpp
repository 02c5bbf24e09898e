#include "ao/picture_bytes.hpp"

#include "scene/images.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ao::tools {

std::vector<std::uint8_t> difference_picture(const std::vector<float>& x, const std::vector<float>& reference)
{
    std::vector<float> rgb;
    rgb.reserve(3 * x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const float d = 2.0f * (x[i] - reference[i]);
        rgb.insert(rgb.end(), { 1.0f - std::max(-d, 0.0f), 1.0f - std::abs(d), 1.0f - std::max(d, 0.0f) });
    }
    return to_bytes(rgb);
}

std::vector<std::uint8_t> disagreement_picture(const std::vector<float>& x, const std::vector<float>& y)
{
    std::vector<std::uint8_t> gray;
    gray.reserve(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        gray.push_back(std::bit_cast<std::uint32_t>(x[i]) == std::bit_cast<std::uint32_t>(y[i]) ? 0 : 255);
    return gray;
}

} // namespace ao::tools
