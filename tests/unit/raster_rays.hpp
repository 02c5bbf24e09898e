// Scenes of a few triangles, and what rays through pixel centres see of them, in double.
#pragma once

#include "ao/gbuffer.hpp"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace raster_test {

using ao::pixel_format;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

inline constexpr int width = 96;
inline constexpr int height = 64;

struct mesh_data {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec3> previous;
    std::vector<std::uint32_t> indices;

    ao::mesh get() const { return { positions, normals, tangents, uvs, previous, indices }; }
};

// The unit square in the plane z = 0, facing +z, with normals that are not its own; `mirror_u` turns u around.
inline mesh_data square(bool mirror_u)
{
    mesh_data m;
    m.positions = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
    m.normals = { { -0.3F, 0, 1 }, { 0.2F, 0.1F, 1 }, { 0.4F, 0.3F, 0.9F }, { 0, 0.2F, 1 } };
    const float side = mirror_u ? -1.0F : 1.0F;
    for (const glm::vec3& p : m.positions) {
        m.uvs.push_back({ side * (p.x * 0.5F + 0.5F), p.y * 0.75F + 0.1F });
        m.tangents.push_back({ side, 0, 0.1F, side });
    }
    m.indices = { 0, 1, 2, 0, 2, 3 };
    return m;
}

struct world {
    std::vector<mesh_data> meshes;
    std::vector<ao::standard_material> materials{ 1 };
    std::vector<ao::object> objects;
    std::vector<std::vector<std::uint8_t>> texels;
    std::vector<ao::texture> textures;

    void add(int mesh, int material, const glm::mat4& model)
    {
        ao::object o;
        o.mesh = mesh;
        o.material = material;
        o.model = o.previous_model = model;
        objects.push_back(o);
    }
    void add_texture(int side, std::vector<std::uint8_t> bytes, ao::wrap_mode wrap)
    {
        ao::texture t;
        t.width = t.height = side;
        t.wrap_u = t.wrap_v = wrap;
        texels.push_back(std::move(bytes));
        textures.push_back(t);
    }
    // Points into this; ask again after a change.
    ao::scene get()
    {
        views.clear();
        for (const mesh_data& m : meshes) {
            views.push_back(m.get());
        }
        for (std::size_t i = 0; i < textures.size(); ++i) {
            textures[i].texels = texels[i];
        }
        ao::scene s;
        s.meshes = views;
        s.textures = textures;
        s.materials = materials;
        s.objects = objects;
        return s;
    }
    std::vector<ao::mesh> views;
};

inline dmat4 to_double(const ao::matrix4& m)
{
    return dmat4(m.to_glm());
}

// What a pixel's centre shows.
struct seen {
    bool doubtful = false; // too near an edge of a triangle
    int object = -1;
    std::size_t triangle = 0;
    double depth = 0;
    double stored = 0; // in the depth buffer
    bool front = true;
    dvec3 weights{ 0 };
};

struct frame_size {
    dmat4 clip;
    double row_sign;

    dvec2 pixel(const dvec4& c) const { return { (c.x / c.w * 0.5 + 0.5) * width, (row_sign * c.y / c.w * 0.5 + 0.5) * height }; }
};

inline dvec3 point(const mesh_data& m, std::size_t triangle, int corner)
{
    return dvec3(m.positions[m.indices[3 * triangle + static_cast<std::size_t>(corner)]]);
}

// Perspective-correct weights of a triangle's corners at a pixel, whether it covers it (positive), and how surely, in pixels.
struct coverage {
    dvec3 weights{ 0 };
    double margin = 0;
};

inline coverage cover(const std::array<dvec4, 3>& corners, const frame_size& f, dvec2 at)
{
    std::array<dvec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
        p[i] = f.pixel(corners[i]);
    }
    const auto cross = [](dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; };
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    coverage c;
    c.margin = 1e9;
    for (int i = 0; i < 3; ++i) {
        const dvec2 a = p[static_cast<std::size_t>((i + 1) % 3)];
        const dvec2 b = p[static_cast<std::size_t>((i + 2) % 3)];
        const double edge = cross(b - a, at - a);
        c.margin = std::min(c.margin, edge * (area < 0 ? -1 : 1) / glm::length(b - a));
        c.weights[i] = edge / area / corners[static_cast<std::size_t>(i)].w;
    }
    c.weights /= c.weights.x + c.weights.y + c.weights.z;
    return c;
}

