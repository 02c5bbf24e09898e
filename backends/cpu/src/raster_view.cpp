#include "raster_view.hpp"

namespace ao::cpu {

namespace {

glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b)
{
    return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

double dot(const glm::dvec3& a, const glm::dvec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace

corner_weights::corner_weights(const raster_view& v, const std::array<glm::vec4, 3>& clip)
{
    const double half_width = static_cast<double>(v.half_width);
    const double half_height = static_cast<double>(v.half_height);
    std::array<glm::dvec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
        const double w = static_cast<double>(clip[i].w);
        p[i] = { static_cast<double>(clip[i].x) * half_width + w * (half_width - 0.5),
                 static_cast<double>(clip[i].y) * half_height + w * (half_height - 0.5), w };
    }
    const auto solve = [&] {
        edges = { cross(p[1], p[2]), cross(p[2], p[0]), cross(p[0], p[1]) };
        determinant = dot(p[0], edges[0]);
    };
    solve();
    if (v.in_guard_band(clip[0]) && v.in_guard_band(clip[1]) && v.in_guard_band(clip[2])) {
        // Slivers whose area the snapping changed by half, or turned around, are what they were snapped to.
        const std::array<glm::ivec2, 3> corners{ v.snapped(clip[0]), v.snapped(clip[1]), v.snapped(clip[2]) };
        constexpr double scale = subpixels;
        const auto snapped = static_cast<double>(doubled_area(corners[0], corners[1], corners[2]));
        const double exact = determinant / (p[0].z * p[1].z * p[2].z) * (scale * scale);
        if (!(std::abs(exact - snapped) <= 0.5 * std::abs(snapped))) {
            for (std::size_t i = 0; i < 3; ++i) {
                p[i].x = corners[i].x / scale * p[i].z;
                p[i].y = corners[i].y / scale * p[i].z;
            }
            solve();
        }
    }
    if (determinant != 0) {
        for (glm::dvec3& e : edges) {
            e = { e.x / determinant, e.y / determinant, e.z / determinant };
        }
    }
}

} // namespace ao::cpu
