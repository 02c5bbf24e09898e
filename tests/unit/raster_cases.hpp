// What every rasterizer must draw, whatever the API: scenes of a few triangles against rays in double, with exact half-plane
// tests away from edges and attributes by exact barycentrics. `draw` draws a scene's targets.
#pragma once

#include "ao/drawing.hpp"
#include "ao/half.hpp"
#include "ao/picture.hpp"
#include "ao/texture.hpp"
#include "unit/picture_test.hpp"
#include "unit/raster_rays.hpp"

#include <catch2/catch.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace raster_test {

using picture_test::differing;

inline ao::gbuffer_facts all_targets()
{
    ao::gbuffer_facts f;
    f.width = width;
    f.height = height;
    f.position = f.motion = f.ids = f.surface = true;
    f.normal_format = pixel_format::rgba32f;
    return f;
}

struct drawn {
    ao::picture depth, position, normal, motion, ids, surface, frame;
    std::size_t programs = 0;
    std::size_t draw_calls = 0;
    std::size_t variants = 0;
};

using draw_function = std::function<drawn(const ao::scene&, const ao::gbuffer_facts&, const ao::gbuffer_camera&)>;

inline ao::gbuffer_camera camera(const ao::projection_options& options, double far = 60)
{
    ao::gbuffer_camera c;
    c.projection = options.parallel ? ao::make_projection({ -3.1, 2.9, -2.2, 2.1, 0.5, far }, options)
                                    : ao::make_projection({ -0.75, 0.8, -0.5, 0.55, 0.5, far }, options);
    const glm::mat4 turned = glm::rotate(glm::mat4(1), 0.2F, glm::vec3(0.3F, 0.9F, 0.1F));
    c.view = ao::matrix4(glm::translate(glm::mat4(1), glm::vec3(0.1F, -0.2F, -5)) * turned);
    c.previous_projection = c.projection;
    c.previous_view = ao::matrix4(glm::translate(glm::mat4(1), glm::vec3(0.3F, -0.1F, -5.2F)) * turned);
    return c;
}

inline glm::mat4 placed(glm::vec3 at, float angle, glm::vec3 scale)
{
    return glm::scale(glm::rotate(glm::translate(glm::mat4(1), at), angle, glm::normalize(glm::vec3(0.2F, 1, 0.3F))), scale);
}

// Flat, smooth, culled from either side, mirrored, scaled unevenly, deforming; all overlap somewhere.
inline world plain_world()
{
    world w;
    w.meshes.push_back(square(false));
    mesh_data triangle;
    triangle.positions = { { -1, -1, 0.2F }, { 1.5F, -0.8F, 0 }, { 0, 1.2F, -0.3F } };
    triangle.indices = { 0, 1, 2 };
    w.meshes.push_back(triangle);
    mesh_data deforming = square(false);
    for (const glm::vec3& p : deforming.positions) {
        deforming.previous.push_back(p + glm::vec3(0.1F * p.y, 0.05F, 0));
    }
    w.meshes.push_back(deforming);
    w.materials.resize(2);
    w.materials[1].two_sided = false;
    w.add(0, 0, placed({ 0, 0, -2 }, 0.3F, { 3, 1.5F, 1 }));
    w.add(1, 0, placed({ -1.2F, 0.6F, 0 }, 0.4F, { 1, 1, 1 }));
    w.add(0, 1, placed({ 1.2F, 0.7F, -1 }, -0.5F, { 0.7F, 0.9F, 2 }));    // front, culled: seen
    w.add(0, 1, placed({ 0.4F, -0.4F, 0.5F }, 3.3F, { 0.7F, 0.7F, 1 }));  // back, culled: not seen
    w.add(0, 1, placed({ -0.4F, -0.9F, 0 }, 0.2F, { -0.6F, 0.5F, 1 }));   // mirrored, front: seen
    w.add(0, 0, placed({ 1.5F, -0.9F, -0.5F }, 3.0F, { 0.6F, 0.6F, 1 })); // back, two-sided: seen
    w.add(2, 0, placed({ -1.7F, -0.9F, 0.3F }, -0.3F, { 0.5F, 0.5F, 1 }));
    w.add(1, 0, placed({ 0.2F, 1.1F, 0.1F }, 0.1F, { -0.5F, 0.5F, 0.5F })); // flat and mirrored
    w.objects[2].previous_model = placed({ 1.1F, 0.6F, -1.1F }, -0.45F, { 0.7F, 0.9F, 2 });
    return w;
}

