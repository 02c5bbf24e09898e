// Vulkan's shading passes against scalar C++, bit for bit: random geometry passes, tables of materials and trees of blends.
#include "ao/vk/shading.hpp"
#include "unit/deep_blends.hpp"
#include "unit/vk_pictures.hpp"

#include <string>
#include <vector>

using namespace vk_test;
using namespace shade_test;

namespace {

ao::vk::shading executor(ao::vk::group_size group = {})
{
    auto made = ao::vk::shading::create(vk_runner::context_of(device(), group));
    REQUIRE(made);
    return std::move(*made);
}

// The pictures of a plan on the device; what it does not read is not handed over.
struct pictures {
    pictures(const ao::shade_plan& plan, const ao::conformance::shade_inputs& in)
        : geometry(upload(in.geometry)),
          normal(upload(in.normal)),
          ids(upload(in.ids)),
          surface(upload(in.surface)),
          frame(upload(in.frame)),
          visibility(upload(in.visibility)),
          color(make_image(pixel_format::rgba32f, plan.facts.width, plan.facts.height, VK_IMAGE_LAYOUT_GENERAL))
    {
        (plan.facts.stored_position ? images.position : images.depth) = handle(geometry);
        images.normal = handle(normal);
        images.ids = handle(ids);
        images.surface = plan.options.maps || plan.options.frames ? handle(surface) : ao::vk::image{};
        images.frame = plan.options.frames ? handle(frame) : ao::vk::image{};
        images.visibility = plan.options.visibility ? handle(visibility) : ao::vk::image{};
        images.color = handle(color);
    }
    ao::host::vulkan_image geometry, normal, ids, surface, frame, visibility, color;
    ao::shade_images<ao::vk::image> images{};
};

void record(ao::vk::shading& on, VkCommandBuffer commands, ao::vk::shade_program& program, ao::vk::shade_binding& bound,
            const ao::shade_plan& plan)
{
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        on.record_shading(commands, program, bound, plan, i);
    }
}

outcome run(ao::vk::shading& on, const ao::shade_plan& plan, const ao::texel_heap& heap, const ao::conformance::shade_inputs& in)
{
    auto program = on.prepare_shading(plan, heap);
    if (!program) {
        FAIL(std::string(program.error().reason()));
    }
    pictures own(plan, in);
    auto bound = on.bind_shading(*program, plan, own.images);
    REQUIRE(bound);
    REQUIRE(device().submit([&](VkCommandBuffer commands) { record(on, commands, *program, *bound, plan); }));
    const auto clamped = on.clamped_weights(*program);
    REQUIRE(clamped);
    return { download(own.color), *clamped };
}

} // namespace

TEST_CASE("Vulkan shades as scalar C++ does, in every bit, with what the materials need only")
{
    for (const ao::vk::group_size group : { ao::vk::group_size{}, ao::vk::group_size{ 7, 4 } }) {
        auto vk = executor(group);
        check_shading([&](const auto& plan, const auto& heap, const auto& in) { return run(vk, plan, heap, in); }, 0,
                      group.x == 0 ? 5 : 0);
    }
    check_silence();
}

TEST_CASE("Vulkan shades over a depth buffer of 24 bits")
{
    auto vk = executor();
    random_scene scene(91, true, true, 4);
    ao::shade_facts f = facts();
    f.depth_format = pixel_format::d24;
    const auto view = camera(false);
    const auto plan = ao::make_shade_plan(scene.get(), f, view);
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap(scene.get().textures);
    REQUIRE(heap);
    require_reference([&](const auto& p, const auto& h, const auto& in) { return run(vk, p, h, in); }, *plan, *heap,
                      random_inputs(scene, f, view.projection));
    check_silence();
}

TEST_CASE("Vulkan blends as scalar C++ does, in every bit, fused, cut and as in the paper; weights are clamped and counted")
{
    auto vk = executor();
    const auto on_device = [&](const auto& plan, const auto& heap, const auto& in) { return run(vk, plan, heap, in); };
    check_blending(on_device);
    check_openings(on_device);
    check_clamping(on_device);
    check_silence();
}

