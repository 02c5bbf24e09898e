// The CPU's geometry pass.
#include "unit/cpu_allocations.hpp"
#include "unit/cpu_raster_support.hpp"
#include "unit/raster_bad_input.hpp"

using namespace cpu_test;
using namespace raster_test;
using ao::cpu::view_of;

namespace {

draw_function with(ao::cpu::rasterizer& cpu)
{
    return [&](const auto& s, const auto& f, const auto& c) { return cpu_test::draw(cpu, s, f, c); };
}

} // namespace

TEST_CASE("the CPU draws what rays see: standard, reversed, infinite, parallel, either depth range and first row")
{
    auto cpu = cpu_test::rasterizer();
    check_targets(with(cpu));
}

TEST_CASE("the CPU's normal maps and alpha tests: mirrored UVs, mirrored and unevenly scaled models, either green")
{
    auto cpu = cpu_test::rasterizer();
    check_maps(with(cpu));
}

TEST_CASE("the CPU writes normals in every format")
{
    auto cpu = cpu_test::rasterizer();
    check_normal_formats(with(cpu));
}

TEST_CASE("the CPU draws a million objects, each with its own transform and id; an empty scene clears")
{
    auto cpu = cpu_test::rasterizer();
    check_many_objects(with(cpu), 1000000);
}

TEST_CASE("of surfaces at equal depth the CPU shows the first in the plan's order, in standard and reversed buffers")
{
    world w;
    w.meshes.push_back(square(false));
    w.materials.resize(2);
    w.materials[0].two_sided = false; // drawn after the two-sided ones: false sorts before true
    w.add(0, 0, placed({ 0, 0, -1 }, 0.3F, { 2, 2, 1 }));
    w.add(0, 1, placed({ 0, 0, -1 }, 0.3F, { 2, 2, 1 }));
    w.add(0, 1, placed({ 0, 0, -1 }, 0.3F, { 2, 2, 1 }));
    auto cpu = cpu_test::rasterizer();
    for (const bool reversed : { false, true }) {
        const auto d = cpu_test::draw(cpu, w.get(), all_targets(), camera({ .reversed = reversed }));
        int shown = 0;
        for (std::size_t i = 0; i < d.ids.pixels(); ++i) {
            const auto id = d.ids.texel<glm::uvec2>(i).x;
            REQUIRE((id == 0 || id == 2));
            shown += id == 2 ? 1 : 0;
        }
        CHECK(shown > 500);
    }
}

TEST_CASE("the CPU fills the target for blends where an object needs it, and leaves targets that are off alone")
{
    world w;
    w.meshes = { square(false), square(true) };
    w.materials.resize(3);
    w.add_texture(1, { 200, 90, 220, 255 }, ao::wrap_mode::repeat);
    w.materials[1].normal_map = 0;
    w.add(0, -1, placed({ -1.2F, 0.2F, 0 }, 0.4F, { 1, 1.2F, 1 }));
    w.add(1, -1, placed({ 1.2F, 0.2F, 0 }, 2.9F, { 1, 1.2F, -2 }));
    w.add(0, 2, placed({ 0, -1.2F, 0.2F }, 0.1F, { 0.5F, 0.5F, 1 }));
    const std::array<ao::blend_node, 1> blends{ { { 0, 1, 0.5F, ao::no_texture } } };
    ao::scene s = w.get();
    s.blends = blends;
    REQUIRE(ao::needs_frame(s));
    ao::gbuffer_facts f = all_targets();
    f.frame = true;
    auto cpu = cpu_test::rasterizer();
    const auto view = camera({});
    const drawn d = cpu_test::draw(cpu, s, f, view);
    const caster rays(w, view);
    using shared = ao::math<float>;
    std::array<int, 3> compared{};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const seen at = rays.look(x, y);
            if (at.doubtful) {
                continue;
            }
            const auto i = static_cast<std::size_t>(y * width + x);
            const auto stored = d.frame.texel<glm::vec4>(i);
            if (at.object < 0 || at.object == 2) {
                REQUIRE(stored == glm::vec4(0));
                compared[2] += at.object == 2 ? 1 : 0;
                continue;
            }
            const dvec2 pixel(x + 0.5, y + 0.5);
            const dvec3 n = rays.normal(at, pixel);
            const dvec4 local = rays.interpolate(at.object, at.triangle, rays.mesh_of(at.object).tangents, pixel);
            const dvec3 t = glm::normalize(glm::dmat3(rays.model_view(at.object)) * dvec3(local));
            REQUIRE(glm::length(dvec3(shared::ao_normal_of_frame(stored, { 0.5F, 0.5F, 1 }, 1)) - n) < 1e-4);
            // Along +u of tangent space.
            const dvec3 across = glm::normalize(t - n * glm::dot(n, t));
            REQUIRE(glm::length(dvec3(shared::ao_normal_of_frame(stored, { 1, 0.5F, 0.5F }, 1)) - across) < 1e-3);
            ++compared[static_cast<std::size_t>(at.object)];
        }
    }
    for (const int count : compared) {
        CHECK(count > 50);
    }
    f = all_targets();
    f.position = f.motion = f.surface = f.normal = false;
    const drawn few = cpu_test::draw(cpu, s, f, view);
    CHECK(differing(few.depth, d.depth) == 0);
    CHECK(differing(few.ids, d.ids) == 0);
}

