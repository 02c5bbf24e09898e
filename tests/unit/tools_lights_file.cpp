// Files of lights: what they mean, and every way in which one can be wrong.
#include "scene/lights_file.hpp"

#include "ao/ambient.hpp"
#include "ao/color.hpp"
#include "scene/environment.hpp"
#include "scene/error.hpp"
#include "scene/images.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace ao::tools;

namespace {

ao::ambient_light no_pictures(const std::string& path)
{
    throw error(path + ": no such file");
}

std::string error_of(const std::string& text)
{
    try {
        static_cast<void>(parse_lights("dir/l.json", text, no_pictures));
    } catch (const error& e) {
        return e.what();
    }
    return "no error";
}

std::string failure_of(const std::string& path)
{
    try {
        static_cast<void>(load_environment(path));
    } catch (const error& e) {
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a file of lights becomes lights and ambient light", "[tools][lights_file]")
{
    const scene_lights s = parse_lights("l.json", R"({
  "ambient": [0.25, 0.5, 1],
  "lights": [
    { "type": "directional", "towards": [0, 2, 0], "color": [1, 2, 3] },
    { "type": "point", "position": [-1, 4, 5], "color": [3, 2, 1], "attenuation": [1, 0.5, 0.25] }
  ]
})",
                                        no_pictures);
    CHECK(s.ambient.coefficients[0] == glm::vec3(0.25f, 0.5f, 1.0f));
    CHECK(s.ambient.coefficients[1] == glm::vec3(0.0f));
    REQUIRE(s.lights.size() == 2);
    CHECK(s.lights[0].type == ao::light_type::directional);
    CHECK(s.lights[0].vector == glm::vec3(0.0f, 2.0f, 0.0f));
    CHECK(s.lights[0].color == glm::vec3(1.0f, 2.0f, 3.0f));
    CHECK(s.lights[1].type == ao::light_type::point);
    CHECK(s.lights[1].vector == glm::vec3(-1.0f, 4.0f, 5.0f));
    CHECK(s.lights[1].attenuation == glm::vec3(1.0f, 0.5f, 0.25f));

    const scene_lights nothing = parse_lights("l.json", "{}", no_pictures);
    CHECK(nothing.lights.empty());
    CHECK(nothing.ambient.coefficients[0] == glm::vec3(0.0f));
}

TEST_CASE("lights may be named instead of read from a file", "[tools][lights_file]")
{
    CHECK(choose_lights("default").lights.size() == 1);
    CHECK(choose_lights("none").lights.empty());
    CHECK(choose_lights("none").ambient.coefficients[0] == glm::vec3(1.0f));
    const scratch_directory dir;
    CHECK(choose_lights(dir.file("l.json", "{\"ambient\": [0, 1, 0]}")).ambient.coefficients[0] == glm::vec3(0.0f, 1.0f, 0.0f));
    CHECK_THROWS_WITH(choose_lights("missing.json"), "missing.json: no such file");
    CHECK_THROWS_WITH(choose_lights(dir.path.string()), Catch::Contains("not a regular file"));
}

TEST_CASE("what is wrong with a file of lights is named with line, column and path", "[tools][lights_file]")
{
    const auto light = [](const std::string& body) { return "{\"lights\": [\n  {" + body + "}]}"; };
    const std::pair<std::string, std::string> cases[] = {
        { "{", "dir/l.json:1:" },
        { "null", "dir/l.json:1:1: /: must be an object, is null" },
        { "{\"light\": []}", "/light: unknown member; known are ambient, lights" },
        { "{\"lights\": {}}", "/lights: must be an array of lights" },
        { "{\"lights\": [1]}", "dir/l.json:1:13: /lights/0: must be an object, is a number" },
        { "{\"ambient\": 1}", "/ambient: must be an array of 3 numbers, is a number" },
        { "{\"ambient\": [1, 2]}", "/ambient: must be an array of 3 numbers, has 2" },
        { "{\"ambient\": [1, 2, -1]}", "dir/l.json:1:20: /ambient/2: must be 0 to 1e+30, is -1" },
        { "{\"ambient\": [1, 2, 1e31]}", "/ambient/2: must be 0 to 1e+30" },
        { "{\"ambient\": {\"environment\": 3}}", "/ambient/environment: must be a string" },
        { "{\"ambient\": {\"environment\": \"\"}}", "/ambient/environment: must be the name of a picture" },
        { "{\"ambient\": {\"environment\": \"e.hdr\"}}", "dir/l.json:1:29: /ambient/environment: dir/e.hdr: no such file" },
        { "{\"ambient\": {\"sky\": 3}}", "/ambient/sky: unknown member" },
        { light(""), "dir/l.json:2:3: /lights/0: has no member 'type'" },
        { light("\"type\": \"spot\""), "dir/l.json:2:12: /lights/0/type: must be 'directional' or 'point', is 'spot'" },
        { light("\"type\": \"point\", \"color\": [1,1,1]"), "/lights/0: has no member 'position'" },
        { light("\"type\": \"point\", \"position\": [1,1,1]"), "/lights/0: has no member 'color'" },
        { light("\"type\": \"point\", \"towards\": [1,1,1]"), "/lights/0/towards: belongs to a directional light" },
        { light("\"type\": \"directional\", \"position\": [1,1,1]"), "/lights/0/position: belongs to a point light" },
        { light("\"type\": \"directional\", \"towards\": [0,0,0], \"color\": [1,1,1]"), "/lights/0/towards: must not be zero" },
        { light("\"type\": \"directional\", \"towards\": [0,\"1\",0], \"color\": [1,1,1]"),
          "/lights/0/towards/1: must be a number" },
        { light("\"type\": \"directional\", \"towards\": [0,1,0], \"color\": [1,1,1], \"attenuation\": [1,0,0]"),
          "/lights/0/attenuation: belongs to a point light" },
        { light("\"type\": \"point\", \"position\": [0,1,0], \"color\": [1,1,1], \"attenuation\": [0,0,0]"),
          "/lights/0/attenuation: must not be all zero" },
        { light("\"type\": \"point\", \"position\": [0,1,0], \"color\": [1,-1,1]"), "/lights/0/color/1: must be 0 to" },
    };
    for (const auto& [text, reason] : cases) {
        INFO(text);
        const std::string message = error_of(text);
        INFO(message);
        CHECK(message.find(reason) != std::string::npos);
        CHECK(message.rfind("dir/l.json:", 0) == 0);
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("an environment's picture becomes ambient light, linear or sRGB", "[tools][lights_file]")
{
    const scratch_directory dir;
    const extent size{ 16, 8 };
    std::vector<std::uint8_t> gray(3 * size.pixels(), 188);
    const std::string png = dir.file("e.png", encode_png(size, 3, gray));
    const float expected = ao::srgb_table[188];
    const ao::ambient_light of_png = load_environment(png);
    const std::vector<glm::vec3> light(size.pixels(), glm::vec3(4.0f, 0.0f, 0.5f));
    const ao::ambient_light of_exr = load_environment(dir.file("e.exr", encode_exr(size, light, "RGB")));
    // A constant sky gives the same from everywhere: the rule over rows is off by less than a percent.
    CHECK(of_png.coefficients[0].x == Approx(expected).epsilon(0.01));
    CHECK(of_exr.coefficients[0].x == Approx(4.0f).epsilon(0.01));
    CHECK(of_exr.coefficients[0].y == 0.0f);
    CHECK(of_exr.coefficients[0].z == Approx(0.5f).epsilon(0.01));

    // Radiance's format, one row of texels as they are: r g b e.
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
    for (int i = 0; i < 8; ++i)
        hdr += std::string("\x80\x40\x00\x82", 4); // 2, 1, 0
    const ao::ambient_light of_hdr = load_environment(dir.file("e.hdr", hdr));
    CHECK(of_hdr.coefficients[0].x == Approx(2.0f * of_hdr.coefficients[0].y));
    CHECK(of_hdr.coefficients[0].x == Approx(2.0f).epsilon(0.2)); // two rows are few
    CHECK(of_hdr.coefficients[0].z == 0.0f);

    CHECK(failure_of((dir.path / "missing.png").string()).find("no such file") != std::string::npos);
    CHECK(failure_of(dir.path.string()).find("not a regular file") != std::string::npos);
    CHECK(failure_of(dir.file("empty.png", "")).find("not a picture") != std::string::npos);
    CHECK(failure_of(dir.file("text.exr", "hello")).find("not a picture") != std::string::npos);
    const std::string whole = encode_exr(size, light, "RGB");
    CHECK(failure_of(dir.file("cut.exr", whole.substr(0, whole.size() / 2))) != "no error");
    CHECK(failure_of(dir.file("negative.exr", encode_exr(size, std::vector<glm::vec3>(size.pixels(), glm::vec3(-1.0f)), "RGB")))
              .find("negative") != std::string::npos);
}

TEST_CASE("an environment's picture is read texel by texel", "[tools][lights_file]")
{
    const scratch_directory dir;
    const extent size{ 5, 3 };
    std::vector<std::uint8_t> codes;
    std::vector<glm::vec3> light;
    for (int i = 0; i < 15; ++i) {
        codes.insert(codes.end(), { std::uint8_t(i), std::uint8_t(255 - i), std::uint8_t(7 * i) });
        light.emplace_back(0.5f * float(i), 100.0f, float(15 - i));
    }
    const ao::light_picture of_png = load_light_picture(dir.file("l.png", encode_png(size, 3, codes)));
    const ao::light_picture of_exr = load_light_picture(dir.file("l.exr", encode_exr(size, light, "RGB")));
    REQUIRE((of_png.width == 5 && of_png.height == 3 && of_png.texels.size() == 15));
    REQUIRE((of_exr.width == 5 && of_exr.height == 3));
    CHECK(of_exr.texels == light);
    for (std::size_t i = 0; i < 15; ++i)
        CHECK(of_png.texels[i] ==
              glm::vec3(ao::srgb_table[codes[3 * i]], ao::srgb_table[codes[3 * i + 1]], ao::srgb_table[codes[3 * i + 2]]));

    const auto failure = [](const std::string& path) -> std::string {
        try {
            static_cast<void>(load_light_picture(path));
        } catch (const error& e) {
            return e.what();
        }
        return "no error";
    };
    CHECK(failure((dir.path / "missing.hdr").string()).find("no such file") != std::string::npos);
    CHECK(failure(dir.file("text.hdr", "hello")).find("not a picture") != std::string::npos);
    CHECK(failure(dir.file("nan.exr", encode_exr(size, std::vector<glm::vec3>(15, glm::vec3(std::nanf(""))), "RGB")))
              .find("not finite") != std::string::npos);
    const extent wide{ 16385, 1 };
    CHECK(failure(dir.file("wide.png", encode_png(wide, 3, std::vector<std::uint8_t>(3 * 16385)))).find("sides are 1 to 16384") !=
          std::string::npos);
}

TEST_CASE("the documented lights load", "[tools][lights_file]")
{
    const scene_lights s = parse_lights("docs/scenes.md", documented_example("lights"), no_pictures);
    CHECK(s.lights.size() == 2);
    CHECK(s.ambient.coefficients[0].x == 0.3f);
}
