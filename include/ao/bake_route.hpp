// Which route a bake takes on the CPU, and why.
#pragma once

#include "ao/bake.hpp"
#include "ao/detail/text.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>

namespace ao {

struct bake_choice {
    bake_route route;
    detail::reason why;
};

// Of `raster` and `hierarchy`, the quicker by what was measured on the CPU (docs/numerics.md, "Per vertex"). The raster's time is
// lines x (triangles x a + vertices x b), whatever the distance and the part of the sphere that a vertex sees; the hierarchy's is
// that of the rays, whose cost grows with the logarithm of the triangles and falls with the share of the mesh within reach.
inline bake_choice choose_bake_route(const bake_job& job, std::size_t vertices)
{
    using enum bake_route;
    if (job.turned()) {
        return { hierarchy, detail::reason("hierarchy: the rule is turned at each vertex") };
    }
    const auto triangles = static_cast<double>(job.mesh.triangles.size());
    const auto receivers = static_cast<double>(vertices);
    // Nanoseconds of one thread.
    constexpr double raster_triangle = 45;
    constexpr double raster_vertex = 25;
    constexpr double ray = 100;
    constexpr double ray_level = 14;
    const double seen = job.lines.empty() || job.lines.front().opposite > 0 ? 1.0 : 0.5; // rays of a line and vertex
    const double distance = static_cast<double>(job.reach) / std::max(job.mesh.diagonal, 1e-30);
    // Surfaces: what is within reach grows with the square of the distance.
    const double near = std::max(1.0, triangles * std::min(1.0, 4 * distance * distance));
    const double raster_time = triangles * raster_triangle + receivers * raster_vertex;
    const double nearest = job.settings.falloff == bake_falloff::none ? 1 : 1.5;
    const double hierarchy_time = receivers * seen * nearest * (ray + ray_level * std::log2(near + 1));
    const auto microseconds = [](double x) { return static_cast<long long>(x * 1e-3); };
    const bool by_raster = raster_time < hierarchy_time;
    return { by_raster ? raster : hierarchy,
             detail::reason(by_raster ? "raster" : "hierarchy", ": for ", vertices, " vertices, ", job.mesh.triangles.size(),
                            " triangles and ", job.lines.size(), " lines of directions the raster should take ",
                            microseconds(raster_time), " us a line, rays through the tree ", microseconds(hierarchy_time),
                            " us") };
}

} // namespace ao
