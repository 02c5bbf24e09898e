#include "tools_pictures.hpp"

#include "scene/courtyard.hpp"
#include "scene/error.hpp"
#include "scene/textures.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>

namespace {

using namespace ao::tools;

std::string reason(const std::string& bytes)
{
    try {
        (void)decode_picture({ reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size() });
    } catch (const error& e) {
        return e.what();
    }
    return {};
}

picture decode(const std::string& bytes)
{
    return decode_picture({ reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size() });
}

// Size at the places where PNG has it; the checksum is not looked at by the decoder.
std::string with_png_size(std::string png, std::uint32_t width, std::uint32_t height)
{
    for (unsigned i = 0; i < 4; ++i) {
        png[16 + i] = static_cast<char>(width >> (24 - 8 * i) & 255u);
        png[20 + i] = static_cast<char>(height >> (24 - 8 * i) & 255u);
    }
    return png;
}

constexpr std::array<std::uint8_t, 4> red{ 255, 0, 0, 255 }, glass{ 10, 200, 30, 64 };

} // namespace

TEST_CASE("pictures are decoded, rows from the top", "[tools][textures]")
{
    const test_picture source = two_rows(7, 5, red, glass);
    SECTION("PNG and TGA keep every bit")
    {
        for (const std::string& bytes : { png_of(source), tga_of(source, false), tga_of(source, true) }) {
            const picture p = decode(bytes);
            CHECK(p.width == 7);
            CHECK(p.height == 5);
            CHECK(p.has_alpha);
            CHECK(p.rgba == source.rgba);
        }
    }
    SECTION("JPEG nearly, and without alpha")
    {
        const test_picture large = two_rows(64, 64, { 200, 40, 90, 255 }, { 20, 90, 160, 255 });
        const picture p = decode(jpeg_of(large));
        REQUIRE(p.rgba.size() == large.rgba.size());
        CHECK_FALSE(p.has_alpha);
        // Far from the border between the colors, which are on rows 0 ... 31 and 32 ... 63; blocks have 16 rows.
        for (const std::size_t row : { 0u, 15u, 48u, 63u })
            for (std::size_t i = 64 * 4 * row; i < 64 * 4 * (row + 1); ++i)
                CHECK(std::abs(p.rgba[i] - large.rgba[i]) <= 6);
    }
}

TEST_CASE("what is no picture is refused with a reason", "[tools][textures]")
{
    const test_picture source = two_rows(32, 32, red, glass);
    const std::string png = png_of(source), jpeg = jpeg_of(source), tga = tga_of(source, false), packed = tga_of(source, true);
    CHECK(reason(png).empty());
    CHECK(reason("") == "the file is empty");
    CHECK(reason("hello, this is only a text and no picture at all") == "not a PNG, JPEG, TGA or BMP picture");
    for (const std::string& whole : { png, jpeg, tga, packed }) {
        INFO(whole.substr(1, 3));
        for (std::size_t size = 1; size + 13 < whole.size(); size += 1 + whole.size() / 50)
            CHECK_FALSE(reason(whole.substr(0, size)).empty());
    }
    CHECK(reason(tga.substr(0, tga.size() / 2)) == "the picture is cut short");
    CHECK(reason(jpeg.substr(0, jpeg.size() / 2)) == "the picture is cut short");
    std::string damaged = png;
    for (std::size_t i = 45; i < damaged.size() - 16; ++i)
        damaged[i] = static_cast<char>(damaged[i] ^ 0x5a);
    CHECK(reason(damaged).find("cannot be decoded") == 0);

    CHECK(reason(with_png_size(png, 16385, 1)).find("must have 1 to 16384 a side") != std::string::npos);
    CHECK(reason(with_png_size(png, 1, 1 << 23)).find("must have 1 to 16384 a side") != std::string::npos);
    CHECK_FALSE(reason(with_png_size(png, 0x7fffffff, 0x7fffffff)).empty());
    CHECK(reason(with_png_size(png, 16384, 16384)).find("more than 67108864 in all") != std::string::npos);
    CHECK_FALSE(reason(with_png_size(png, 0, 32)).empty());
    CHECK_FALSE(reason(with_png_size(png, 16384, 4096)).empty()); // allowed, but the texels are not there
}

TEST_CASE("the largest side is read", "[tools][textures]")
{
    const test_picture wide = two_rows(16384, 2, red, glass);
    CHECK(decode(png_of(wide)).rgba == wide.rgba);
}

TEST_CASE("files are found as models name them", "[tools][textures]")
{
    const scratch_directory dir;
    const auto make = [&](const std::string& path) {
        std::filesystem::create_directories((dir.path / path).parent_path());
        return dir.file(path, "x");
    };
    make("Maps/Wall.PNG");
    make("beside.png");
    make("a b.png");
    make("100%25.png");
    const auto finds = [&](const std::string& name, const std::string& file) {
        INFO(name);
        const std::filesystem::path found = find_picture(dir.path, name);
        CHECK((file.empty() ? found.empty() : std::filesystem::equivalent(found, dir.path / file)));
    };
    finds("Maps/Wall.PNG", "Maps/Wall.PNG");
    finds(".\\Maps\\Wall.PNG", "Maps/Wall.PNG");
    finds("maps/wall.png", "Maps/Wall.PNG");
    finds("Maps/../beside.png", "beside.png");
    finds("C:\\Users\\someone\\BESIDE.png", "beside.png");
    finds("/nowhere/beside.png", "beside.png");
    finds((dir.path / "Maps/Wall.PNG").string(), "Maps/Wall.PNG");
    finds("a%20b.png", "a b.png");
    finds("100%25.png", "100%25.png"); // as written goes before decoded
    finds("none.png", "");
    finds("Maps", "");
    finds("", "");
}