// In either format.
inline glm::vec4 motion_of(const drawn& d, std::size_t i)
{
    return d.motion.format == pixel_format::rgba32f ? d.motion.texel<glm::vec4>(i)
                                                    : glm::vec4(d.motion.texel<glm::vec2>(i), 0, 0);
}

struct expectation {
    std::size_t compared = 0;
    std::size_t background = 0;
    std::vector<int> objects;
};

// Requires every pixel away from edges to be what the rays see.
inline expectation compare(const world& w, const ao::gbuffer_camera& camera, const drawn& d, double depth_step)
{
    expectation e;
    const caster rays(w, camera);
    const float far_end = ao::fold_projection(camera.projection, width, height)->decode.cleared;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const seen at = rays.look(x, y);
            if (at.doubtful) {
                continue;
            }
            ++e.compared;
            const auto i = static_cast<std::size_t>(y * width + x);
            INFO("pixel " << x << ", " << y << ", object " << at.object);
            const auto ids = d.ids.texel<glm::uvec2>(i);
            REQUIRE(static_cast<int>(ids.x) == at.object + 1);
            const auto stored = d.depth.format == pixel_format::d24
                                    ? static_cast<double>(d.depth.texel<std::uint32_t>(i) & 0xffffffU) / 16777215
                                    : static_cast<double>(d.depth.texel<float>(i));
            if (at.object < 0) {
                ++e.background;
                REQUIRE(stored == static_cast<double>(far_end));
                REQUIRE(ids.y == 0);
                REQUIRE(d.position.texel<glm::vec4>(i) == glm::vec4(0));
                REQUIRE(d.normal.texel<glm::vec4>(i) == glm::vec4(0));
                REQUIRE(motion_of(d, i) == glm::vec4(0));
                REQUIRE(d.surface.texel<glm::vec4>(i) == glm::vec4(0));
                continue;
            }
            e.objects.push_back(at.object);
            const dvec2 pixel(x + 0.5, y + 0.5);
            REQUIRE(static_cast<int>(ids.y) == w.objects[static_cast<std::size_t>(at.object)].material + 1);
            REQUIRE(std::abs(stored - at.stored) < depth_step);
            const dvec3 p = rays.position(at.object, at.triangle, at.weights);
            const auto position = d.position.texel<glm::vec4>(i);
            REQUIRE(glm::length(dvec3(position) - p) < 1e-4 * glm::length(p));
            REQUIRE(position.w == 1);
            REQUIRE(glm::length(dvec3(d.normal.texel<glm::vec4>(i)) - rays.normal(at, pixel) * (at.front ? 1.0 : -1.0)) < 1e-4);
            const glm::vec4 motion = motion_of(d, i);
            const dvec3 moved = rays.motion(at, pixel);
            REQUIRE(glm::length(dvec2(motion) - dvec2(moved)) < 2e-3);
            if (d.motion.format == pixel_format::rgba32f) {
                const double before = std::max(moved.z, 0.0);
                REQUIRE(std::abs(static_cast<double>(motion.z) - before) < 1e-5 * before + 1e-5);
                REQUIRE(motion.w == 0);
            }

            const auto surface = d.surface.texel<glm::vec4>(i);
            REQUIRE(surface.w == (at.front ? 1.0F : -1.0F));
            const mesh_data& m = rays.mesh_of(at.object);
            if (m.uvs.empty()) {
                REQUIRE(glm::vec3(surface) == glm::vec3(0));
                continue;
            }
            const auto uv = [&](double column, double row) {
                return rays.interpolate(at.object, at.triangle, m.uvs, { column, row });
            };
            REQUIRE(glm::length(dvec2(surface.x, surface.y) - uv(pixel.x, pixel.y)) < 1e-4);
            // Differences within the pixel's own block of 2x2.
            const dvec2 across = uv((x | 1) + 0.5, pixel.y) - uv((x & ~1) + 0.5, pixel.y);
            const dvec2 down = uv(pixel.x, (y | 1) + 0.5) - uv(pixel.x, (y & ~1) + 0.5);
            const double footprint = std::max(glm::dot(across, across), glm::dot(down, down));
            REQUIRE(std::abs(static_cast<double>(surface.z) - footprint) < 0.03 * footprint);
        }
    }
    return e;
}

