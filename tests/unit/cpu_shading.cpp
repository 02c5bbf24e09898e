// The CPU's shading passes.
#include "ao/cpu/shading.hpp"
#include "unit/cpu_allocations.hpp"
#include "unit/cpu_threads.hpp"
#include "unit/deep_blends.hpp"

#include <string>

using namespace shade_test;
using ao::cpu::view_of;

namespace {

ao::shade_images<ao::cpu::image_view> images_of(const ao::shade_plan& plan, const ao::conformance::shade_inputs& in,
                                                ao::picture& color)
{
    // What the plan does not read is not handed over.
    ao::shade_images<ao::cpu::image_view> images{};
    (plan.facts.stored_position ? images.position : images.depth) = view_of(in.geometry);
    images.normal = view_of(in.normal);
    images.ids = view_of(in.ids);
    if (plan.options.maps || plan.options.frames) {
        images.surface = view_of(in.surface);
    }
    if (plan.options.frames) {
        images.frame = view_of(in.frame);
    }
    if (plan.options.visibility) {
        images.visibility = view_of(in.visibility);
    }
    color = ao::picture(pixel_format::rgba32f, plan.facts.width, plan.facts.height);
    images.color = view_of(color);
    return images;
}

outcome run(ao::cpu::shading& on, const ao::shade_plan& plan, const ao::texel_heap& heap, const ao::conformance::shade_inputs& in)
{
    auto program = on.prepare_shading(plan, heap);
    REQUIRE(program);
    outcome made;
    auto bound = on.bind_shading(*program, plan, images_of(plan, in, made.color));
    REQUIRE(bound);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        on.record_shading({}, *program, *bound, plan, i);
    }
    const auto clamped = on.clamped_weights(*program);
    REQUIRE(clamped);
    made.clamped = *clamped;
    return made;
}

// Runs a check of shade_cases.hpp with every division of work.
template <class Check>
void with_every_division(Check check)
{
    for (const ao::cpu::options& o : cpu_test::divisions()) {
        auto on = ao::cpu::shading::create(o);
        REQUIRE(on);
        INFO(o.threads << " threads, tiles of " << o.tile_width << "x" << o.tile_height);
        check([&](const auto& plan, const auto& heap, const auto& in) { return run(*on, plan, heap, in); });
    }
}

} // namespace

TEST_CASE("the CPU shades as the reference does, in every bit, with any threads and tiles")
{
    with_every_division([](const run_function& f) { check_shading(f); });
}

TEST_CASE("the CPU blends as the reference does, in every bit, fused, cut and as in the paper")
{
    with_every_division([](const run_function& f) { check_blending(f); });
}

TEST_CASE("the CPU takes ambient light along bent normals and with bounces as the reference does, in every bit")
{
    with_every_division([](const run_function& f) { check_openings(f); });
}

TEST_CASE("the CPU clamps and counts weights outside [0, 1]")
{
    with_every_division([](const run_function& f) { check_clamping(f); });
}

TEST_CASE("the CPU shades from every format of depths, positions and normals, with rows apart and at odd addresses")
{
    auto on = ao::cpu::shading::create();
    REQUIRE(on);
    random_scene scene(9, true, true, 5);
    const auto view = camera(false);
    struct kind {
        bool stored_position;
        pixel_format geometry;
        ao::normal_source normals;
        pixel_format normal;
        pixel_format visibility;
    };
    for (const kind& k : {
             kind{ false, pixel_format::d32f, ao::normal_source::vector, pixel_format::rgba32f, pixel_format::r8 },
             kind{ false, pixel_format::d24, ao::normal_source::vector, pixel_format::rgba16f, pixel_format::r32f },
             kind{ true, pixel_format::rgba32f, ao::normal_source::unorm10, pixel_format::rgb10a2, pixel_format::r8 },
             kind{ true, pixel_format::rgba16f, ao::normal_source::octahedral, pixel_format::rg16, pixel_format::r32f },
         }) {
        ao::shade_facts f = facts();
        f.stored_position = k.stored_position;
        (k.stored_position ? f.position_format : f.depth_format) = k.geometry;
        f.normals = k.normals;
        f.normal_format = k.normal;
        f.visibility_format = k.visibility;
        const auto plan = ao::make_shade_plan(scene.get(), f, view);
        REQUIRE(plan);
        const auto heap = ao::make_texel_heap(scene.get().textures);
        REQUIRE(heap);
        const auto inputs = random_inputs(scene, f, view.projection);
        auto program = on->prepare_shading(*plan, *heap);
        REQUIRE(program);
        ao::picture color;
        auto images = images_of(*plan, inputs, color);
        std::vector<std::vector<std::byte>> kept;
        for (ao::cpu::image_view* v : { &images.depth, &images.position, &images.normal, &images.ids, &images.surface,
                                        &images.frame, &images.visibility }) {
            if (v->data == nullptr) {
                continue;
            }
            const std::size_t apart = v->row_bytes + 8;
            kept.emplace_back(3 + apart * static_cast<std::size_t>(v->height));
            for (std::size_t y = 0; y < static_cast<std::size_t>(v->height); ++y) {
                std::copy_n(static_cast<const std::byte*>(v->data) + y * v->row_bytes, v->row_bytes,
                            kept.back().data() + 3 + y * apart);
            }
            v->data = kept.back().data() + 3;
            v->row_bytes = apart;
        }
        auto bound = on->bind_shading(*program, *plan, images);
        REQUIRE(bound);
        on->record_shading({}, *program, *bound, *plan, 0);
        INFO("normals " << static_cast<int>(k.normals) << ", geometry " << static_cast<int>(k.geometry));
        CHECK(differing(color, ao::conformance::reference_color(*plan, *heap, inputs)) == 0);
    }
}

