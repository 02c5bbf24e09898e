// OpenGL's shading passes.
#include "ao/gl/shading.hpp"
#include "unit/deep_blends.hpp"
#include "unit/gl_pictures.hpp"
#include "unit/shade_cases.hpp"

#include <string>

using namespace gl_test;
using namespace shade_test;

namespace {

outcome run(ao::gl::shading& on, const ao::shade_plan& plan, const ao::texel_heap& heap, const ao::conformance::shade_inputs& in)
{
    const auto& f = plan.facts;
    const auto geometry = upload(in.geometry);
    const auto normal = upload(in.normal);
    const auto ids = upload(in.ids);
    const auto surface = upload(in.surface);
    const auto frame = upload(in.frame);
    const auto visibility = upload(in.visibility);
    const auto color = make_texture(pixel_format::rgba32f, f.width, f.height);
    auto program = on.prepare_shading(plan, heap);
    REQUIRE(program);
    // What the plan does not read is not handed over.
    ao::shade_images<unsigned> images{};
    (f.stored_position ? images.position : images.depth) = geometry.name;
    images.normal = normal.name;
    images.ids = ids.name;
    images.surface = plan.options.maps || plan.options.frames ? surface.name : 0;
    images.frame = plan.options.frames ? frame.name : 0;
    images.visibility = plan.options.visibility ? visibility.name : 0;
    images.color = color.name;
    auto bound = on.bind_shading(*program, plan, images);
    REQUIRE(bound);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        on.record_shading({}, *program, *bound, plan, i);
    }
    const auto clamped = on.clamped_weights(*program);
    REQUIRE(clamped);
    return { download(color), *clamped };
}

ao::gl::shading executor(ao::gl::shader_source source)
{
    ao::gl::options o;
    o.source = source;
    auto made = ao::gl::shading::create(context().loader(), o);
    REQUIRE(made);
    return std::move(*made);
}

} // namespace

TEST_CASE("OpenGL shades as scalar C++ does, in every bit, with what the materials need only")
{
    auto gl = executor(ao::gl::shader_source::spirv);
    check_shading([&](const auto& plan, const auto& heap, const auto& in) { return run(gl, plan, heap, in); });
    // The others differ in nothing that the route into the driver could change.
    auto text = executor(ao::gl::shader_source::text);
    check_shading([&](const auto& plan, const auto& heap, const auto& in) { return run(text, plan, heap, in); }, 3, 3);
}

TEST_CASE("OpenGL takes ambient light along bent normals and with bounces as scalar C++ does, in every bit")
{
    for (const auto source : { ao::gl::shader_source::spirv, ao::gl::shader_source::text }) {
        auto gl = executor(source);
        check_openings([&](const auto& plan, const auto& heap, const auto& in) { return run(gl, plan, heap, in); });
    }
}

TEST_CASE("OpenGL blends as scalar C++ does, in every bit, fused, cut and as in the paper")
{
    auto gl = executor(ao::gl::shader_source::spirv);
    check_blending([&](const auto& plan, const auto& heap, const auto& in) { return run(gl, plan, heap, in); });
    auto text = executor(ao::gl::shader_source::text);
    check_blending([&](const auto& plan, const auto& heap, const auto& in) { return run(text, plan, heap, in); }, { 2 });
}

TEST_CASE("OpenGL blends deep and wide trees as double does, shared ones once, with the ends' bits and in linear light")
{
    auto gl = executor(ao::gl::shader_source::spirv);
    const auto on_device = [&](const auto& plan, const auto& heap, const auto& in) { return run(gl, plan, heap, in); };
    check_deep_blends(on_device);
    check_shared_blends(on_device);
    check_blend_ends(on_device);
    check_linear_light(on_device);
}

TEST_CASE("weights outside [0, 1] are clamped and counted")
{
    auto gl = executor(ao::gl::shader_source::automatic);
    check_clamping([&](const auto& plan, const auto& heap, const auto& in) { return run(gl, plan, heap, in); });
}