// Of points that were in front of the last frame's eye and behind it; what both formats hold is the same.
inline void check_motion_depth(const draw_function& draw)
{
    world w = plain_world();
    auto f = all_targets();
    auto view = camera({});
    view.previous_view[3][2] += 6;
    const drawn two = draw(w.get(), f, view);
    f.motion_format = pixel_format::rgba32f;
    const drawn four = draw(w.get(), f, view);
    const caster rays(w, view);
    std::array<int, 2> sides{};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(y * width + x);
            INFO("pixel " << x << ", " << y);
            REQUIRE(two.motion.texel<glm::vec2>(i) == glm::vec2(four.motion.texel<glm::vec4>(i)));
            const seen at = rays.look(x, y);
            if (at.doubtful || at.object < 0) {
                continue;
            }
            const double before = rays.motion(at, dvec2(x + 0.5, y + 0.5)).z;
            const auto z = static_cast<double>(four.motion.texel<glm::vec4>(i).z);
            REQUIRE(z >= 0);
            REQUIRE(std::abs(z - std::max(before, 0.0)) < 1e-4);
            ++sides[before > 0 ? 0 : 1];
        }
    }
    CHECK(sides[0] > 50);
    CHECK(sides[1] > 50);
}

// Standard, reversed, infinite, parallel, either depth range and first row, d24.
inline void check_targets(const draw_function& draw)
{
    check_motion_depth(draw);
    const world built = plain_world();
    world w = built;
    const ao::scene s = w.get();
    for (const int kind : { 0, 1, 2, 3, 4, 5, 6, 7 }) {
        ao::projection_options o;
        o.reversed = kind == 1 || kind == 2 || kind == 6;
        o.parallel = kind == 3 || kind == 6;
        o.range = kind % 2 == 0 ? ao::depth_range::zero_to_one : ao::depth_range::minus_one_to_one;
        o.rows = kind == 4 || kind == 5 ? ao::first_row::at_ndc_plus_one : ao::first_row::at_ndc_minus_one;
        o.y_down = kind == 5 || kind == 7;
        const bool infinite = kind == 2 || kind == 0;
        const auto view = camera(o, infinite ? std::numeric_limits<double>::infinity() : 60);
        auto f = all_targets();
        f.depth_format = kind == 7 ? pixel_format::d24 : pixel_format::d32f;
        f.motion_format = kind % 4 < 2 ? pixel_format::rgba32f : pixel_format::rg32f;
        INFO("kind " << kind);
        const expectation e = compare(w, view, draw(s, f, view), kind == 7 ? 3e-7 : 1e-6);
        CHECK(e.compared > width * height * 8 / 10);
        CHECK(e.background > 100);
        for (const int object : { 0, 1, 2, 4, 5, 6, 7 }) {
            CHECK(std::count(e.objects.begin(), e.objects.end(), object) > 20);
        }
        CHECK(std::count(e.objects.begin(), e.objects.end(), 3) == 0);
    }
}