TEST_CASE("the CPU's table changes without another program, which keeps its own heap")
{
    auto on = ao::cpu::shading::create();
    REQUIRE(on);
    random_scene scene(78, true, true, 6);
    const ao::shade_facts f = facts();
    const auto view = camera(false);
    ao::blend_settings settings;
    settings.fixed_k = false;
    auto plan = ao::make_shade_plan(scene.get(), f, view, settings);
    REQUIRE(plan);
    auto heap = ao::make_texel_heap(scene.get().textures);
    REQUIRE(heap);
    const auto inputs = random_inputs(scene, f, view.projection);
    auto program = on->prepare_shading(*plan, *heap);
    REQUIRE(program);
    const ao::texel_heap kept = *heap;
    std::fill(heap->words.begin(), heap->words.end(), 0U);
    for (int node = 3; node < 6; ++node) {
        ao::set_weight(*plan, node, 0.25F);
    }
    ao::scene darker = scene.get();
    darker.ambient = ao::ambient_light(glm::vec3(0.01F));
    ao::set_lights(*plan, darker);
    REQUIRE_FALSE(on->update_table(*program, *plan));
    ao::picture color;
    auto bound = on->bind_shading(*program, *plan, images_of(*plan, inputs, color));
    REQUIRE(bound);
    on->record_shading({}, *program, *bound, *plan, 0);
    CHECK(differing(color, ao::conformance::reference_color(*plan, kept, inputs)) == 0);

    ao::shade_plan other = *plan;
    other.words.push_back(0);
    REQUIRE(on->update_table(*program, other));
    CHECK(on->update_table(*program, other)->code() == ao::errc::plan_mismatch);
}

TEST_CASE("the CPU's shading refuses pictures, plans and options that do not fit, and says which")
{
    CHECK(ao::cpu::shading::create({ .threads = -1 }).error().code() == ao::errc::invalid_settings);
    auto on = ao::cpu::shading::create();
    REQUIRE(on);
    random_scene scene(5, true, false, 0);
    const ao::shade_facts f = facts();
    auto plan = ao::make_shade_plan(scene.get(), f, camera(false));
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap(scene.get().textures);
    auto program = on->prepare_shading(*plan, *heap);
    REQUIRE(program);
    const auto inputs = random_inputs(scene, f, camera(false).projection);
    ao::picture color;
    const auto good = images_of(*plan, inputs, color);
    REQUIRE(on->bind_shading(*program, *plan, good));
    const auto refused = [&](const ao::shade_images<ao::cpu::image_view>& images, ao::errc code) {
        const auto bound = on->bind_shading(*program, *plan, images);
        REQUIRE_FALSE(bound);
        CHECK(bound.error().code() == code);
        return std::string(bound.error().reason());
    };
    using Catch::Matchers::StartsWith;
    auto bad = good;
    bad.ids = good.normal;
    CHECK_THAT(refused(bad, ao::errc::unsupported_format), StartsWith("ids"));
    bad = good;
    bad.surface.data = nullptr;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("surface"));
    bad = good;
    bad.color.width += 1;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("color"));
    bad = good;
    bad.visibility.row_bytes -= 4;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("visibility"));
    ao::shade_plan other = *plan;
    other.facts.width += 1;
    CHECK(on->bind_shading(*program, other, good).error().code() == ao::errc::plan_mismatch);
    other.targets = 1 << 30;
    other.facts.width = other.facts.height = 65536;
    CHECK(on->prepare_shading(other, *heap).error().code() == ao::errc::out_of_memory);
}

#if defined(AO_COUNTS_ALLOCATIONS)
TEST_CASE("the CPU allocates nothing to shade")
{
    auto on = ao::cpu::shading::create({ .threads = 1 });
    REQUIRE(on);
    random_scene scene(3, true, true, 14);
    const ao::shade_facts f = facts();
    ao::blend_settings settings;
    settings.registers = 1;
    const auto plan = ao::make_shade_plan(scene.get(), f, camera(false), settings);
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap(scene.get().textures);
    auto program = on->prepare_shading(*plan, *heap);
    REQUIRE(program);
    const auto inputs = random_inputs(scene, f, camera(false).projection);
    ao::picture color;
    auto bound = on->bind_shading(*program, *plan, images_of(*plan, inputs, color));
    REQUIRE(bound);
    const int before = cpu_test::allocations();
    for (std::size_t i = 0; i < plan->passes.size(); ++i) {
        on->record_shading({}, *program, *bound, *plan, i);
    }
    const int after = cpu_test::allocations();
    CHECK(after == before);
}
#endif

TEST_CASE("the CPU blends deep and wide trees as double does, shared ones once, with the ends' bits and in linear light")
{
    auto cpu = ao::cpu::shading::create({ .threads = 2 });
    REQUIRE(cpu);
    const run_function on = [&](const auto& plan, const auto& heap, const auto& in) { return run(*cpu, plan, heap, in); };
    check_deep_blends(on);
    check_shared_blends(on);
    check_blend_ends(on);
    check_linear_light(on);
}
