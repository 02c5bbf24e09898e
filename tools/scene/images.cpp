#include "images.hpp"

#include "error.hpp"

#include <stb_image_write.h>
#include <tinyexr.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>

namespace ao::tools {
namespace {

struct channel {
    char name;
    std::vector<float> values;
};

// Channels in alphabetical order, as the format demands.
std::string encode_channels(extent size, std::vector<channel>& channels)
{
    std::vector<EXRChannelInfo> infos(channels.size());
    std::vector<int> types(channels.size(), TINYEXR_PIXELTYPE_FLOAT);
    std::vector<unsigned char*> pointers;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        infos[i] = {};
        infos[i].name[0] = channels[i].name;
        pointers.push_back(reinterpret_cast<unsigned char*>(channels[i].values.data()));
    }

    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = static_cast<int>(channels.size());
    header.channels = infos.data();
    header.pixel_types = types.data();
    header.requested_pixel_types = types.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;

    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = header.num_channels;
    image.images = pointers.data();
    image.width = size.width;
    image.height = size.height;

    unsigned char* bytes = nullptr;
    const char* reason = nullptr;
    const std::size_t count = SaveEXRImageToMemory(&image, &header, &bytes, &reason);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owner(bytes, &std::free);
    if (count == 0) {
        const std::string message = reason != nullptr ? one_line(reason) : "unknown reason";
        FreeEXRErrorMessage(reason);
        throw error("cannot encode an EXR image: " + message);
    }
    return { reinterpret_cast<const char*>(bytes), count };
}

} // namespace

std::vector<std::uint8_t> to_bytes(std::span<const float> values)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(values.size());
    for (const float v : values) {
        const float clamped = v > 0.0f ? (v < 1.0f ? v : 1.0f) : 0.0f;
        bytes.push_back(static_cast<std::uint8_t>(std::lround(clamped * 255.0f)));
    }
    return bytes;
}

std::string encode_png(extent size, int channels, std::span<const std::uint8_t> pixels)
{
    std::string bytes;
    const auto append = [](void* to, void* data, int count) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(count));
    };
    if (stbi_write_png_to_func(append, &bytes, size.width, size.height, channels, pixels.data(), size.width * channels) == 0)
        throw error("cannot encode a PNG image");
    return bytes;
}

std::string encode_exr(extent size, std::span<const float> values)
{
    std::vector<channel> channels{ { 'Y', { values.begin(), values.end() } } };
    return encode_channels(size, channels);
}

std::string encode_exr(extent size, std::span<const glm::vec3> values, const char (&names)[4])
{
    std::vector<channel> channels;
    for (int c = 0; c < 3; ++c) {
        channels.push_back({ names[c], {} });
        channels.back().values.reserve(values.size());
        for (const glm::vec3& v : values)
            channels.back().values.push_back(v[c]);
    }
    if (channels.front().name > channels.back().name)
        std::swap(channels.front(), channels.back());
    return encode_channels(size, channels);
}

} // namespace ao::tools
