// OpenGL's geometry pass.
#include "ao/gl/rasterizer.hpp"
#include "unit/gl_pictures.hpp"
#include "unit/raster_bad_input.hpp"

#include <string>
#include <vector>

using namespace gl_test;
using namespace raster_test;

namespace {

ao::gl::rasterizer rasterizer(const ao::gl::raster_options& o = {})
{
    auto made = ao::gl::rasterizer::create(context().loader(), o);
    REQUIRE(made);
    return std::move(*made);
}

drawn draw(ao::gl::rasterizer& gl, const ao::scene& s, const ao::gbuffer_facts& f, const ao::gbuffer_camera& camera)
{
    const auto plan = ao::plan_drawing(s, f);
    REQUIRE(plan);
    auto model = gl.load(s, *plan);
    if (!model) {
        FAIL(std::string(model.error().reason()));
    }
    std::vector<ao::host::gl_texture> kept;
    const auto target = [&](bool wanted, pixel_format format) {
        if (wanted) {
            kept.push_back(make_texture(format, f.width, f.height));
        }
        return wanted ? kept.back().name : 0xdeadU; // names that are not wanted are not looked at
    };
    ao::gbuffer_images<unsigned> images{};
    images.depth = target(true, f.depth_format);
    images.position = target(f.position, f.position_format);
    images.normal = target(f.normal, f.normal_format);
    images.motion = target(f.motion, f.motion_format);
    images.ids = target(f.ids, pixel_format::rg32ui);
    images.surface = target(f.surface, pixel_format::rgba32f);
    images.frame = target(f.frame, pixel_format::rgba32f);
    auto targets = gl.bind(*model, images);
    if (!targets) {
        FAIL(std::string(targets.error().reason()));
    }
    gl.record({}, *model, *targets, camera);
    drawn d;
    d.programs = model->programs();
    d.draw_calls = model->draw_calls();
    d.variants = plan->variants.size();
    std::size_t next = 0;
    const auto fetch = [&](bool wanted) { return wanted ? download(kept[next++]) : ao::picture(); };
    d.depth = fetch(true);
    d.position = fetch(f.position);
    d.normal = fetch(f.normal);
    d.motion = fetch(f.motion);
    d.ids = fetch(f.ids);
    d.surface = fetch(f.surface);
    d.frame = fetch(f.frame);
    return d;
}

} // namespace

TEST_CASE("every target is what rays see: standard, reversed, infinite, parallel, either depth range and first row")
{
    auto gl = rasterizer();
    check_targets([&](const auto& s, const auto& f, const auto& c) { return draw(gl, s, f, c); });
}

TEST_CASE("shader text draws what SPIR-V draws")
{
    world w = plain_world();
    const ao::scene s = w.get();
    const auto view = camera({});
    auto from_spirv = rasterizer({ ao::gl::shader_source::spirv });
    auto from_text = rasterizer({ ao::gl::shader_source::text });
    const drawn a = draw(from_spirv, s, all_targets(), view);
    const drawn b = draw(from_text, s, all_targets(), view);
    CHECK(differing(a.ids, b.ids) == 0);
    CHECK(differing(a.depth, b.depth) == 0);
    CHECK(differing(a.position, b.position) == 0);
    CHECK(differing(a.normal, b.normal) == 0);
}

TEST_CASE("normal maps: mirrored UVs, mirrored and unevenly scaled models, either green, both samplers; alpha is cut")
{
    for (const ao::gl::raster_options& o :
         { ao::gl::raster_options{ ao::gl::shader_source::spirv }, ao::gl::raster_options{ ao::gl::shader_source::text },
           ao::gl::raster_options{ ao::gl::shader_source::spirv, ao::gl::sampling::hardware } }) {
        INFO("source " << static_cast<int>(o.source) << ", sampling " << static_cast<int>(o.sampling));
        auto gl = rasterizer(o);
        check_maps([&](const auto& s, const auto& f, const auto& c) { return draw(gl, s, f, c); });
    }
}