TEST_CASE("lights and weights change without another program")
{
    auto gl = executor(ao::gl::shader_source::automatic);
    random_scene scene(77, false, false, 6);
    const ao::shade_facts f = facts();
    const auto view = camera(false);
    ao::blend_settings settings;
    settings.fixed_k = false;
    auto plan = ao::make_shade_plan(scene.get(), f, view, settings);
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap({});
    REQUIRE(heap);
    const auto inputs = random_inputs(scene, f, view.projection);
    auto program = gl.prepare_shading(*plan, *heap);
    REQUIRE(program);
    for (int node = 3; node < 6; ++node) {
        ao::set_weight(*plan, node, 0.25F);
    }
    ao::scene darker = scene.get();
    darker.ambient = ao::ambient_light(glm::vec3(0.01F));
    ao::set_lights(*plan, darker);
    REQUIRE_FALSE(gl.update_table(*program, *plan));
    const auto depth = upload(inputs.geometry);
    const auto normal = upload(inputs.normal);
    const auto ids = upload(inputs.ids);
    const auto visibility = upload(inputs.visibility);
    const auto color = make_texture(pixel_format::rgba32f, f.width, f.height);
    ao::shade_images<unsigned> images{};
    images.depth = depth.name;
    images.normal = normal.name;
    images.ids = ids.name;
    images.visibility = visibility.name;
    images.color = color.name;
    auto bound = gl.bind_shading(*program, *plan, images);
    REQUIRE(bound);
    gl.record_shading({}, *program, *bound, *plan, 0);
    CHECK(differing(download(color), ao::conformance::reference_color(*plan, *heap, inputs)) == 0);
    CHECK(*gl.clamped_weights(*program) == 0);

    ao::shade_plan other = *plan;
    other.words.push_back(0);
    REQUIRE(gl.update_table(*program, other));
    CHECK(gl.update_table(*program, other)->code() == ao::errc::plan_mismatch);
}

TEST_CASE("shading refuses pictures and plans that do not fit, and says which")
{
    auto gl = executor(ao::gl::shader_source::automatic);
    random_scene scene(5, true, false, 0);
    const ao::shade_facts f = facts();
    auto plan = ao::make_shade_plan(scene.get(), f, camera(false));
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap(scene.get().textures);
    auto program = gl.prepare_shading(*plan, *heap);
    REQUIRE(program);
    const auto depth = make_texture(pixel_format::d32f, f.width, f.height);
    const auto normal = make_texture(pixel_format::rgba16f, f.width, f.height);
    const auto ids = make_texture(pixel_format::rg32ui, f.width, f.height);
    const auto wide = make_texture(pixel_format::rgba32f, f.width + 1, f.height);
    const auto surface = make_texture(pixel_format::rgba32f, f.width, f.height);
    const auto visibility = make_texture(pixel_format::r32f, f.width, f.height);
    const ao::shade_images<unsigned> good{ depth.name, 0, normal.name, ids.name, surface.name, 0, visibility.name, surface.name };
    REQUIRE(gl.bind_shading(*program, *plan, good));
    const auto reason = [&](ao::shade_images<unsigned> images) {
        const auto bound = gl.bind_shading(*program, *plan, images);
        REQUIRE_FALSE(bound);
        return std::string(bound.error().reason());
    };
    using Catch::Matchers::Contains;
    ao::shade_images<unsigned> bad = good;
    bad.ids = normal.name;
    CHECK_THAT(reason(bad), Contains("ids texture"));
    bad = good;
    bad.surface = 0;
    CHECK_THAT(reason(bad), Contains("surface texture 0 is not a texture"));
    bad = good;
    bad.color = wide.name;
    CHECK_THAT(reason(bad), Contains("color texture") && Contains("62x37"));
    ao::shade_plan other = *plan;
    other.facts.width += 1;
    CHECK(gl.bind_shading(*program, other, good).error().code() == ao::errc::plan_mismatch);
    other.facts.width = 1 << 20;
    CHECK(gl.prepare_shading(other, *heap).error().code() == ao::errc::invalid_size);
}