// Mirrored UVs, mirrored and unevenly scaled models, either green; alpha is cut.
inline void check_maps(const draw_function& draw)
{
    world w;
    w.meshes = { square(false), square(true) };
    w.materials.resize(2);
    // One texel, so that the filter does not matter here.
    w.add_texture(1, { 200, 90, 220, 255 }, ao::wrap_mode::repeat);
    std::vector<std::uint8_t> alpha;
    for (int i = 0; i < 16; ++i) {
        alpha.insert(alpha.end(), { 0, 0, 0, static_cast<std::uint8_t>((i * 7 + i / 4) % 2 == 0 ? 255 : 0) });
    }
    w.add_texture(4, alpha, ao::wrap_mode::mirror);
    w.materials[0].normal_map = 0;
    w.materials[1].normal_map = 0;
    w.materials[1].normal_green_down = true;
    w.materials[1].alpha_map = 1;
    w.materials[1].repeat = { 0.7F, 0.6F };
    w.add(0, 0, placed({ -1.3F, 0.9F, 0 }, 0.4F, { 1, 0.6F, 1 }));
    w.add(1, 1, placed({ 1.3F, 0.9F, 0 }, 0.4F, { 1, 0.6F, 3 }));
    w.add(1, 0, placed({ -1.3F, -0.9F, 0 }, 0.4F, { -0.8F, 0.6F, 0.5F }));
    w.add(0, 1, placed({ 1.3F, -0.9F, 0 }, 2.7F, { 1, -0.6F, 1 }));
    const ao::scene s = w.get();
    const auto view = camera({});
    const auto d = draw(s, all_targets(), view);
    const auto heap = ao::make_texel_heap(s.textures);
    const caster rays(w, view);
    std::array<int, 4> compared{};
    int cut = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const seen at = rays.look(x, y);
            if (at.doubtful || at.object < 0) {
                continue;
            }
            const auto i = static_cast<std::size_t>(y * width + x);
            const dvec2 pixel(x + 0.5, y + 0.5);
            INFO("pixel " << x << ", " << y << ", object " << at.object);
            const auto& object = w.objects[static_cast<std::size_t>(at.object)];
            const auto& material = w.materials[static_cast<std::size_t>(object.material)];
            const mesh_data& m = rays.mesh_of(at.object);
            if (material.alpha_map != ao::no_texture) {
                const dvec2 uv = rays.interpolate(at.object, at.triangle, m.uvs, pixel) * dvec2(material.repeat);
                const double alpha_here = ao::sample<double>(*heap, 1, uv, 0.0).w;
                if (std::abs(alpha_here - 0.5) < 0.03) {
                    continue;
                }
                REQUIRE((d.ids.texel<glm::uvec2>(i).x == 0) == (alpha_here < 0.5));
                if (alpha_here < 0.5) {
                    ++cut;
                    continue;
                }
            }
            // Tangent space by its definition: images of the directions of u and v under the model.
            const dmat4 model_view = rays.model_view(at.object);
            const dvec3 n = rays.normal(at, pixel);
            const dvec4 local = rays.interpolate(at.object, at.triangle, m.tangents, pixel);
            dvec3 t = glm::dmat3(model_view) * dvec3(local);
            t = glm::normalize(t - n * glm::dot(n, t));
            dvec3 b = glm::cross(n, t);
            const dvec3 along_v = glm::dmat3(model_view) * dvec3(0, 1, 0);
            b *= glm::dot(b, along_v) < 0 ? -1 : 1;
            const dvec3 texel = dvec3(200, 90, 220) / 255.0 * 2.0 - 1.0;
            const dvec3 mapped =
                glm::normalize(t * texel.x + b * (texel.y * (material.normal_green_down ? -1 : 1)) + n * texel.z);
            REQUIRE(glm::length(dvec3(d.normal.texel<glm::vec4>(i)) - mapped * (at.front ? 1.0 : -1.0)) < 1e-4);
            ++compared[static_cast<std::size_t>(at.object)];
        }
    }
    for (const int count : compared) {
        CHECK(count > 50);
    }
    CHECK(cut > 50);
}

