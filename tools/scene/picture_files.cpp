#include "picture_files.hpp"

#include "error.hpp"

#include "ao/scene_check.hpp"

#include <stb_image.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

namespace ao::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = std::uintmax_t{ 1 } << 29;

struct free_texels {
    void operator()(stbi_uc* texels) const { stbi_image_free(texels); }
};

bool begins(std::span<const std::uint8_t> bytes, std::initializer_list<std::uint8_t> with)
{
    return bytes.size() >= with.size() && std::equal(with.begin(), with.end(), bytes.begin());
}

// stb_image takes the end of a JPEG for grey: a picture without end marker after its last scan was cut short.
bool jpeg_is_whole(std::span<const std::uint8_t> bytes)
{
    for (std::size_t i = bytes.size() - 1; i > 0; --i)
        if (bytes[i - 1] == 0xff && (bytes[i] == 0xd9 || bytes[i] == 0xda))
            return bytes[i] == 0xd9;
    return false;
}

// Truevision TGA 2.0: header of 18 bytes, name, palette, texels.
struct tga_header {
    std::size_t name, palette_type, type, palette_first, palette_length, palette_bits, width, height, bits;

    explicit tga_header(std::span<const std::uint8_t> b)
        : name(b[0]),
          palette_type(b[1]),
          type(b[2]),
          palette_first(b[3] + 256u * b[4]),
          palette_length(b[5] + 256u * b[6]),
          palette_bits(b[7]),
          width(b[12] + 256u * b[13]),
          height(b[14] + 256u * b[15]),
          bits(b[16])
    {
    }
    bool plausible() const
    {
        const bool indexed = type == 1 || type == 9;
        const bool known = indexed || type == 2 || type == 3 || type == 10 || type == 11;
        return known && palette_type == (indexed ? 1u : 0u) &&
               (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
    }
};

// stb_image leaves what is missing uninitialised, and takes the first palette entry's number for bytes to skip.
bool tga_is_whole(const tga_header& h, std::span<const std::uint8_t> bytes)
{
    const std::size_t texel = (h.bits + 7) / 8;
    std::size_t at = 18 + h.name + (h.palette_type != 0 ? h.palette_first + h.palette_length * ((h.palette_bits + 7) / 8) : 0);
    const std::size_t texels = h.width * h.height;
    if (h.type < 8)
        return at + texels * texel <= bytes.size();
    for (std::size_t done = 0; done < texels;) {
        if (at >= bytes.size())
            return false;
        const std::size_t count = 1 + (bytes[at] & 127u);
        at += 1 + ((bytes[at] & 128u) != 0 ? 1 : count) * texel;
        done += count;
    }
    return at <= bytes.size();
}

// Nothing if the picture is worth decoding.
const char* check_format(std::span<const std::uint8_t> bytes)
{
    constexpr const char* cut = "the picture is cut short";
    if (bytes.empty())
        return "the file is empty";
    if (begins(bytes, { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' }) || begins(bytes, { 'B', 'M' }))
        return nullptr;
    if (begins(bytes, { 0xff, 0xd8, 0xff }))
        return jpeg_is_whole(bytes) ? nullptr : cut;
    if (bytes.size() >= 18 && tga_header(bytes).plausible()) {
        const tga_header h(bytes);
        return h.width == 0 || h.height == 0 || tga_is_whole(h, bytes) ? nullptr : cut;
    }
    return "not a PNG, JPEG, TGA or BMP picture";
}

std::string decoded_uri(const std::string& name)
{
    std::string out;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto digit = [&](std::size_t at) { return std::isxdigit(static_cast<unsigned char>(name[at])) != 0; };
        if (name[i] == '%' && i + 2 < name.size() && digit(i + 1) && digit(i + 2)) {
            out += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
            i += 2;
        }
        else {
            out += name[i];
        }
    }
    return out;
}

bool same_but_case(const std::string& a, const std::string& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

// A regular file, each component in any case where there is none as written. The first in alphabetical order where several fit.
std::optional<fs::path> regular_file(const fs::path& path)
{
    std::error_code none;
    if (fs::is_regular_file(path, none))
        return path;
    fs::path found = path.is_absolute() ? path.root_path() : fs::path(".");
    for (const fs::path& part : path.relative_path()) {
        if (part.empty() || fs::exists(found / part, none)) {
            found /= part;
            continue;
        }
        std::vector<fs::path> fitting;
        for (fs::directory_iterator entry(found, none), end; !none && entry != end; entry.increment(none))
            if (same_but_case(entry->path().filename().string(), part.string()))
                fitting.push_back(entry->path());
        if (fitting.empty())
            return std::nullopt;
        found = *std::min_element(fitting.begin(), fitting.end());
    }
    if (fs::is_regular_file(found, none))
        return found;
    return std::nullopt;
}

} // namespace

picture decode_picture(std::span<const std::uint8_t> bytes)
{
    if (const char* const wrong = check_format(bytes))
        throw error(wrong);
    if (bytes.size() > largest_file)
        throw error("the file is too large");
    const auto size = static_cast<int>(bytes.size());
    picture p;
    int channels = 0;
    // The size is looked at before anything is reserved for it.
    if (stbi_info_from_memory(bytes.data(), size, &p.width, &p.height, &channels) == 0)
        throw error(std::string("cannot be decoded (") + stbi_failure_reason() + ")");
    const std::string extent = std::to_string(p.width) + " x " + std::to_string(p.height) + " pixels, ";
    if (p.width < 1 || p.height < 1 || p.width > ao::max_texture_size || p.height > ao::max_texture_size)
        throw error(extent + "must have 1 to " + std::to_string(ao::max_texture_size) + " a side");
    if (static_cast<long>(p.width) * p.height > largest_picture)
        throw error(extent + "more than " + std::to_string(largest_picture) + " in all");

    int width = 0, height = 0;
    const std::unique_ptr<stbi_uc, free_texels> texels(stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4));
    if (!texels || width != p.width || height != p.height)
        throw error(std::string("cannot be decoded (") + (texels ? "size" : stbi_failure_reason()) + ")");
    p.has_alpha = channels == 2 || channels == 4;
    p.rgba.assign(texels.get(), texels.get() + 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return p;
}

picture read_picture(const fs::path& path)
{
    std::error_code failure;
    const std::uintmax_t size = fs::file_size(path, failure);
    if (failure)
        throw error(failure.message());
    if (size > largest_file)
        throw error("the file is too large");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
        throw error("cannot be read");
    return decode_picture(bytes);
}

fs::path find_picture(const fs::path& directory, const std::string& name)
{
    for (std::string words : { name, decoded_uri(name) }) {
        std::replace(words.begin(), words.end(), '\\', '/');
        if (words.find('\0') != std::string::npos || words.empty())
            continue;
        const fs::path path(words);
        for (const fs::path& candidate : { directory / path, directory / path.filename() })
            if (const auto found = regular_file(candidate))
                return *found;
    }
    return {};
}

} // namespace ao::tools