TEST_CASE("the table changes between frames that are recorded before any has run, of a program that was moved")
{
    auto first_owner = executor();
    random_scene scene(78, false, false, 6);
    const ao::shade_facts f = facts();
    const auto view = camera(false);
    ao::blend_settings settings;
    settings.fixed_k = false;
    settings.registers = 1;
    const auto planned = ao::make_shade_plan(scene.get(), f, view, settings);
    REQUIRE(planned);
    const auto heap = ao::make_texel_heap({});
    const auto inputs = random_inputs(scene, f, view.projection);
    auto prepared = first_owner.prepare_shading(*planned, *heap);
    REQUIRE(prepared);
    ao::vk::shading vk = std::move(first_owner);
    ao::vk::shade_program program = std::move(*prepared);

    std::vector<ao::shade_plan> plans{ *planned, *planned, *planned };
    ao::set_weight(plans[1], 4, 2.0F);
    ao::scene darker = scene.get();
    darker.ambient = ao::ambient_light(glm::vec3(0.01F));
    ao::set_lights(plans[2], darker);
    std::vector<pictures> own;
    std::vector<ao::vk::shade_binding> bindings;
    for (const ao::shade_plan& plan : plans) {
        own.emplace_back(plan, inputs);
        auto bound = vk.bind_shading(program, plan, own.back().images);
        REQUIRE(bound);
        bindings.push_back(std::move(*bound));
    }
    std::uint64_t expected_clamped = 0;
    REQUIRE(device().submit([&](VkCommandBuffer commands) {
        for (std::size_t i = 0; i < plans.size(); ++i) {
            if (vk.update_table(program, plans[i])) {
                FAIL("a table of the same size is refused");
            }
            record(vk, commands, program, bindings[i], plans[i]);
        }
    }));
    for (std::size_t i = 0; i < plans.size(); ++i) {
        INFO("frame " << i);
        CHECK(differing(download(own[i].color), ao::conformance::reference_color(plans[i], *heap, inputs)) == 0);
        ao::conformance::shade_executor<float> reference(plans[i], *heap, inputs);
        reference.run();
        expected_clamped += reference.clamped();
    }
    CHECK(differing(download(own[0].color), download(own[1].color)) > 0);
    CHECK(differing(download(own[0].color), download(own[2].color)) > 0);
    CHECK(*vk.clamped_weights(program) == expected_clamped);
    CHECK(expected_clamped > 0);

    ao::shade_plan other = plans[0];
    other.words.push_back(0);
    REQUIRE(vk.update_table(program, other));
    CHECK(vk.update_table(program, other)->code() == ao::errc::plan_mismatch);
    check_silence();
}

TEST_CASE("Vulkan's shading refuses pictures and plans that do not fit, and says which")
{
    auto vk = executor();
    random_scene scene(5, true, false, 0);
    const ao::shade_facts f = facts();
    auto plan = ao::make_shade_plan(scene.get(), f, camera(false));
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap(scene.get().textures);
    auto program = vk.prepare_shading(*plan, *heap);
    REQUIRE(program);
    const pictures own(*plan, random_inputs(scene, f, camera(false).projection));
    REQUIRE(vk.bind_shading(*program, *plan, own.images));
    const auto reason = [&](const ao::shade_images<ao::vk::image>& images) {
        const auto bound = vk.bind_shading(*program, *plan, images);
        REQUIRE_FALSE(bound);
        CHECK(bound.error().code() == ao::errc::plan_mismatch);
        return std::string(bound.error().reason());
    };
    using Catch::Matchers::Contains;
    using images = ao::shade_images<ao::vk::image>;
    struct part {
        ao::vk::image images::*member;
        const char* name;
    };
    for (const part& each :
         { part{ &images::depth, "depth" }, part{ &images::normal, "normal" }, part{ &images::ids, "ids" },
           part{ &images::surface, "surface" }, part{ &images::visibility, "visibility" }, part{ &images::color, "color" } }) {
        images bad = own.images;
        bad.*each.member = {};
        CHECK_THAT(reason(bad), Contains(each.name));
    }
    images bad = own.images;
    bad.color.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    CHECK_THAT(reason(bad), Contains("color") && Contains("GENERAL"));
    ao::shade_plan other = *plan;
    other.facts.width += 1;
    CHECK(vk.bind_shading(*program, other, own.images).error().code() == ao::errc::plan_mismatch);
    other.facts.width = 1 << 20;
    CHECK(vk.prepare_shading(other, *heap).error().code() == ao::errc::invalid_size);
    other = *plan;
    other.targets = 1 << 20;
    CHECK(vk.prepare_shading(other, *heap).error().code() == ao::errc::out_of_memory);
    ao::vk::context incomplete = vk_runner::context_of(device());
    incomplete.device = VK_NULL_HANDLE;
    CHECK(ao::vk::shading::create(incomplete).error().code() == ao::errc::device);
}

TEST_CASE("Vulkan blends deep and wide trees as double does, shared ones once, with the ends' bits and in linear light")
{
    auto vk = executor();
    const auto on_device = [&](const auto& plan, const auto& heap, const auto& in) { return run(vk, plan, heap, in); };
    check_deep_blends(on_device);
    check_shared_blends(on_device);
    check_blend_ends(on_device);
    check_linear_light(on_device);
    check_silence();
}