TEST_CASE("positions in half precision and depth in 24 bits are what the wide formats round to")
{
    world w = plain_world();
    auto cpu = cpu_test::rasterizer();
    ao::gbuffer_facts f = all_targets();
    for (const bool reversed : { false, true }) {
        const auto view = camera({ .reversed = reversed });
        f.position_format = pixel_format::rgba32f;
        f.depth_format = pixel_format::d32f;
        const drawn wide = cpu_test::draw(cpu, w.get(), f, view);
        f.position_format = pixel_format::rgba16f;
        f.depth_format = pixel_format::d24;
        const drawn narrow = cpu_test::draw(cpu, w.get(), f, view);
        REQUIRE(differing(wide.ids, narrow.ids) == 0);
        for (std::size_t i = 0; i < wide.ids.pixels(); ++i) {
            const auto p = wide.position.texel<glm::vec4>(i);
            const std::array<std::uint16_t, 4> half{ ao::float_to_half(p.x), ao::float_to_half(p.y), ao::float_to_half(p.z),
                                                     ao::float_to_half(p.w) };
            REQUIRE((narrow.position.texel<std::array<std::uint16_t, 4>>(i) == half));
            // The 24 bits are rounded from what the float was rounded from.
            const double code = static_cast<double>(wide.depth.texel<float>(i)) * 16777215;
            REQUIRE(std::abs(static_cast<double>(narrow.depth.texel<std::uint32_t>(i)) - code) < 1.01);
        }
    }
}

TEST_CASE("objects of the CPU's models move, and what no longer fits the plan is refused")
{
    CHECK(ao::cpu::rasterizer::create({ .tile_width = -1 }).error().code() == ao::errc::invalid_settings);
    world w = plain_world();
    auto cpu = cpu_test::rasterizer();
    const ao::gbuffer_facts f = all_targets();
    const auto view = camera({});
    const auto plan = ao::plan_drawing(w.get(), f);
    REQUIRE(plan);
    auto model = cpu.load(w.get(), *plan);
    REQUIRE(model);
    drawn d;
    const auto images = make_pictures(f, d);
    auto targets = cpu.bind(*model, images);
    REQUIRE(targets);
    cpu.record({}, *model, *targets, view);
    w.objects[1].previous_model = w.objects[1].model;
    w.objects[1].model = ao::matrix4(placed({ -1.0F, 0.9F, 0.2F }, 0.6F, { 1.1F, 1, 1 }));
    REQUIRE_FALSE(cpu.move(*model, w.get()));
    cpu.record({}, *model, *targets, view);
    compare(w, view, d, 1e-6);

    using Catch::Matchers::Contains;
    using Catch::Matchers::StartsWith;
    const auto moved_wrong = [&](const ao::scene& s) { return std::string(cpu.move(*model, s)->reason()); };
    world mirrored = w;
    mirrored.objects[0].model[0][0] *= -1;
    mirrored.objects[0].model[0][1] *= -1;
    mirrored.objects[0].model[0][2] *= -1;
    CHECK_THAT(moved_wrong(mirrored.get()), Contains("object 0 mirrors now"));
    world fewer = w;
    fewer.objects.pop_back();
    CHECK_THAT(moved_wrong(fewer.get()), Contains("another number of objects"));
    const auto refused = [&](const auto& bad, ao::errc code) {
        const auto bound = cpu.bind(*model, bad);
        REQUIRE_FALSE(bound);
        CHECK(bound.error().code() == code);
        return std::string(bound.error().reason());
    };
    auto bad = images;
    bad.ids = images.normal;
    CHECK_THAT(refused(bad, ao::errc::unsupported_format), StartsWith("ids"));
    bad = images;
    bad.depth.data = nullptr;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("depth"));
    bad = images;
    bad.surface.height -= 1;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("surface"));
}

#if defined(AO_COUNTS_ALLOCATIONS)
TEST_CASE("the CPU allocates nothing to draw a view again")
{
    world w = plain_world();
    const ao::gbuffer_facts f = all_targets();
    const auto plan = ao::plan_drawing(w.get(), f);
    REQUIRE(plan);
    auto cpu = cpu_test::rasterizer({ .threads = 1 });
    auto model = cpu.load(w.get(), *plan);
    REQUIRE(model);
    drawn d;
    auto targets = cpu.bind(*model, make_pictures(f, d));
    REQUIRE(targets);
    const auto view = camera({});
    cpu.record({}, *model, *targets, view);
    const ao::scene s = w.get();
    const int before = allocations();
    const auto moved = cpu.move(*model, s);
    cpu.record({}, *model, *targets, view);
    const int after = allocations();
    CHECK_FALSE(moved);
    CHECK(after == before);
}
#endif

TEST_CASE("the CPU leaves no mark of triangles without area or with vertices that are not finite, and no NaN of attributes")
{
    auto cpu = cpu_test::rasterizer();
    check_bad_triangles(with(cpu));
    check_bad_attributes(with(cpu));
}
