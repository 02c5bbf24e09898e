// A whole frame on Vulkan: geometry pass, occlusion and shading, one after the other in one command buffer.
#include "ao/conformance/shade_reference.hpp"
#include "ao/vk/rasterizer.hpp"
#include "ao/vk/shading.hpp"
#include "unit/raster_cases.hpp"
#include "unit/vk_pictures.hpp"

#include <array>
#include <vector>

using namespace vk_test;
using raster_test::plain_world;
using raster_test::world;

namespace {

using ao::pixel_format;

ao::host::vulkan_image general(pixel_format format)
{
    return make_image(format, raster_test::width, raster_test::height, VK_IMAGE_LAYOUT_GENERAL);
}

} // namespace

TEST_CASE("rasterizer, occlusion and shading on pictures in layout GENERAL need no barrier of the host's in between")
{
    world w = plain_world();
    w.add_texture(2, { 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 90, 90, 90, 255 }, ao::wrap_mode::repeat);
    w.materials[1].diffuse_map = 0;
    std::array<ao::light, 1> lights;
    lights[0].vector = { 0.3F, 0.4F, 0.8F };
    ao::scene s = w.get();
    s.lights = lights;
    s.ambient = ao::ambient_light(glm::vec3(0.4F));

    ao::gbuffer_facts drawing;
    drawing.width = raster_test::width;
    drawing.height = raster_test::height;
    drawing.ids = drawing.surface = true;
    const auto draws = ao::plan_drawing(s, drawing);
    REQUIRE(draws);
    const ao::gbuffer_camera view = raster_test::camera({});

    ao::facts occluding;
    occluding.width = drawing.width;
    occluding.height = drawing.height;
    occluding.depth = ao::depth_source::hardware;
    occluding.depth_format = pixel_format::d32f;
    ao::camera eye;
    eye.projection = view.projection;
    ao::shade_facts shading;
    shading.width = drawing.width;
    shading.height = drawing.height;
    auto plan = ao::make_shade_plan(s, shading, { view.projection, view.view });
    REQUIRE(plan);
    CHECK(plan->options.maps);
    const auto heap = ao::make_texel_heap(s.textures);
    REQUIRE(heap);

    ao::vk::context c = vk_runner::context_of(device());
    c.enabled.dynamic_rendering = device().dynamic_rendering;
    auto rasterizer = ao::vk::rasterizer::create(c);
    auto backend = ao::vk::backend::create(c);
    auto shader = ao::vk::shading::create(c);
    REQUIRE(rasterizer);
    REQUIRE(backend);
    REQUIRE(shader);
    auto model = rasterizer->load(s, *draws);
    auto effect = ao::effect<ao::vk::backend>::create(*backend, {}, occluding, eye);
    auto program = shader->prepare_shading(*plan, *heap);
    REQUIRE(model);
    REQUIRE(effect);
    REQUIRE(program);

    auto depth = general(pixel_format::d32f);
    auto normal = general(pixel_format::rgba16f);
    auto ids = general(pixel_format::rg32ui);
    auto surface = general(pixel_format::rgba32f);
    auto visibility = general(pixel_format::r32f);
    auto color = general(pixel_format::rgba32f);
    ao::gbuffer_images<ao::vk::image> drawn{};
    drawn.depth = handle(depth);
    drawn.normal = handle(normal);
    drawn.ids = handle(ids);
    drawn.surface = handle(surface);
    ao::shade_images<ao::vk::image> shaded{};
    shaded.depth = handle(depth);
    shaded.normal = handle(normal);
    shaded.ids = handle(ids);
    shaded.surface = handle(surface);
    shaded.visibility = handle(visibility);
    shaded.color = handle(color);
    auto targets = rasterizer->bind(*model, drawn);
    auto occluded = effect->bind({ handle(depth), handle(normal), handle(visibility) });
    auto lit = shader->bind_shading(*program, *plan, shaded);
    REQUIRE(targets);
    REQUIRE(occluded);
    REQUIRE(lit);

    REQUIRE(device().submit([&](VkCommandBuffer commands) {
        for (int frame = 0; frame < 2; ++frame) {
            rasterizer->record(commands, *model, *targets, view);
            effect->record(commands, *occluded);
            for (std::size_t i = 0; i < plan->passes.size(); ++i) {
                shader->record_shading(commands, *program, *lit, *plan, i);
            }
            // The next frame writes them all again.
            VkMemoryBarrier barrier{};
            barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
            barrier.srcAccessMask =
                VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
            barrier.dstAccessMask = barrier.srcAccessMask;
            const VkPipelineStageFlags stages =
                VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
            vkCmdPipelineBarrier(commands, stages, stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
        }
    }));

    ao::conformance::shade_inputs inputs;
    inputs.geometry = download(depth);
    inputs.normal = download(normal);
    inputs.ids = download(ids);
    inputs.surface = download(surface);
    inputs.visibility = download(visibility);
    const ao::picture seen = download(color);
    CHECK(differing(seen, ao::conformance::reference_color(*plan, *heap, inputs)) == 0);
    std::size_t lit_pixels = 0;
    std::size_t occluded_pixels = 0;
    for (std::size_t i = 0; i < seen.pixels(); ++i) {
        lit_pixels += seen.texel<glm::vec4>(i).w == 1 ? 1 : 0;
        const float open = inputs.visibility.texel<float>(i);
        occluded_pixels += open >= 0 && open < 0.9F ? 1 : 0;
    }
    CHECK(lit_pixels > 1000);
    CHECK(lit_pixels < seen.pixels());
    CHECK(occluded_pixels > 50);
    check_silence();
}
