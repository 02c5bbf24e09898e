// A frame's camera and viewport, and the projection of corners.
#pragma once

#include "raster_state.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cmath>

namespace ao::cpu {

inline constexpr int subpixels = 256;
inline constexpr double guard_pixels = 16384; // beyond the picture; corners stay below 2^17 pixels
inline constexpr float least_w = 1e-30F;
inline constexpr float most_clip = 1e30F;

struct raster_view {
    geometry_camera camera{};
    bool turned = false;
    bool zero_to_one = true; // range of z / w
    float key_sign = 1;      // -1 where greater depths are closer
    float far_end = 1;
    float half_width = 0; // pixels
    float half_height = 0;
    double guard_x = 0; // |x| <= guard_x * w is drawn without clipping
    double guard_y = 0;

    raster_view(const gbuffer_camera& c, const gbuffer_facts& f)
    {
        const geometry_view made = make_geometry_view(c, f, false);
        camera = made.camera;
        turned = made.turned;
        far_end = made.far_end;
        zero_to_one = c.projection.range == depth_range::zero_to_one;
        key_sign = far_end > 0 ? 1.0F : -1.0F;
        half_width = static_cast<float>(f.width) * 0.5F;
        half_height = static_cast<float>(f.height) * 0.5F;
        guard_x = 1 + 2 * guard_pixels / f.width;
        guard_y = 1 + 2 * guard_pixels / f.height;
    }
    bool in_guard_band(const glm::vec4& clip) const
    {
        const double w = static_cast<double>(clip.w);
        return clip.w >= least_w && std::abs(static_cast<double>(clip.x)) <= guard_x * w &&
               std::abs(static_cast<double>(clip.y)) <= guard_y * w;
    }
    // In 1/256 pixel from the centre of the first pixel, rounded as drivers do. Precondition: in the guard band.
    glm::ivec2 snapped(const glm::vec4& clip) const
    {
        const float inverse = 1.0F / clip.w;
        const float x = clip.x * inverse * half_width + half_width;
        const float y = clip.y * inverse * half_height + half_height;
        constexpr auto steps = static_cast<float>(subpixels);
        return { static_cast<int>(std::lrint((x - 0.5F) * steps)), static_cast<int>(std::lrint((y - 0.5F) * steps)) };
    }
    glm::vec4 clip_position(const geometry_instance& o, const glm::vec3& position) const
    {
        using shared = math<float>;
        return shared::ao_vertex_clip(camera.clip, camera.clip_w, shared::ao_vertex_position(camera.view, o.model, position));
    }
};

// Twice the area in squares of 1/256 pixel; positive where the corners turn clockwise on rows that run downwards.
inline std::int64_t doubled_area(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c)
{
    const std::int64_t ux = b.x - a.x;
    const std::int64_t uy = b.y - a.y;
    const std::int64_t vx = c.x - a.x;
    const std::int64_t vy = c.y - a.y;
    return ux * vy - vx * uy;
}

// The homogeneous form of a triangle in the plane of the picture (Olano and Greer, "Triangle Scan Conversion Using 2D Homogeneous
// Coordinates", 1997): dot(edges[i], (x, y, 1)) at pixel (x, y) is the weight of corner i there, over w. The weights need no
// clipping, and are perspective-correct over their sum.
struct corner_weights {
    std::array<glm::dvec3, 3> edges;
    double determinant = 0; // 0: there are no weights

    corner_weights() = default;
    corner_weights(const raster_view& v, const std::array<glm::vec4, 3>& clip);

    glm::dvec3 at(double x, double y) const
    {
        return { edges[0].x * x + (edges[0].y * y + edges[0].z), edges[1].x * x + (edges[1].y * y + edges[1].z),
                 edges[2].x * x + (edges[2].y * y + edges[2].z) };
    }
};

} // namespace ao::cpu
