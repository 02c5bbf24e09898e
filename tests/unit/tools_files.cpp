#include "tools_support.hpp"

#include "scene/error.hpp"
#include "scene/files.hpp"
#include "scene/images.hpp"

#include <catch2/catch.hpp>
#include <stb_image.h>
#include <tinyexr.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <sys/resource.h>

namespace {

using namespace ao::tools;
namespace fs = std::filesystem;

std::string message_of(const fs::path& path, std::string_view bytes)
{
    try {
        write_file(path, bytes);
    } catch (const error& e) {
        return e.what();
    }
    return {};
}

// Channel by name, through the library's general reader.
std::vector<float> read_channel(const std::string& bytes, const std::string& name, extent size)
{
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    EXRVersion version;
    REQUIRE(ParseEXRVersionFromMemory(&version, data, bytes.size()) == TINYEXR_SUCCESS);
    EXRHeader header;
    InitEXRHeader(&header);
    const char* reason = nullptr;
    REQUIRE(ParseEXRHeaderFromMemory(&header, &version, data, bytes.size(), &reason) == TINYEXR_SUCCESS);
    EXRImage image;
    InitEXRImage(&image);
    REQUIRE(LoadEXRImageFromMemory(&image, &header, data, bytes.size(), &reason) == TINYEXR_SUCCESS);
    CHECK(image.width == size.width);
    CHECK(image.height == size.height);
    std::vector<float> values;
    for (int c = 0; c < header.num_channels; ++c)
        if (name == header.channels[c].name) {
            const auto* from = reinterpret_cast<const float*>(image.images[c]);
            values.assign(from, from + size.pixels());
        }
    FreeEXRImage(&image);
    FreeEXRHeader(&header);
    return values;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

} // namespace

TEST_CASE("a float picture comes back with the same bits", "[tools][files]")
{
    const extent size = GENERATE(extent{ 1, 1 }, extent{ 3, 2 }, extent{ 1, 37 }, extent{ 131, 47 });
    std::vector<float> gray;
    std::vector<glm::vec3> colour;
    for (std::size_t i = 0; i < size.pixels(); ++i) {
        const float v = std::sin(static_cast<float>(i)) * 1.0e3f;
        gray.push_back(i % 11 == 5 ? std::numeric_limits<float>::infinity() : v);
        colour.emplace_back(v, v + 1.0f, -v);
    }
    CHECK(same_bits(read_channel(encode_exr(size, gray), "Y", size), gray));

    const auto one = [&](int c) {
        std::vector<float> values;
        for (const glm::vec3& v : colour)
            values.push_back(v[c]);
        return values;
    };
    const std::string rgb = encode_exr(size, colour, "RGB"), xyz = encode_exr(size, colour, "XYZ");
    for (int c = 0; c < 3; ++c) {
        CHECK(same_bits(read_channel(rgb, std::string(1, "RGB"[c]), size), one(c)));
        CHECK(same_bits(read_channel(xyz, std::string(1, "XYZ"[c]), size), one(c)));
    }
}

TEST_CASE("a PNG comes back with the same bytes, row 0 on top", "[tools][files]")
{
    const extent size{ 7, 5 };
    const int channels = GENERATE(1, 3);
    std::vector<std::uint8_t> pixels;
    for (std::size_t i = 0; i < size.pixels() * static_cast<std::size_t>(channels); ++i)
        pixels.push_back(static_cast<std::uint8_t>(i * 7));
    const std::string png = encode_png(size, channels, pixels);
    int width = 0, height = 0, found = 0;
    const std::unique_ptr<stbi_uc, decltype(&std::free)> read(stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()),
                                                                                    static_cast<int>(png.size()), &width, &height,
                                                                                    &found, 0),
                                                              &std::free);
    REQUIRE(read);
    CHECK(width == size.width);
    CHECK(height == size.height);
    REQUIRE(found == channels);
    CHECK(std::memcmp(read.get(), pixels.data(), pixels.size()) == 0);
}

TEST_CASE("values outside 0..1 are clamped on the way to bytes", "[tools][files]")
{
    const std::vector<float> values{ -1.0f, 0.0f, 0.5f, 1.0f, 7.0f, std::numeric_limits<float>::quiet_NaN() };
    CHECK(to_bytes(values) == std::vector<std::uint8_t>{ 0, 0, 128, 255, 255, 0 });
}

TEST_CASE("writing replaces the whole file or nothing", "[tools][files]")
{
    const scratch_directory dir;
    const fs::path target = dir.path / "a.txt";
    write_file(target, "first, the longer one");
    write_file(target, "second");
    CHECK(read_all(target) == "second");
    CHECK(files_in(dir.path) == 1);

    SECTION("a link is followed")
    {
        fs::create_symlink("a.txt", dir.path / "link");
        write_file(dir.path / "link", "third");
        CHECK(fs::is_symlink(dir.path / "link"));
        CHECK(read_all(target) == "third");
    }
    SECTION("the file ends in the middle")
    {
        struct rlimit before = {};
        REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
        const auto handler = std::signal(SIGXFSZ, SIG_IGN);
        struct rlimit small = before;
        small.rlim_cur = 4096;
        REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
        const std::string message = message_of(target, std::string(100000, 'x'));
        REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
        std::signal(SIGXFSZ, handler);
        CHECK(message.find(target.string()) == 0);
        CHECK(read_all(target) == "second");
        CHECK(files_in(dir.path) == 1);
    }
    SECTION("a directory is in the way")
    {
        fs::create_directory(dir.path / "taken");
        CHECK(message_of(dir.path / "taken", "x").find("directory") != std::string::npos);
        CHECK(files_in(dir.path) == 2);
        CHECK(files_in(dir.path / "taken") == 0);
    }
}

TEST_CASE("an unwritable path is one line with path and reason", "[tools][files]")
{
    const scratch_directory dir;
    dir.file("plain", "text");
    for (const char* name : { "missing/a.png", "plain/a.png" }) {
        const std::string message = message_of(dir.path / name, "x");
        CHECK(message.find((dir.path / name).string()) == 0);
        CHECK(message.find('\n') == std::string::npos);
    }
    CHECK(files_in(dir.path) == 1);
    CHECK_THROWS_AS(make_directory(dir.path / "plain" / "sub"), error);
    CHECK_THROWS_AS(make_directory(dir.path / "plain"), error);
    make_directory(dir.path / "a" / "b");
    CHECK(fs::is_directory(dir.path / "a" / "b"));
}

TEST_CASE("a device is written to, not replaced", "[tools][files]")
{
    if (!fs::is_character_file("/dev/full")) {
        WARN("skipped: no /dev/full here");
        return;
    }
    CHECK(message_of("/dev/full", "x").find("/dev/full: cannot write: No space left") == 0);
    CHECK(fs::is_character_file("/dev/full"));
}
