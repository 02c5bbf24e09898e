// Where the rays of a vertex start. Surfaces that meet at the vertex, its own and others that pass through it, divide its
// directions into regions; the vertex belongs to the region above its own faces, on the side of its normal. The start lies a few
// steps of the lattice of ao/shared/bake_ray.h inside that region, clear of the rounding of everything that meets there, so that
// these surfaces occlude as all others do: a wall through the vertex blocks what is behind it, the vertex's own plane nothing
// above it.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace ao::detail {

// How far a start clears what meets at the vertex, in units of a prepared mesh: 16 lattice steps. Rounding moves a point by less
// than 2 steps, and rays by less than 4 over the length of the mesh. What is nearer than this to a vertex meets it.
inline constexpr double bake_clearance = 1.0 / 524288;

// Directions from the vertex between which a face lies, less than half a turn.
struct bake_arc {
    glm::dvec3 from;   // unit
    glm::dvec3 to;     // unit
    glm::dvec3 normal; // unit, from x to >= 0 along it
};

// The corner of one of the vertex's own faces.
struct bake_corner {
    glm::dvec3 middle; // unit, in the face
    glm::dvec3 above;  // unit, normal to the face, on the side of the vertex's normal
};

inline bool within_arc(const bake_arc& arc, const glm::dvec3& x)
{
    constexpr double slack = 1e-9;
    return glm::dot(arc.normal, glm::cross(arc.from, x)) >= -slack && glm::dot(arc.normal, glm::cross(x, arc.to)) >= -slack;
}

// The sine of the angle between a direction and the nearest of the arcs; 1 beyond right angles.
inline double clearance_of(const glm::dvec3& r, std::span<const bake_arc> arcs)
{
    double least = 1;
    for (const bake_arc& arc : arcs) {
        const double height = glm::dot(arc.normal, r);
        const glm::dvec3 foot = r - arc.normal * height;
        if (glm::dot(foot, foot) > 1e-12 && within_arc(arc, foot)) {
            least = std::min(least, std::abs(height));
            continue;
        }
        const double cosine = std::max(glm::dot(r, arc.from), glm::dot(r, arc.to));
        if (cosine > 0) {
            least = std::min(least, std::sqrt(std::max(0.0, 1 - cosine * cosine)));
        }
    }
    return least;
}

// Whether the shorter way from a to b crosses none of the arcs.
inline bool connected(const glm::dvec3& a, const glm::dvec3& b, std::span<const bake_arc> arcs)
{
    for (const bake_arc& arc : arcs) {
        const double from = glm::dot(arc.normal, a);
        const double to = glm::dot(arc.normal, b);
        if ((from < 0) == (to < 0)) {
            continue;
        }
        const glm::dvec3 crossing = a * std::abs(to) + b * std::abs(from);
        if (within_arc(arc, crossing)) {
            return false;
        }
    }
    return true;
}

struct bake_start {
    glm::dvec3 direction{ 0.0 }; // unit
    double clearance = 0;        // sine of the angle to what is nearest
};

inline glm::dvec3 just_above(const bake_corner& corner, double angle)
{
    return glm::normalize(corner.middle + corner.above * angle);
}

// The direction above the corner, between its face and what comes first over it, that is clearest.
inline bake_start above_corner(const bake_corner& corner, double least_angle, std::span<const bake_arc> arcs)
{
    constexpr double degree = 0.017453292519943295;
    constexpr std::array angles{ 90.0, 60.0, 45.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5 };
    const auto at = [&](double angle) {
        return corner.middle * std::cos(angle * degree) + corner.above * std::sin(angle * degree);
    };
    const glm::dvec3 lowest = just_above(corner, least_angle);
    bake_start best;
    for (const double angle : angles) {
        const glm::dvec3 r = at(angle);
        const double clearance = clearance_of(r, arcs);
        if (clearance > best.clearance && connected(lowest, r, arcs)) {
            best = { r, clearance };
        }
    }
    return best;
}

// The normal itself where it is clear and reached from one of the corners, else the clearest direction above a corner.
inline bake_start start_of(const glm::dvec3& normal, std::span<const bake_corner> corners, std::span<const bake_arc> arcs)
{
    constexpr double clear = 0.1;
    constexpr std::size_t most = 32; // corners looked at, of vertices with thousands
    const std::span<const bake_corner> some = corners.first(std::min(corners.size(), most));
    const double upright = clearance_of(normal, arcs);
    // Radians above a corner at which its region is told from what lies over it: but for surfaces that double its face, and
    // are off it by rounding, any will do.
    for (const double least_angle : { 1e-6, 4e-3 }) {
        if (upright >= clear) {
            for (const bake_corner& corner : some) {
                if (connected(just_above(corner, least_angle), normal, arcs)) {
                    return { normal, upright };
                }
            }
        }
        bake_start best;
        for (const bake_corner& corner : some) {
            const bake_start start = above_corner(corner, least_angle, arcs);
            const auto key = [](const glm::dvec3& v) { return std::array{ v.x, v.y, v.z }; };
            if (start.clearance > best.clearance ||
                (start.clearance == best.clearance && key(start.direction) < key(best.direction))) {
                best = start;
            }
        }
        if (best.clearance > 0) {
            return best;
        }
    }
    return { normal, upright };
}

// What a start is moved by along its direction.
inline double lift_of(const bake_start& start)
{
    return bake_clearance / std::max(start.clearance, 1.0 / 32);
}

// Appends what a triangle with corners at these offsets from the vertex is, seen from it: nothing where it is too far, or too
// small to have a direction. The arc of a corner at the vertex is one; beyond an edge or around the vertex there are more.
inline void append_arcs(const std::array<glm::dvec3, 3>& offsets, std::vector<bake_arc>& arcs)
{
    const glm::dvec3 product = glm::cross(offsets[1] - offsets[0], offsets[2] - offsets[0]);
    const double twice_area = glm::length(product);
    if (!(twice_area > 0)) {
        return;
    }
    const glm::dvec3 normal = product / twice_area;
    const auto add = [&](const glm::dvec3& from, const glm::dvec3& to) {
        arcs.push_back({ glm::normalize(from), glm::normalize(to), normal });
    };
    int at_vertex = -1;
    for (int i = 0; i < 3; ++i) {
        if (glm::length(offsets[static_cast<std::size_t>(i)]) <= bake_clearance) {
            if (at_vertex >= 0) {
                return;
            }
            at_vertex = i;
        }
    }
    const auto corner = [&](int i) { return offsets[static_cast<std::size_t>(i % 3)]; };
    if (at_vertex >= 0) {
        add(corner(at_vertex + 1), corner(at_vertex + 2));
        return;
    }
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 along = corner(i + 1) - corner(i);
        const double place = -glm::dot(corner(i), along) / glm::dot(along, along);
        if (place > 0 && place < 1 && glm::length(corner(i) + along * place) <= bake_clearance) {
            add(corner(i + 1), corner(i + 2));
            add(corner(i + 2), corner(i));
            return;
        }
    }
    if (std::abs(glm::dot(normal, corner(0))) > bake_clearance) {
        return;
    }
    for (int i = 0; i < 3; ++i) {
        if (glm::dot(normal, glm::cross(corner(i), corner(i + 1))) < 0) {
            return;
        }
    }
    for (int i = 0; i < 3; ++i) {
        add(corner(i), corner(i + 1));
    }
}

} // namespace ao::detail
