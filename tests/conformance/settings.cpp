// Nothing that can be set is ignored: on every backend each setting, fact and part of the camera changes the picture.
#include "ao/conformance/pictures.hpp"
#include "conformance/runners.hpp"

#include <catch2/catch.hpp>

#include <functional>

using namespace ao;
using namespace ao::conformance;

namespace {

constexpr int width = 64;
constexpr int height = 48;

struct frame_input {
    ao::settings settings;
    ao::facts facts;
    ao::camera camera;
};

// The near plane is close, so that even 24 and 32 bits of depth differ in some tap.
frame_input base()
{
    frame_input in;
    in.settings.radius = 0.8F;
    in.settings.thickness = 1.0F;
    in.facts.width = width;
    in.facts.height = height;
    in.facts.depth = depth_source::hardware;
    in.facts.depth_format = pixel_format::d32f;
    in.facts.normal_format = pixel_format::rgba32f;
    in.camera.projection = make_projection({ -0.7, 0.7, -0.525, 0.525, 0.02, 60 });
    return in;
}

// The same bytes for every variation that keeps the formats.
picture run(host::runner& r, const frame_input& in)
{
    const frame_input fixed = base();
    const surfaces seen = make_scene(width, height, fixed.camera.projection);
    const picture depth = pack_depth(seen.depth, width, height, in.facts.depth, in.facts.depth_format, fixed.camera.projection);
    const picture normal = in.facts.normals == normal_source::from_depth
                               ? picture()
                               : pack_normals(seen.normals, width, height, in.facts.normals, in.facts.normal_format);
    auto got = r.run(in.settings, in.facts, in.camera, depth, normal);
    INFO((got ? std::string() : std::string(got.error().reason())));
    REQUIRE(got);
    return *got;
}

struct change {
    const char* name;
    std::function<void(frame_input&)> apply;
};

const std::vector<change> changes{
    { "kernel box", [](frame_input& in) { in.settings.method = method::box; } },
    { "kernel halton", [](frame_input& in) { in.settings.method = method::halton; } },
    { "bitmask", [](frame_input& in) { in.settings.method = method::bitmask; } },
    { "half resolution",
      [](frame_input& in) {
          in.settings.method = method::bitmask;
          in.settings.resolution = resolution::half;
      } },
    { "taps", [](frame_input& in) { in.settings.taps = 33; } },
    { "radius", [](frame_input& in) { in.settings.radius = 0.85F; } },
    { "bias", [](frame_input& in) { in.settings.bias = 0.03F; } },
    { "thickness", [](frame_input& in) { in.settings.thickness = 0.5F; } },
    { "infinite thickness", [](frame_input& in) { in.settings.thickness = std::numeric_limits<float>::infinity(); } },
    { "no filter", [](frame_input& in) { in.settings.filter = 1; } },
    { "filter 7", [](frame_input& in) { in.settings.filter = 7; } },
    { "seed", [](frame_input& in) { in.settings.seed = 2; } },
    { "depth source",
      [](frame_input& in) {
          in.facts.depth = depth_source::position;
          in.facts.depth_format = pixel_format::rgba16f;
      } },
    { "depth format", [](frame_input& in) { in.facts.depth_format = pixel_format::d24; } },
    { "normal source", [](frame_input& in) { in.facts.normals = normal_source::from_depth; } },
    { "normal format",
      [](frame_input& in) {
          in.facts.normals = normal_source::unorm10;
          in.facts.normal_format = pixel_format::rgb10a2;
      } },
    { "world normals",
      [](frame_input& in) {
          in.facts.world_normals = true;
          in.camera.normal_to_view[0][0] = 0.6F;
          in.camera.normal_to_view[0][2] = -0.8F;
          in.camera.normal_to_view[2][0] = 0.8F;
          in.camera.normal_to_view[2][2] = 0.6F;
      } },
    { "output format", [](frame_input& in) { in.facts.output_format = pixel_format::r8; } },
    { "background", [](frame_input& in) { in.camera.background = 6.0F; } },
    { "depth range", [](frame_input& in) { in.camera.projection.range = depth_range::minus_one_to_one; } },
    { "first row", [](frame_input& in) { in.camera.projection.rows = first_row::at_ndc_plus_one; } },
    { "width of the view", [](frame_input& in) { in.camera.projection.matrix[0][0] *= 1.1F; } },
    { "centre of the view", [](frame_input& in) { in.camera.projection.matrix[2][1] += 0.2F; } },
    { "near plane", [](frame_input& in) { in.camera.projection.matrix[3][2] *= 1.1F; } },
    { "parallel",
      [](frame_input& in) {
          in.facts.parallel = true;
          in.camera.projection = make_projection({ -3, 3, -2, 2, 0.25, 60 }, { .parallel = true });
      } },
};

} // namespace

TEST_CASE("every setting, fact and part of the camera changes the picture on every backend")
{
    for (const auto& runner : usual_runners()) {
        const picture before = run(*runner, base());
        const bool repeated = run(*runner, base()).bytes == before.bytes;
        CHECK(repeated);
        for (const change& each : changes) {
            frame_input in = base();
            each.apply(in);
            INFO(runner->name() << ": " << each.name);
            const bool changed = run(*runner, in).bytes != before.bytes;
            CHECK(changed);
        }
    }
}

TEST_CASE("world normals are those of view space once they are turned")
{
    for (const auto& runner : usual_runners()) {
        frame_input in = base();
        const picture before = run(*runner, in);
        // The identity takes the same road and must arrive at the same bits.
        in.facts.world_normals = true;
        INFO(runner->name());
        const bool unchanged = run(*runner, in).bytes == before.bytes;
        CHECK(unchanged);
    }
}