TEST_CASE("stand-ins can be told from pictures", "[tools][textures]")
{
    const picture color = stand_in(texture_use::color), flat = stand_in(texture_use::normals),
                  white = stand_in(texture_use::mask);
    CHECK(std::equal(color.rgba.begin(), color.rgba.begin() + 4, std::begin({ 255, 0, 255, 255 })));
    CHECK(std::count(color.rgba.begin(), color.rgba.end(), 0) == 64 * 64 + 64 * 64); // all green, half of red and blue
    CHECK(std::all_of(white.rgba.begin(), white.rgba.end(), [](int c) { return c == 255; }));
    for (std::size_t i = 0; i < flat.rgba.size(); i += 4)
        REQUIRE(std::equal(flat.rgba.begin() + static_cast<long>(i), flat.rgba.begin() + static_cast<long>(i) + 4,
                           std::begin({ 128, 128, 255, 255 })));
}

TEST_CASE("a missing file is warned of once, whatever it is for", "[tools][textures]")
{
    const scratch_directory dir;
    scene s;
    s.name = "m.obj";
    texture_shelf shelf(s, dir.path);
    const int color = shelf.add("no.png", texture_use::color, {});
    const int mask = shelf.add("no.png", texture_use::mask, {});
    CHECK(shelf.add("no.png", texture_use::color, {}) == color);
    CHECK(color != mask);
    CHECK(s.warnings == std::vector<std::string>{ "m.obj: texture 'no.png': no such file; a checkerboard stands in" });
    CHECK(s.textures.size() == 2);
    for (const scene_texture& t : s.textures) {
        CHECK(t.missing);
        CHECK(t.name == "no.png");
    }
    CHECK(s.textures[0].srgb);
    CHECK_FALSE(s.textures[1].srgb);

    dir.file("bad.png", "no picture");
    (void)shelf.add("bad.png", texture_use::normals, {});
    CHECK(s.warnings.back() == "m.obj: texture 'bad.png': not a PNG, JPEG, TGA or BMP picture; a flat one stands in");
    CHECK(s.warnings.size() == 2);
}

TEST_CASE("one file is one texture per way of sampling it", "[tools][textures]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(2, 2, red, glass)));
    scene s;
    texture_shelf shelf(s, dir.path);
    using ao::wrap_mode;
    CHECK(shelf.add("a.png", texture_use::color, {}) == 0);
    CHECK(shelf.add("a.png", texture_use::normals, {}) == 1);
    CHECK(shelf.add("a.png", texture_use::mask, {}) == 1);
    CHECK(shelf.add("a.png", texture_use::color, { wrap_mode::clamp, wrap_mode::mirror }) == 2);
    CHECK(shelf.add("a.png", texture_use::color, {}) == 0);
    CHECK(s.textures[0].srgb);
    CHECK_FALSE(s.textures[1].srgb);
    CHECK(s.textures[2].wrap_u == wrap_mode::clamp);
    CHECK(s.textures[2].wrap_v == wrap_mode::mirror);
    CHECK(s.warnings.empty());
}

TEST_CASE("heights become normals that lean downhill, green up", "[tools][textures]")
{
    // A ramp that rises to the right by 15 of 255 per texel, and one that rises upward.
    for (const bool upward : { false, true }) {
        test_picture ramp{ 8, 8, {} };
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                const auto height = static_cast<std::uint8_t>(15 * (upward ? 7 - y : x));
                ramp.rgba.insert(ramp.rgba.end(), { height, height, height, 255 });
            }
        const picture heights = decode(png_of(ramp));
        CHECK(is_grey(heights));
        const picture p = normals_of_heights(heights, 17.0f); // slope 1: 45 degrees
        const std::size_t middle = 4 * (8 * 4 + 4);
        const int low = 37, half = 128, high = 218; // 127.5 (1 -+ sqrt(1/2)), 127.5
        CHECK(std::abs(p.rgba[middle] - (upward ? half : low)) <= 1);
        CHECK(std::abs(p.rgba[middle + 1] - (upward ? low : half)) <= 1);
        CHECK(std::abs(p.rgba[middle + 2] - high) <= 1);
    }
}

TEST_CASE("the courtyard's textures have the same bytes everywhere", "[tools][textures]")
{
    const scene s = courtyard();
    REQUIRE(s.textures.size() == 7);
    std::string found;
    for (const scene_texture& t : s.textures) {
        std::uint32_t hash = 2166136261u; // FNV-1a
        for (const std::uint8_t c : t.rgba)
            hash = (hash ^ c) * 16777619u;
        found += t.name + " " + std::to_string(hash) + "\n";
        CHECK(t.srgb == (t.name.find("normals") == std::string::npos && t.name != "drifts"));
    }
    CHECK(found == "leaf 1274498703\npaving 3587905735\npaving normals 320150122\nasphalt 1504955172\n"
                   "asphalt normals 4190085006\nsnow 1596828128\ndrifts 1846216948\n");
}