inline void check_normal_formats(const draw_function& draw)
{
    world w = plain_world();
    ao::gbuffer_facts f = all_targets();
    const auto view = camera({});
    const drawn exact = draw(w.get(), f, view);
    struct kind {
        ao::normal_source source;
        pixel_format format;
        double error;
    };
    for (const kind& k : { kind{ ao::normal_source::vector, pixel_format::rgba16f, 1e-3 },
                           kind{ ao::normal_source::unorm10, pixel_format::rgb10a2, 2e-3 },
                           kind{ ao::normal_source::octahedral, pixel_format::rg16, 1e-4 } }) {
        f.normals = k.source;
        f.normal_format = k.format;
        const drawn d = draw(w.get(), f, view);
        INFO("source " << static_cast<int>(k.source));
        for (std::size_t i = 0; i < d.normal.pixels(); ++i) {
            if (d.ids.texel<glm::uvec2>(i).x == 0) {
                continue;
            }
            glm::vec4 texel;
            if (k.format == pixel_format::rgba16f) {
                const auto h = d.normal.texel<std::array<std::uint16_t, 4>>(i);
                texel = { ao::half_to_float(h[0]), ao::half_to_float(h[1]), ao::half_to_float(h[2]), 0 };
            }
            else {
                const auto code = d.normal.texel<std::uint32_t>(i);
                texel = k.format == pixel_format::rg16
                            ? glm::vec4(code & 65535U, code >> 16U, 0, 0) / 65535.0F
                            : glm::vec4(code & 1023U, code >> 10U & 1023U, code >> 20U & 1023U, 0) / 1023.0F;
            }
            const glm::vec3 n = ao::math<float>::ao_decoded_normal(static_cast<int>(k.source), texel);
            REQUIRE(static_cast<double>(glm::length(glm::normalize(n) - glm::vec3(exact.normal.texel<glm::vec4>(i)))) < k.error);
        }
    }
}

// Each with its own transform and id; an empty scene clears. `count` is at least 1000 + width * height.
inline void check_many_objects(const draw_function& draw, int count)
{
    world w;
    w.meshes.push_back(square(false));
    w.meshes.push_back(square(true));
    ao::gbuffer_facts f;
    f.width = width;
    f.height = height;
    f.ids = true;
    ao::gbuffer_camera view;
    view.projection = ao::make_projection({ 0, width, 0, height, 0.5, 10 }, { .parallel = true });
    const drawn empty = draw(w.get(), f, view);
    CHECK(empty.programs == 0);
    CHECK(differing(empty.ids, ao::picture(pixel_format::rg32ui, width, height)) == 0);

    // Pixel i belongs to object `first` + i; all the others are left of the picture.

    const int first = count - width * height;
    for (int i = 0; i < count; ++i) {
        const int pixel = i - first;
        const auto x = static_cast<float>(pixel < 0 ? -5 : pixel % width);
        const auto y = static_cast<float>(pixel < 0 ? 0 : pixel / width);
        w.add(i > count - 1000 ? i % 2 : 0, 0,
              glm::scale(glm::translate(glm::mat4(1), glm::vec3(x + 0.5F, y + 0.5F, -1)), glm::vec3(0.4F)));
    }
    const drawn d = draw(w.get(), f, view);
    CHECK(d.draw_calls == 1);
    std::size_t wrong = 0;
    for (int i = 0; i < width * height; ++i) {
        const auto ids = d.ids.texel<glm::uvec2>(static_cast<std::size_t>(i));
        wrong += ids == glm::uvec2(first + i + 1, 1) ? 0 : 1;
    }
    CHECK(wrong == 0);
}

} // namespace raster_test
