#pragma once

#include "scene.hpp"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace ao::tools {

// Angles in degrees, `fov` the vertical one; forward = (sin yaw cos pitch, sin pitch, -cos yaw cos pitch).
struct camera {
    glm::vec3 eye{ 0.0f };
    float yaw = 0.0f;
    float pitch = 0.0f; // -90..90
    float fov = 60.0f;  // 0..180, both ends excluded
};

[[nodiscard]] glm::vec3 forward(const camera& c);

// Columns: what x, y and z of view space are in world space; rounded nowhere but in the angles.
[[nodiscard]] glm::dmat3 view_axes(const camera& c);

// World to view space: right-handed, x to the right, y up, looking along -z. Defined for pitch = +-90 too.
[[nodiscard]] glm::mat4 view_matrix(const camera& c);

// What one view sees. View space; the sides are measured on the plane z = -1 (perspective) or on every plane
// (orthographic), near and far along -z, far may be infinite.
struct frustum {
    float left = -1.0f;
    float right = 1.0f;
    float bottom = -1.0f;
    float top = 1.0f;
    bool orthographic = false;
    float near = 0.1f;
    float far = 100.0f;
};

struct depth_range {
    float near;
    float far;
};

// Encloses the scene as seen from the camera, near at least far / 1000 so that D24 keeps its precision.
// A scene wholly behind the camera gets a range too, and shows nothing.
[[nodiscard]] depth_range clip_range(const bounds& scene, const camera& c);

// `aspect` = width / height.
[[nodiscard]] frustum perspective(const camera& c, float aspect, depth_range range);

// Shows at `distance` what the perspective of the same camera shows there.
[[nodiscard]] frustum orthographic(const camera& c, float aspect, float distance, depth_range range);

// From above one corner, the whole bounding sphere in view in both directions.
[[nodiscard]] camera frame(const bounds& scene, float aspect, float fov = 50.0f);

// The ray through a pixel's centre in view space, row 0 on top: the points (origin_x + t x, origin_y + t y, -t),
// hence t is the linear depth.
struct pixel_ray {
    double origin_x;
    double origin_y;
    double x;
    double y;
};

[[nodiscard]] pixel_ray ray_through(const frustum& f, int x, int y, int width, int height);

} // namespace ao::tools
