// What a triangle has at a pixel.
#pragma once

#include "raster_view.hpp"

#include "ao/geometry_pass.hpp"

#include <algorithm>
#include <array>

namespace ao::cpu {

struct raster_resources {
    const std::uint32_t* heap;
    const drawn_material* materials;

    std::uint32_t texel(std::uint32_t i) const { return heap[i]; }
    const drawn_material& material(std::uint32_t i) const { return materials[i]; }
};

using raster_pass = geometry_pass<float, raster_resources>;

struct raster_frame {
    const raster_model_state& model;
    const raster_view& view;
    raster_pass::ao_geometry_camera camera;

    raster_frame(const raster_model_state& m, const raster_view& v)
        : model(m),
          view(v),
          camera(std::bit_cast<raster_pass::ao_geometry_camera>(v.camera))
    {
    }
};

// A triangle with its corners' attributes in view space; those that its draw does not need are left out.
class raster_surface {
public:
    raster_surface() = default;
    raster_surface(const raster_frame& frame, const raster_triangle& t);

    const raster_triangle* triangle() const { return triangle_; }
    const raster_object& object() const { return *object_; }
    const draw_variant& variant() const { return *variant_; }
    raster_pass pass(const raster_frame& frame) const
    {
        const raster_model_state& m = frame.model;
        return {
            { m.heap.data(), m.materials.data() }, variant_->alpha_map, variant_->normal_map, static_cast<int>(m.facts.normals)
        };
    }
    // Perspective-correct weights of the corners: not negative, 1 together.
    glm::vec3 weights(int x, int y) const
    {
        // Pixels that snapping added lie outside of the triangle by 1/256 pixel, which slivers magnify.
        glm::dvec3 w = planes_.at(x, y);
        w = { std::max(w.x, 0.0), std::max(w.y, 0.0), std::max(w.z, 0.0) };
        const double total = w.x + w.y + w.z;
        if (!(total > 0)) {
            return glm::vec3(1.0F / 3.0F);
        }
        const double inverse = 1 / total;
        return { static_cast<float>(w.x * inverse), static_cast<float>(w.y * inverse), static_cast<float>(w.z * inverse) };
    }
    // Texture coordinates at a pixel of these weights, and their differences within its block of 2x2.
    raster_pass::ao_map_place place(int x, int y, const glm::vec3& weights) const;
    glm::vec3 position(const glm::vec3& w) const { return sum(positions_, w); }
    glm::vec3 previous(const glm::vec3& w) const { return sum(previous_, w); }
    glm::vec3 normal(const glm::vec3& w) const { return sum(normals_, w); }
    glm::vec4 tangent(const glm::vec3& w) const { return sum(tangents_, w); }

private:
    template <class Vector>
    static Vector sum(const std::array<Vector, 3>& corners, const glm::vec3& w)
    {
        return corners[0] * w.x + corners[1] * w.y + corners[2] * w.z;
    }
    glm::vec2 difference(const glm::vec2& here, int x, int y, float direction) const;

    const raster_triangle* triangle_ = nullptr;
    const raster_object* object_ = nullptr;
    const draw_variant* variant_ = nullptr;
    corner_weights planes_;
    std::array<glm::vec3, 3> positions_;
    std::array<glm::vec3, 3> previous_;
    std::array<glm::vec3, 3> normals_;
    std::array<glm::vec4, 3> tangents_;
    std::array<glm::vec2, 3> uvs_;
};

} // namespace ao::cpu
