// What every rasterizer must make of meshes that are not as they should be: the picture of the triangles that are.
#pragma once

#include "unit/raster_cases.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <limits>

namespace raster_test {

// A square as it is, and again among triangles without area and with vertices that are not finite.
inline mesh_data littered_square(bool litter)
{
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const float nan = std::nanf("");
    mesh_data m = square(false);
    m.positions.insert(m.positions.end(), { { nan, 0, 0 }, { 0, -infinite, 0 }, { 0, -1, 0 }, { nan, infinite, nan } });
    m.normals.resize(m.positions.size(), glm::vec3(0, 0, 1));
    m.tangents.resize(m.positions.size(), glm::vec4(1, 0, 0, 1));
    m.uvs.resize(m.positions.size(), glm::vec2(0));
    if (litter) {
        m.indices = { 0, 0, 1, 0, 1, 2, 4, 1, 2, 0, 6, 1, 2, 2, 2, 5, 2, 3, 4, 5, 7, 0, 2, 3, 3, 0, 3, 7, 7, 7 };
    }
    return m;
}

inline void require_same_picture(const drawn& a, const drawn& b)
{
    CHECK(differing(a.depth, b.depth) == 0);
    CHECK(differing(a.position, b.position) == 0);
    CHECK(differing(a.normal, b.normal) == 0);
    CHECK(differing(a.motion, b.motion) == 0);
    CHECK(differing(a.ids, b.ids) == 0);
    CHECK(differing(a.surface, b.surface) == 0);
}

inline void check_bad_triangles(const draw_function& draw)
{
    const auto view = camera({});
    for (const bool flat : { false, true }) {
        const auto picture_of = [&](bool litter) {
            world w;
            w.meshes.push_back(littered_square(litter));
            if (flat) {
                w.meshes[0].normals.clear();
                w.meshes[0].tangents.clear();
                w.meshes[0].uvs.clear();
            }
            w.add(0, 0, placed({ 0, 0, -1 }, 0.4F, { 2, 1.5F, 1 }));
            w.add(0, 0, placed({ 0.5F, 0.3F, 0 }, -0.3F, { 1, 1, 1 }));
            return draw(w.get(), all_targets(), view);
        };
        INFO("flat normals " << flat);
        const drawn clean = picture_of(false);
        std::size_t shown = 0;
        for (std::size_t i = 0; i < clean.ids.pixels(); ++i) {
            shown += clean.ids.texel<glm::uvec2>(i).x != 0 ? 1 : 0;
        }
        CHECK(shown > 1000);
        require_same_picture(picture_of(true), clean);
    }
}

// Attributes that are not finite, or no direction, or not there: geometry and ids stay, normals are directions.
inline void check_bad_attributes(const draw_function& draw)
{
    const auto view = camera({});
    const float nan = std::nanf("");
    const auto picture_of = [&](bool bad) {
        world w;
        w.meshes = { square(false), square(false) };
        w.materials.resize(2);
        w.add_texture(1, { 200, 90, 220, 255 }, ao::wrap_mode::repeat);
        w.materials[1].normal_map = w.materials[1].alpha_map = 0;
        if (bad) {
            w.meshes[0].normals = { { nan, 0, 1 }, { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } };
            w.meshes[0].uvs.clear();
            w.meshes[0].tangents.clear();
            w.meshes[1].normals[2] = { 0, std::numeric_limits<float>::infinity(), 0 };
            w.meshes[1].tangents = { { 0, 0, 0, 0 }, { nan, 0, 0, 1 }, { 0, 0, 0, nan }, { 0, 0, 1, -1 } };
            w.meshes[1].uvs[0] = { nan, -std::numeric_limits<float>::infinity() };
        }
        w.add(0, 0, placed({ -1, 0, -1 }, 0.4F, { 1, 1.5F, 1 }));
        w.add(1, 1, placed({ 1, 0, -1 }, -0.3F, { 1, 1.5F, 1 }));
        return draw(w.get(), all_targets(), view);
    };
    const drawn clean = picture_of(false);
    const drawn d = picture_of(true);
    CHECK(differing(d.depth, clean.depth) == 0);
    CHECK(differing(d.position, clean.position) == 0);
    CHECK(differing(d.ids, clean.ids) == 0);
    std::size_t wrong = 0;
    std::size_t shown = 0;
    for (std::size_t i = 0; i < d.ids.pixels(); ++i) {
        const auto n = d.normal.texel<glm::vec4>(i);
        const bool surface = d.ids.texel<glm::uvec2>(i).x != 0;
        shown += surface ? 1 : 0;
        wrong += std::abs(n.x * n.x + n.y * n.y + n.z * n.z - (surface ? 1.0F : 0.0F)) < 1e-5F ? 0 : 1;
    }
    CHECK(shown > 1000);
    CHECK(wrong == 0);
}

} // namespace raster_test
