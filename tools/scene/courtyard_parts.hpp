#pragma once

#include "mesh_builder.hpp"

namespace ao::tools::parts {

// Numbers 0..1 that are the same on every machine, unlike those of <random>'s distributions.
class dice {
public:
    explicit dice(std::uint32_t seed) : state(seed) {}
    float operator()();
    float between(float low, float high) { return low + (high - low) * (*this)(); }

private:
    std::uint32_t state;
};

// Plinth, base, swelling shaft, capital, abacus; its whole height is `height`, the shaft's radius below `radius`.
void column(mesh_builder& m, const glm::vec3& foot, float radius, float height);

// A wall along z at x with a semicircular arch of half width `half` over each centre, springing at `spring`;
// from `z_low` to `z_high`, `bottom` to `top`, `thickness` to both sides. Open below the springing line.
void arches(mesh_builder& m, float x, float thickness, float z_low, float z_high, float spring, float top, float half, int count);

// Posts, two rails and thin bars between, along a straight line on the ground.
void railing(mesh_builder& m, const glm::vec3& from, const glm::vec3& to, float height);

// A board crate with frame and sunken sides.
void crate(mesh_builder& m, const glm::vec3& centre, float side, float yaw);

// One leaf card: a quadrilateral folded along its middle, two sided.
void leaf(mesh_builder& m, const glm::vec3& stem, const glm::vec3& along, const glm::vec3& across);

// `count` leaves in a ball, looking outward more or less.
void shrub(mesh_builder& m, dice& d, const glm::vec3& centre, float radius, int count);

// Leaves on a vertical wall of constant x, grown from the ground up; `side` is +1 or -1, the wall's outside along x.
void ivy(mesh_builder& m, dice& d, float x, float side, float z_low, float z_high, float height, int count);

} // namespace ao::tools::parts
