// Drawing with the CPU's rasterizer into pictures of a test.
#pragma once

#include "ao/cpu/rasterizer.hpp"
#include "unit/cpu_threads.hpp"
#include "unit/raster_cases.hpp"

#include <string>
#include <utility>

namespace cpu_test {

using raster_test::drawn;

inline ao::cpu::rasterizer rasterizer(const ao::cpu::options& o = {})
{
    auto made = ao::cpu::rasterizer::create(o);
    REQUIRE(made);
    return std::move(*made);
}

// Pictures for the targets that are on, full of what nothing draws, and their views.
inline ao::gbuffer_images<ao::cpu::image_view> make_pictures(const ao::gbuffer_facts& f, drawn& d)
{
    ao::gbuffer_images<ao::cpu::image_view> images{};
    const auto target = [&](bool wanted, ao::pixel_format format, ao::picture& p) {
        if (!wanted) {
            return ao::cpu::image_view{};
        }
        p = ao::picture(format, f.width, f.height);
        std::fill(p.bytes.begin(), p.bytes.end(), std::byte{ 0xa5 });
        return ao::cpu::view_of(p);
    };
    images.depth = target(true, f.depth_format, d.depth);
    images.position = target(f.position, f.position_format, d.position);
    images.normal = target(f.normal, f.normal_format, d.normal);
    images.motion = target(f.motion, f.motion_format, d.motion);
    images.ids = target(f.ids, ao::pixel_format::rg32ui, d.ids);
    images.surface = target(f.surface, ao::pixel_format::rgba32f, d.surface);
    images.frame = target(f.frame, ao::pixel_format::rgba32f, d.frame);
    return images;
}

inline drawn draw(ao::cpu::rasterizer& cpu, const ao::scene& s, const ao::gbuffer_facts& f, const ao::gbuffer_camera& camera)
{
    const auto plan = ao::plan_drawing(s, f);
    if (!plan) {
        FAIL(std::string(plan.error().reason()));
    }
    auto model = cpu.load(s, *plan);
    REQUIRE(model);
    drawn d;
    auto targets = cpu.bind(*model, make_pictures(f, d));
    if (!targets) {
        FAIL(std::string(targets.error().reason()));
    }
    cpu.record({}, *model, *targets, camera);
    // There are no programs; recording is one call.
    d.draw_calls = plan->draws.empty() ? 0 : 1;
    d.variants = plan->variants.size();
    return d;
}

// Pixels of all targets that differ.
inline std::size_t differing(const drawn& a, const drawn& b)
{
    std::size_t count = 0;
    for (const auto picture :
         { &drawn::depth, &drawn::position, &drawn::normal, &drawn::motion, &drawn::ids, &drawn::surface, &drawn::frame }) {
        count += picture_test::differing(a.*picture, b.*picture);
    }
    return count;
}

} // namespace cpu_test
