#include "camera.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace ao::tools {
namespace {

double half_height(const camera& c)
{
    return std::tan(glm::radians(static_cast<double>(c.fov)) / 2.0);
}

frustum symmetric(double half_width, double half_height, depth_range range, bool orthographic)
{
    frustum f;
    f.left = static_cast<float>(-half_width);
    f.right = static_cast<float>(half_width);
    f.bottom = static_cast<float>(-half_height);
    f.top = static_cast<float>(half_height);
    f.orthographic = orthographic;
    f.near = range.near;
    f.far = range.far;
    return f;
}

} // namespace

glm::dmat3 view_axes(const camera& c)
{
    const double yaw = glm::radians(static_cast<double>(c.yaw));
    const double pitch = glm::radians(static_cast<double>(c.pitch));
    const double sy = std::sin(yaw), cy = std::cos(yaw), sp = std::sin(pitch), cp = std::cos(pitch);
    return { { cy, 0.0, sy }, { -sy * sp, cp, cy * sp }, { -sy * cp, -sp, cy * cp } };
}

glm::vec3 forward(const camera& c)
{
    return glm::vec3(-view_axes(c)[2]);
}

glm::mat4 view_matrix(const camera& c)
{
    const glm::dmat3 to_view = glm::transpose(view_axes(c));
    glm::dmat4 m(to_view);
    m[3] = glm::dvec4(-(to_view * glm::dvec3(c.eye)), 1.0);
    return glm::mat4(m);
}

depth_range clip_range(const bounds& scene, const camera& c)
{
    const glm::dvec3 direction = -view_axes(c)[2];
    double low = 0.0, high = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p{ (corner & 1) != 0 ? scene.high.x : scene.low.x, (corner & 2) != 0 ? scene.high.y : scene.low.y,
                            (corner & 4) != 0 ? scene.high.z : scene.low.z };
        const double depth = glm::dot(direction, p - glm::dvec3(c.eye));
        low = corner == 0 ? depth : std::min(low, depth);
        high = corner == 0 ? depth : std::max(high, depth);
    }
    const double far = high > 0.0 ? high * 1.01 : 1.0;
    const double near = std::max(low * 0.99, far / 1000.0);
    return { static_cast<float>(near), static_cast<float>(std::max(far, near * 1.01)) };
}

frustum perspective(const camera& c, float aspect, depth_range range)
{
    const double h = half_height(c);
    return symmetric(h * static_cast<double>(aspect), h, range, false);
}

frustum orthographic(const camera& c, float aspect, float distance, depth_range range)
{
    const double h = half_height(c) * static_cast<double>(distance);
    return symmetric(h * static_cast<double>(aspect), h, range, true);
}

camera frame(const bounds& scene, float aspect, float fov)
{
    camera c;
    c.yaw = 35.0f;
    c.pitch = -25.0f;
    c.fov = fov;
    const glm::dvec3 low = scene.low, high = scene.high;
    const double radius = std::max(glm::length(high - low) / 2.0, 1.0e-6);
    const double vertical = std::atan(half_height(c));
    const double horizontal = std::atan(half_height(c) * static_cast<double>(aspect));
    const double distance = radius / std::sin(std::min(vertical, horizontal));
    c.eye = glm::vec3((low + high) / 2.0 + distance * view_axes(c)[2]);
    return c;
}

pixel_ray ray_through(const frustum& f, int x, int y, int width, int height)
{
    const auto left = static_cast<double>(f.left), top = static_cast<double>(f.top);
    const double px = left + (static_cast<double>(f.right) - left) * (x + 0.5) / width;
    const double py = top + (static_cast<double>(f.bottom) - top) * (y + 0.5) / height;
    return f.orthographic ? pixel_ray{ px, py, 0.0, 0.0 } : pixel_ray{ 0.0, 0.0, px, py };
}

} // namespace ao::tools
