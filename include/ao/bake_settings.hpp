// What a user of ambient occlusion per vertex chooses (paper 3), and whether it makes sense.
#pragma once

#include "ao/result.hpp"

#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace ao {

// uniform: share of the half sphere about the normal that is open. cosine: the same, weighted by the cosine to the normal.
// Both are divided by what the same rule gives where nothing occludes, so that open vertices are exactly 1.
enum class bake_coefficient { uniform, cosine };

// How much an occluder at distance t takes away within the greatest distance R: all of it, 1 - t / R, or 1 - smoothstep(t / R).
enum class bake_falloff { none, linear, smooth };

// front: faces occlude only what they turn their front to (corners counter-clockwise); for closed meshes.
enum class bake_sides { both, front };

enum class bake_occluders { all, own_object, other_objects };

// How visibility is found. All but `embree` and `cube` give the same bits; a backend may not have all of them.
enum class bake_route {
    automatic,
    brute,     // every direction of a vertex against every triangle
    tiled,     // brute, triangles shared by a group (GPU)
    packed,    // brute, visibility one bit per ray (GPU)
    hierarchy, // rays through a tree of boxes
    raster,    // direction by direction, all vertices against the triangles that cover them
    embree,    // rays by Embree, packets of sorted directions
    cube,      // a cube map of depths around each vertex (GPU)
};

struct bake_settings {
    bake_coefficient coefficient = bake_coefficient::uniform;
    // Occluders farther away do not count; in diagonals of the box around all faces, greater than 0.
    double distance = std::numeric_limits<double>::infinity();
    bake_falloff falloff = bake_falloff::none; // others need a finite distance
    bake_sides sides = bake_sides::both;
    bake_occluders occluders = bake_occluders::all;
    bool bent_normals = false; // the mean open direction of each vertex as well
    bool own_normals = true;   // of the input where it has them; else computed from faces
    // An infinite plane that occludes all directions down to it; vertices below count as lying on it.
    bool ground = false;
    glm::dvec3 ground_up{ 0.0, 1.0, 0.0 }; // any length but 0
    double ground_height = 0;              // along ground_up, model units
    // Turns the rule at every vertex by a rotation of its own: banding becomes noise. Not by raster.
    bool rotate_per_vertex = false;
    std::uint32_t seed = 1; // of these rotations
    bake_route route = bake_route::automatic;
};

// The first thing wrong with the settings, or nothing.
inline std::optional<error> validate(const bake_settings& s)
{
    const auto fail = [](const char* why) { return error(errc::invalid_settings, why); };
    if (s.coefficient < bake_coefficient::uniform || s.coefficient > bake_coefficient::cosine) {
        return fail("unknown coefficient");
    }
    if (!(s.distance > 0)) {
        return fail("distance must be greater than 0");
    }
    if (s.falloff < bake_falloff::none || s.falloff > bake_falloff::smooth) {
        return fail("unknown fall-off");
    }
    if (s.falloff != bake_falloff::none && !(s.distance < std::numeric_limits<double>::infinity())) {
        return fail("a fall-off needs a finite distance");
    }
    if (s.sides < bake_sides::both || s.sides > bake_sides::front) {
        return fail("unknown sides");
    }
    if (s.occluders < bake_occluders::all || s.occluders > bake_occluders::other_objects) {
        return fail("unknown occluders");
    }
    if (s.ground) {
        const double squared = s.ground_up.x * s.ground_up.x + s.ground_up.y * s.ground_up.y + s.ground_up.z * s.ground_up.z;
        if (!(squared > 0 && squared < std::numeric_limits<double>::infinity()) || !std::isfinite(s.ground_height)) {
            return fail("the ground needs an upward direction and a height that are finite, and the direction not 0");
        }
    }
    if (s.route < bake_route::automatic || s.route > bake_route::cube) {
        return fail("unknown route");
    }
    if (s.rotate_per_vertex && s.route == bake_route::raster) {
        return fail("the raster route takes one rule for all vertices: no rotation per vertex");
    }
    return std::nullopt;
}

} // namespace ao