TEST_CASE("programs are as many as the needs, and targets that are off are not looked at")
{
    world w = plain_world();
    auto gl = rasterizer();
    ao::gbuffer_facts f = all_targets();
    const auto view = camera({});
    const drawn all = draw(gl, w.get(), f, view);
    // Sides, mirroring and a mesh's own normals are no needs of a shader; reading uvs and deforming are.
    CHECK(all.variants == 6);
    CHECK(all.programs == 3);
    CHECK(all.draw_calls == all.variants);
    ao::gbuffer_facts few;
    few.width = width;
    few.height = height;
    few.normal = false;
    const drawn depth = draw(gl, w.get(), few, view);
    CHECK(depth.programs == 1);
    CHECK(differing(depth.depth, all.depth) == 0);
}

TEST_CASE("normals arrive in every format")
{
    auto gl = rasterizer();
    check_normal_formats([&](const auto& s, const auto& f, const auto& c) { return draw(gl, s, f, c); });
}

TEST_CASE("objects move, and what no longer fits the plan is refused")
{
    world w = plain_world();
    auto gl = rasterizer();
    const ao::gbuffer_facts f = all_targets();
    const auto view = camera({});
    const auto plan = ao::plan_drawing(w.get(), f);
    REQUIRE(plan);
    auto model = gl.load(w.get(), *plan);
    REQUIRE(model);
    w.objects[1].previous_model = w.objects[1].model;
    w.objects[1].model = ao::matrix4(placed({ -1.0F, 0.9F, 0.2F }, 0.6F, { 1.1F, 1, 1 }));
    REQUIRE_FALSE(gl.move(*model, w.get()));
    std::vector<ao::host::gl_texture> kept;
    const auto target = [&](pixel_format format) {
        kept.push_back(make_texture(format, width, height));
        return kept.back().name;
    };
    ao::gbuffer_images<unsigned> images{};
    images.depth = target(pixel_format::d32f);
    images.position = target(pixel_format::rgba32f);
    images.normal = target(pixel_format::rgba32f);
    images.motion = target(pixel_format::rg32f);
    images.ids = target(pixel_format::rg32ui);
    images.surface = target(pixel_format::rgba32f);
    auto targets = gl.bind(*model, images);
    REQUIRE(targets);
    gl.record({}, *model, *targets, view);
    drawn d;
    d.depth = download(kept[0]);
    d.position = download(kept[1]);
    d.normal = download(kept[2]);
    d.motion = download(kept[3]);
    d.ids = download(kept[4]);
    d.surface = download(kept[5]);
    compare(w, view, d, 1e-6);

    using Catch::Matchers::Contains;
    const auto moved_wrong = [&](const ao::scene& s) { return std::string(gl.move(*model, s)->reason()); };
    world mirrored = w;
    mirrored.objects[0].model[0][0] *= -1;
    mirrored.objects[0].model[0][1] *= -1;
    mirrored.objects[0].model[0][2] *= -1;
    CHECK_THAT(moved_wrong(mirrored.get()), Contains("object 0 mirrors now"));
    world fewer = w;
    fewer.objects.pop_back();
    CHECK_THAT(moved_wrong(fewer.get()), Contains("another number of objects"));
    ao::gbuffer_images<unsigned> bad = images;
    bad.ids = images.normal;
    CHECK_THAT(std::string(gl.bind(*model, bad).error().reason()), Contains("ids texture"));
    bad = images;
    bad.depth = 0;
    CHECK_THAT(std::string(gl.bind(*model, bad).error().reason()), Contains("depth texture 0"));
    ao::draw_plan huge = *plan;
    huge.facts.width = 65536;
    CHECK(gl.load(w.get(), huge).error().code() == ao::errc::invalid_size);
}

TEST_CASE("a million objects are drawn, each with its own transform and id; an empty scene clears")
{
    auto gl = rasterizer();
    check_many_objects([&](const auto& s, const auto& f, const auto& c) { return draw(gl, s, f, c); }, 1000000);
}

TEST_CASE("triangles without area or with vertices that are not finite leave no mark, attributes that are not finite no NaN")
{
    auto gl = rasterizer();
    const auto on_device = [&](const auto& s, const auto& f, const auto& c) { return draw(gl, s, f, c); };
    check_bad_triangles(on_device);
    check_bad_attributes(on_device);
}
