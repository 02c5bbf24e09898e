// Whether a host's picture is what a plan expects.
#pragma once

#include "ao/cpu/image_view.hpp"
#include "ao/result.hpp"

#include <cstddef>
#include <optional>

namespace ao::cpu::detail {

// errc::unsupported_format, errc::invalid_size; the reason begins with the name.
std::optional<error> unfit(const image_view& v, int width, int height, pixel_format format, const char* name);

inline std::byte* texel_at(const image_view& v, int x, int y)
{
    return static_cast<std::byte*>(v.data) + static_cast<std::size_t>(y) * v.row_bytes +
           static_cast<std::size_t>(x) * static_cast<std::size_t>(bytes_per_pixel(v.format));
}

} // namespace ao::cpu::detail