class caster {
public:
    caster(const world& w, const ao::gbuffer_camera& camera) : world_(w), camera_(camera), view_(to_double(camera.view))
    {
        size_.clip = to_double(camera.projection.matrix);
        size_.row_sign = camera.projection.rows == ao::first_row::at_ndc_minus_one ? 1 : -1;
        parallel_ = camera.projection.matrix[2][3] == 0;
    }
    dmat4 model_view(int object) const { return view_ * to_double(world_.objects[static_cast<std::size_t>(object)].model); }
    const mesh_data& mesh_of(int object) const
    {
        return world_.meshes[static_cast<std::size_t>(world_.objects[static_cast<std::size_t>(object)].mesh)];
    }
    std::array<dvec4, 3> corners(int object, std::size_t triangle) const
    {
        const dmat4 clip = size_.clip * model_view(object);
        const mesh_data& m = mesh_of(object);
        return { clip * dvec4(point(m, triangle, 0), 1), clip * dvec4(point(m, triangle, 1), 1),
                 clip * dvec4(point(m, triangle, 2), 1) };
    }
    seen look(int x, int y) const
    {
        seen nearest;
        for (int o = 0; o < static_cast<int>(world_.objects.size()); ++o) {
            const mesh_data& m = mesh_of(o);
            for (std::size_t t = 0; 3 * t < m.indices.size(); ++t) {
                const std::array<dvec4, 3> c = corners(o, t);
                const coverage here = cover(c, size_, { x + 0.5, y + 0.5 });
                nearest.doubtful = nearest.doubtful || std::abs(here.margin) < 0.02;
                if (here.margin <= 0) {
                    continue;
                }
                const dvec3 p = position(o, t, here.weights);
                const bool front = faces_eye(o, t, p);
                const auto& object = world_.objects[static_cast<std::size_t>(o)];
                if (!front && !world_.materials[static_cast<std::size_t>(object.material)].two_sided) {
                    continue;
                }
                if (nearest.object < 0 || -p.z < nearest.depth) {
                    const dvec4 clip = size_.clip * dvec4(p, 1);
                    const double z = clip.z / clip.w;
                    nearest = { nearest.doubtful,
                                o,
                                t,
                                -p.z,
                                camera_.projection.range == ao::depth_range::zero_to_one ? z : z * 0.5 + 0.5,
                                front,
                                here.weights };
                }
            }
        }
        return nearest;
    }
    dvec3 position(int object, std::size_t triangle, dvec3 weights) const
    {
        const mesh_data& m = mesh_of(object);
        dvec3 p(0);
        for (int i = 0; i < 3; ++i) {
            p += weights[i] * point(m, triangle, i);
        }
        return dvec3(model_view(object) * dvec4(p, 1));
    }
    // Of an attribute at a pixel that need not lie inside.
    template <class Vector>
    auto interpolate(int object, std::size_t triangle, const std::vector<Vector>& values, dvec2 at) const
    {
        const dvec3 weights = cover(corners(object, triangle), size_, at).weights;
        glm::vec<Vector::length(), double> sum(0);
        for (int i = 0; i < 3; ++i) {
            sum += weights[i] * glm::vec<Vector::length(), double>(
                                    values[mesh_of(object).indices[3 * triangle + static_cast<std::size_t>(i)]]);
        }
        return sum;
    }
    // Unit, in view space, as interpolated or the triangle's own; seen from the front.
    dvec3 normal(const seen& at, dvec2 pixel) const
    {
        const mesh_data& m = mesh_of(at.object);
        const dvec3 local =
            m.normals.empty() ? own_normal(m, at.triangle) : interpolate(at.object, at.triangle, m.normals, pixel);
        return glm::normalize(glm::transpose(glm::inverse(glm::dmat3(model_view(at.object)))) * local);
    }
    // Where the point was in the last frame, minus where it is; z: its eye depth then.
    dvec3 motion(const seen& at, dvec2 pixel) const
    {
        const mesh_data& m = mesh_of(at.object);
        const auto& o = world_.objects[static_cast<std::size_t>(at.object)];
        const dvec3 local = interpolate(at.object, at.triangle, m.previous.empty() ? m.positions : m.previous, pixel);
        const frame_size before{ to_double(camera_.previous_projection.matrix), size_.row_sign };
        const dvec4 there = to_double(camera_.previous_view) * to_double(o.previous_model) * dvec4(local, 1);
        return { before.pixel(before.clip * there) - pixel, -there.z };
    }

private:
    static dvec3 own_normal(const mesh_data& m, std::size_t t)
    {
        return glm::cross(point(m, t, 1) - point(m, t, 0), point(m, t, 2) - point(m, t, 0));
    }
    bool faces_eye(int object, std::size_t t, dvec3 p) const
    {
        const dvec3 n = glm::transpose(glm::inverse(glm::dmat3(model_view(object)))) * own_normal(mesh_of(object), t);
        return glm::dot(n, parallel_ ? dvec3(0, 0, 1) : -p) > 0;
    }

    const world& world_;
    ao::gbuffer_camera camera_;
    dmat4 view_;
    frame_size size_{};
    bool parallel_ = false;
};

} // namespace raster_test
