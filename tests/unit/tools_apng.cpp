// Animations as a program that knows APNG reads them, chunk by chunk, and as one that does not.
#include "scene/apng.hpp"
#include "scene/picture_files.hpp"

#include <catch2/catch.hpp>
#include <zlib.h>

#include <cstdlib>

using namespace ao::tools;

namespace {

struct chunk {
    std::string type;
    std::string data;
};

std::uint32_t number(const std::string& bytes, std::size_t at, std::size_t length = 4)
{
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + length; ++i)
        value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

// Each with its checksum right, by a table-free CRC of its own (PNG, annex D).
std::vector<chunk> chunks_of(const std::string& file)
{
    REQUIRE(file.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    std::vector<chunk> all;
    for (std::size_t at = 8; at < file.size();) {
        REQUIRE(at + 12 <= file.size());
        const std::size_t length = number(file, at);
        REQUIRE(at + 12 + length <= file.size());
        std::uint32_t sum = 0xffffffffU;
        for (std::size_t i = at + 4; i < at + 8 + length; ++i) {
            sum ^= static_cast<unsigned char>(file[i]);
            for (int bit = 0; bit < 8; ++bit)
                sum = (sum & 1U) != 0 ? 0xedb88320U ^ (sum >> 1U) : sum >> 1U;
        }
        CHECK((sum ^ 0xffffffffU) == number(file, at + 8 + length));
        all.push_back({ file.substr(at + 4, 4), file.substr(at + 8, length) });
        at += 12 + length;
    }
    return all;
}

// What each row's filter of type 4 made of it, undone.
std::vector<std::uint8_t> decode(const std::string& stream, std::size_t width, std::size_t height)
{
    std::string rows((width + 1) * height, '\0');
    auto length = static_cast<uLongf>(rows.size());
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(rows.data()), &length, reinterpret_cast<const Bytef*>(stream.data()),
                       static_cast<uLong>(stream.size())) == Z_OK);
    REQUIRE(length == rows.size());
    std::vector<std::uint8_t> gray(width * height);
    const auto at = [&](std::size_t x, std::size_t y) -> int { return x == 0 || y == 0 ? 0 : gray[(y - 1) * width + x - 1]; };
    for (std::size_t y = 0; y < height; ++y) {
        REQUIRE(rows[y * (width + 1)] == '\4');
        for (std::size_t x = 0; x < width; ++x) {
            const int a = at(x, y + 1), b = at(x + 1, y), c = at(x, y);
            const int p = a + b - c;
            const int pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
            const int guess = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
            gray[y * width + x] =
                static_cast<std::uint8_t>((static_cast<unsigned char>(rows[y * (width + 1) + 1 + x]) + guess) & 255);
        }
    }
    return gray;
}

std::vector<std::uint8_t> noise(extent size, std::uint32_t seed)
{
    std::vector<std::uint8_t> gray;
    for (std::size_t i = 0; i < size.pixels(); ++i) {
        seed = seed * 1664525U + 1013904223U;
        gray.push_back(static_cast<std::uint8_t>(seed >> 24U));
    }
    return gray;
}

} // namespace

TEST_CASE("an animation holds every frame, in order, and its first one is a PNG", "[tools][apng]")
{
    const extent sizes[] = { { 17, 9 }, { 1, 1 }, { 1, 5 }, { 64, 1 } };
    for (const extent size : sizes)
        for (const std::size_t count : { 1U, 2U, 5U }) {
            animation a(size, 24);
            for (std::uint32_t i = 0; i < count; ++i)
                a.add(noise(size, i));
            CHECK(a.frames() == count);
            const std::string file = a.encode();
            const std::vector<chunk> chunks = chunks_of(file);
            REQUIRE(chunks.size() == 3 + 2 * count);
            CHECK(chunks[0].type == "IHDR");
            CHECK(number(chunks[0].data, 0) == static_cast<std::uint32_t>(size.width));
            CHECK(number(chunks[0].data, 4) == static_cast<std::uint32_t>(size.height));
            CHECK(chunks[1].type == "acTL");
            CHECK(number(chunks[1].data, 0) == count);
            CHECK(number(chunks[1].data, 4) == 0); // for ever
            CHECK(chunks.back().type == "IEND");
            std::uint32_t sequence = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const chunk& control = chunks[2 + 2 * i];
                const chunk& data = chunks[3 + 2 * i];
                REQUIRE(control.type == "fcTL");
                REQUIRE(control.data.size() == 26);
                CHECK(number(control.data, 0) == sequence++);
                CHECK(number(control.data, 4) == static_cast<std::uint32_t>(size.width));
                CHECK(number(control.data, 8) == static_cast<std::uint32_t>(size.height));
                CHECK(number(control.data, 20, 2) == 1); // of
                CHECK(number(control.data, 22, 2) == 24);
                REQUIRE(data.type == (i == 0 ? "IDAT" : "fdAT"));
                if (i > 0)
                    CHECK(number(data.data, 0) == sequence++);
                const auto seen = decode(data.data.substr(i == 0 ? 0 : 4), static_cast<std::size_t>(size.width),
                                         static_cast<std::size_t>(size.height));
                CHECK(seen == noise(size, static_cast<std::uint32_t>(i)));
            }
            // By a decoder that is not ours.
            const std::vector<std::uint8_t> bytes(file.begin(), file.end());
            const picture first = decode_picture(bytes);
            CHECK(first.width == size.width);
            CHECK(first.height == size.height);
            const auto expected = noise(size, 0);
            for (std::size_t i = 0; i < size.pixels(); ++i)
                REQUIRE(first.rgba[4 * i] == expected[i]);
        }
}
