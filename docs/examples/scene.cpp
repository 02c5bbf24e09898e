#include <ao/cpu/rasterizer.hpp>
#include <ao/cpu/shading.hpp>

// Draws a scene, finds where it is open and shades it. `color`: RGBA32F, linear.
std::optional<ao::error> draw_scene(const ao::scene& scene, const ao::gbuffer_camera& view, ao::picture& color)
{
    if (auto wrong = ao::validate(scene)) return wrong;
    const auto make = [&](ao::pixel_format format) { return ao::picture(format, color.width, color.height); };
    auto depth = make(ao::pixel_format::d32f), normal = make(ao::pixel_format::rgba16f), ids = make(ao::pixel_format::rg32ui);
    auto surface = make(ao::pixel_format::rgba32f), frame = surface, visibility = make(ao::pixel_format::r32f);
    const auto see = [](ao::picture& p) { return ao::cpu::view_of(p); };

    auto raster = ao::cpu::rasterizer::create();
    auto plan = ao::plan_drawing(scene, { .width = color.width, .height = color.height, .ids = true, .surface = true,
                                          .frame = ao::needs_frame(scene) });
    if (!raster || !plan) return raster ? plan.error() : raster.error();
    auto model = raster->load(scene, *plan); // once; move() when objects move
    if (!model) return model.error();
    auto targets = raster->bind(*model, { .depth = see(depth), .normal = see(normal), .ids = see(ids), .surface = see(surface),
                                          .frame = see(frame) });
    if (!targets) return targets.error();
    raster->record({}, *model, *targets, view);

    auto cpu = ao::cpu::backend::create();
    if (!cpu) return cpu.error();
    auto effect = ao::effect<ao::cpu::backend>::create(
        *cpu, {}, { .width = color.width, .height = color.height, .depth = ao::depth_source::hardware,
                    .depth_format = ao::pixel_format::d32f }, { .projection = view.projection });
    if (!effect) return effect.error();
    auto bound = effect->bind({ see(depth), see(normal), see(visibility) });
    if (!bound) return bound.error();
    effect->record({}, *bound);

    auto shading = ao::cpu::shading::create();
    auto heap = ao::make_texel_heap(scene.textures);
    auto shade = ao::make_shade_plan(scene, { .width = color.width, .height = color.height }, { view.projection, view.view });
    if (!shading || !heap || !shade) return !shading ? shading.error() : !heap ? heap.error() : shade.error();
    auto program = shading->prepare_shading(*shade, *heap);
    if (!program) return program.error();
    auto images = shading->bind_shading(*program, *shade, { .depth = see(depth), .normal = see(normal), .ids = see(ids),
        .surface = see(surface), .frame = see(frame), .visibility = see(visibility), .color = see(color) });
    if (!images) return images.error();
    for (std::size_t i = 0; i < shade->passes.size(); ++i) shading->record_shading({}, *program, *images, *shade, i);
    return std::nullopt;
}
