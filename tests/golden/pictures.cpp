// Textured models drawn and shaded by every backend, against pictures that were looked at. AO_WRITE_GOLDEN=1 in the environment
// rewrites them from the first backend: look at them again then.
#include "host/scene_runner.hpp"
#include "scene/camera.hpp"
#include "scene/courtyard.hpp"
#include "scene/drawn.hpp"
#include "scene/files.hpp"
#include "scene/images.hpp"
#include "scene/lights_file.hpp"
#include "scene/load.hpp"
#include "scene/picture_files.hpp"

#include "ao/color.hpp"
#include "ao/shading.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using ao::host::scene_picture;

namespace {

constexpr int width = 160;
constexpr int height = 120;

// Backends snap and interpolate in their own ways: pixels at silhouettes and at the edges that alpha maps cut may show another
// surface. Measured between cpu and llvmpipe or lavapipe: at most 3 of 19200 pixels (courtyard), and 1 code elsewhere.
constexpr int code_tolerance = 2;
constexpr std::size_t most_differing = 10;

struct golden_case {
    const char* name;
    const char* model; // below tests/golden/models or the directory of assimp-testmodels; "courtyard"
    bool ours;
    ao::tools::camera camera;
};

ao::tools::camera looking(const glm::vec3& eye, float yaw, float pitch, float fov)
{
    ao::tools::camera c;
    c.eye = eye;
    c.yaw = yaw;
    c.pitch = pitch;
    c.fov = fov;
    return c;
}

const std::vector<golden_case>& cases()
{
    static const std::vector<golden_case> all{
        { "courtyard", "courtyard", true, ao::tools::courtyard_camera() },
        { "leaves", "courtyard", true, looking({ 4.4f, 2.35f, 8.6f }, -60, -10, 25) },
        { "sign", "sign.obj", true, looking({ 1.2f, 0.6f, 4.2f }, -16, -8, 55) },
        { "clearcoat", "glTF2/ClearCoat-glTF/ClearCoatTest.gltf", false, looking({ -5, 1.5f, 14 }, 12, -5, 50) },
        { "spider", "OBJ/spider.obj", false, looking({ 40, 60, 130 }, -21, -22, 46) },
        { "duck", "Collada/duck.dae", false, looking({ 2.3f, 1.5f, 1.6f }, -54, -13, 45) },
        { "human", "Collada/human.zae", false, looking({ 0.12f, 1.6f, 0.42f }, -20, -5, 40) },
    };
    return all;
}

template <class T>
T take(ao::result<T> r)
{
    if (!r) {
        FAIL(std::string(r.error().reason()));
    }
    return std::move(*r);
}

// Empty where the model is not installed.
std::optional<ao::tools::scene> load(const golden_case& c)
{
    if (std::string(c.model) == "courtyard")
        return ao::tools::courtyard();
    const std::filesystem::path path = std::filesystem::path(c.ours ? AO_GOLDEN "/models" : AO_TEST_MODELS) / c.model;
    if (!c.ours && !std::filesystem::exists(path)) {
        WARN("skipped: no " << path << "; Debian's package assimp-testmodels has it");
        return std::nullopt;
    }
    ao::tools::scene s = ao::tools::load_model(path.string());
    for (const std::string& w : s.warnings)
        UNSCOPED_INFO(w);
    return s;
}

// Display codes, RGB, rows from the top.
std::vector<std::uint8_t> rendered(ao::host::scene_runner& r, const ao::tools::scene& model, const ao::tools::camera& c)
{
    ao::tools::scene_view view(model);
    auto lights = ao::tools::default_lights();
    view.set_lights(std::move(lights.lights), lights.ambient);
    const ao::scene s = view.get();
    const auto f = ao::tools::perspective(c, static_cast<float>(width) / static_cast<float>(height),
                                          ao::tools::clip_range(ao::tools::bounds_of(model), c));
    const auto wide = [](float x) { return static_cast<double>(x); };
    ao::gbuffer_camera camera;
    camera.projection =
        ao::make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) },
                            { .rows = ao::first_row::at_ndc_plus_one });
    camera.view = ao::matrix4(ao::tools::view_matrix(c));
    camera.previous_projection = camera.projection;
    camera.previous_view = camera.view;
    ao::gbuffer_facts facts;
    facts.width = width;
    facts.height = height;
    facts.ids = facts.surface = true;
    facts.frame = ao::needs_frame(s);
    ao::shade_facts known;
    known.width = width;
    known.height = height;
    known.visibility = false;
    const ao::shade_plan plan = take(ao::make_shade_plan(s, known, { camera.projection, camera.view }));
    const ao::texel_heap heap = take(ao::make_texel_heap(s.textures));
    static_cast<void>(take(r.load(s, facts)));
    static_cast<void>(take(r.draw(camera)));
    static_cast<void>(take(r.prepare_shading(plan, heap)));
    static_cast<void>(take(r.shade()));
    const ao::picture color = take(r.download(scene_picture::color));
    std::vector<std::uint8_t> codes;
    codes.reserve(3 * color.pixels());
    for (std::size_t i = 0; i < color.pixels(); ++i) {
        const auto texel = color.texel<glm::vec4>(i);
        for (int channel = 0; channel < 3; ++channel)
            codes.push_back(ao::display_code(texel[channel]));
    }
    return codes;
}

} // namespace

TEST_CASE("textured models look as they did when their pictures were looked at", "[golden]")
{
    auto runners = take(ao::host::make_scene_runners("all"));
    REQUIRE_FALSE(runners.empty());
    const bool write = std::getenv("AO_WRITE_GOLDEN") != nullptr;
    for (const golden_case& c : cases()) {
        INFO(c.name);
        const std::optional<ao::tools::scene> model = load(c);
        if (!model)
            continue;
        const std::filesystem::path file = std::filesystem::path(AO_GOLDEN) / (std::string(c.name) + ".png");
        if (write) {
            const auto picture = rendered(*runners.front(), *model, c.camera);
            ao::tools::write_file(file, ao::tools::encode_png({ width, height }, 3, picture));
        }
        const ao::tools::picture golden = ao::tools::read_picture(file);
        REQUIRE(golden.width == width);
        REQUIRE(golden.height == height);
        for (const auto& r : runners) {
            INFO(r->name() << " on " << r->device());
            const auto picture = rendered(*r, *model, c.camera);
            std::size_t differing = 0;
            int greatest = 0;
            for (std::size_t i = 0; i < golden.rgba.size() / 4; ++i) {
                int most = 0;
                for (std::size_t channel = 0; channel < 3; ++channel)
                    most = std::max(most, std::abs(int{ golden.rgba[4 * i + channel] } - int{ picture[3 * i + channel] }));
                differing += most > code_tolerance ? 1 : 0;
                greatest = std::max(greatest, most);
            }
            std::printf("%-10s %-4s %zu pixels differ by more than %d codes, the most by %d\n", c.name,
                        std::string(r->backend()).c_str(), differing, code_tolerance, greatest);
            CHECK(differing <= most_differing);
            CHECK(r->messages().empty());
        }
    }
}
