#include "views.hpp"

#include <string>

namespace ao::cpu::detail {

std::optional<error> unfit(const image_view& v, int width, int height, pixel_format format, const char* name)
{
    const auto say = [&](errc code, const char* what) { return error(code, std::string(name) + ": " + what); };
    if (v.format != format) {
        return say(errc::unsupported_format, "format differs from the plan's");
    }
    if (v.data == nullptr) {
        return say(errc::invalid_size, "no data");
    }
    if (v.width != width || v.height != height) {
        return say(errc::invalid_size, "size differs from the plan's");
    }
    const auto pixel = static_cast<std::size_t>(bytes_per_pixel(format));
    if (v.row_bytes < static_cast<std::size_t>(v.width) * pixel || (format != pixel_format::r8 && v.row_bytes % 4 != 0)) {
        return say(errc::invalid_size, "row_bytes must hold a row and be a multiple of 4");
    }
    if (v.row_bytes / 4 > 0x7fffffffU / static_cast<std::size_t>(v.height)) {
        return say(errc::invalid_size, "more than 2^31 - 1 words");
    }
    return std::nullopt;
}

} // namespace ao::cpu::detail
