// Which route a bake takes, and why.
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

// Nanoseconds of one thread of the CPU, or of software drivers with two: measured, docs/numerics.md, "Per vertex".
struct bake_costs {
    double raster_triangle; // along one line
    double raster_vertex;
    double ray;
    double ray_level; // a ray's for every doubling of the triangles
};
inline constexpr bake_costs cpu_bake_costs{ 45, 25, 100, 14 };
inline constexpr bake_costs gpu_bake_costs{ 600, 450, 2000, 500 };

// Of `raster` and `hierarchy`, the quicker by these costs. The raster's time is lines x (triangles x a + vertices x b), whatever
// the distance and the part of the sphere that a vertex sees; the hierarchy's is that of the rays, whose cost grows with the
// logarithm of the triangles and falls with the share of the mesh within reach.
inline bake_choice choose_bake_route(const bake_job& job, std::size_t vertices, const bake_costs& costs = cpu_bake_costs)
{
    using enum bake_route;
    if (job.turned()) {
        return { hierarchy, detail::reason("hierarchy: the rule is turned at each vertex") };
    }
    const auto triangles = static_cast<double>(job.mesh.triangles.size());
    const auto receivers = static_cast<double>(vertices);
    const double seen = job.lines.empty() || job.lines.front().opposite > 0 ? 1.0 : 0.5; // rays of a line and vertex
    const double distance = static_cast<double>(job.reach) / std::max(job.mesh.diagonal, 1e-30);
    // Surfaces: what is within reach grows with the square of the distance.
    const double near = std::max(1.0, triangles * std::min(1.0, 4 * distance * distance));
    const double raster_time = triangles * costs.raster_triangle + receivers * costs.raster_vertex;
    const double nearest = job.settings.falloff == bake_falloff::none ? 1 : 1.5;
    const double hierarchy_time = receivers * seen * nearest * (costs.ray + costs.ray_level * std::log2(near + 1));
    const auto microseconds = [](double x) { return static_cast<long long>(x * 1e-3); };
    const bool by_raster = raster_time < hierarchy_time;
    return { by_raster ? raster : hierarchy,
             detail::reason(by_raster ? "raster" : "hierarchy", ": for ", vertices, " vertices, ", job.mesh.triangles.size(),
                            " triangles and ", job.lines.size(), " lines of directions the raster should take ",
                            microseconds(raster_time), " us a line, rays through the tree ", microseconds(hierarchy_time),
                            " us") };
}

} // namespace ao
