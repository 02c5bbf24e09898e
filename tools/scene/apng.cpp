#include "apng.hpp"

#include "error.hpp"

#include <zlib.h>

#include <cstdlib>

namespace ao::tools {
namespace {

std::string big_endian(std::uint32_t value, int bytes = 4)
{
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        text += static_cast<char>(static_cast<unsigned char>(value >> shift & 255u));
    return text;
}

void append_chunk(std::string& file, const char* type, const std::string& data)
{
    const std::string body = type + data;
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    file += big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(static_cast<std::uint32_t>(sum));
}

int paeth(int left, int up, int corner)
{
    const int guess = left + up - corner;
    const int to_left = std::abs(guess - left), to_up = std::abs(guess - up), to_corner = std::abs(guess - corner);
    return to_left <= to_up && to_left <= to_corner ? left : to_up <= to_corner ? up : corner;
}

// Type 4, Paeth: the one that does well on smooth gray.
std::string filtered_rows(extent size, std::span<const std::uint8_t> gray)
{
    const auto width = static_cast<std::size_t>(size.width);
    std::string rows;
    rows.reserve(size.pixels() + static_cast<std::size_t>(size.height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(size.height); ++y) {
        rows += '\4';
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t at = y * width + x;
            const int left = x > 0 ? gray[at - 1] : 0;
            const int up = y > 0 ? gray[at - width] : 0;
            const int corner = x > 0 && y > 0 ? gray[at - width - 1] : 0;
            rows += static_cast<char>(static_cast<unsigned char>((gray[at] - paeth(left, up, corner)) & 255));
        }
    }
    return rows;
}

} // namespace

void animation::add(std::span<const std::uint8_t> gray)
{
    const std::string rows = filtered_rows(size_, gray);
    uLongf length = compressBound(static_cast<uLong>(rows.size()));
    std::string stream(length, '\0');
    if (compress2(reinterpret_cast<Bytef*>(stream.data()), &length, reinterpret_cast<const Bytef*>(rows.data()),
                  static_cast<uLong>(rows.size()), 6) != Z_OK)
        throw error("cannot encode an animation");
    stream.resize(length);
    stream.shrink_to_fit();
    frames_.push_back(std::move(stream));
}

std::string animation::encode() const
{
    const std::string width = big_endian(static_cast<std::uint32_t>(size_.width));
    const std::string height = big_endian(static_cast<std::uint32_t>(size_.height));
    std::string file = "\x89PNG\r\n\x1a\n";
    // 8 bits, gray, deflate, the usual filters, not interlaced.
    append_chunk(file, "IHDR", width + height + std::string("\x08\0\0\0\0", 5));
    append_chunk(file, "acTL", big_endian(static_cast<std::uint32_t>(frames_.size())) + big_endian(0));
    std::uint32_t sequence = 0;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        // At the origin, for 1 / rate of a second, left there and overwritten.
        append_chunk(file, "fcTL",
                     big_endian(sequence++) + width + height + big_endian(0) + big_endian(0) + big_endian(1, 2) +
                         big_endian(static_cast<std::uint32_t>(rate_), 2) + std::string(2, '\0'));
        if (i == 0)
            append_chunk(file, "IDAT", frames_[i]);
        else
            append_chunk(file, "fdAT", big_endian(sequence++) + frames_[i]);
    }
    append_chunk(file, "IEND", "");
    return file;
}

} // namespace ao::tools
