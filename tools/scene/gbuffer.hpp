#pragma once

#include "camera.hpp"
#include "ray_tree.hpp"

namespace ao::tools {

inline constexpr std::uint32_t nothing = 0xffffffffu;

// One entry per pixel, row 0 on top. Background: every vector and depth 0, ids `nothing`.
struct gbuffer {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> position;         // view space, on the ray through the pixel's centre
    std::vector<float> depth;                // linear eye depth = -position.z
    std::vector<glm::vec3> normal;           // view space, interpolated over the triangle, unit
    std::vector<glm::vec3> geometric_normal; // view space, the triangle's own, unit, toward the viewer
    std::vector<glm::vec3> world;            // the same point in world space, not by way of the view matrix
    std::vector<std::uint32_t> triangle;
    std::vector<std::uint32_t> object;
    std::vector<std::uint32_t> material; // ao::object::material modulo 2^32
    std::vector<std::uint8_t> hit;       // 1 where there is a surface

    [[nodiscard]] std::size_t size() const { return hit.size(); }
};

// The nearest surface along the ray through each pixel's centre, between near and far. A triangle seen from behind has
// both its normals turned; a shading normal of a triangle seen from the front may still lean away from the viewer.
// Depth is where the ray meets the triangle's plane, in double precision, rounded once.
// Preconditions: s made the tree, passes `check`; 0 < width, height.
[[nodiscard]] gbuffer trace_gbuffer(const scene& s, const ray_tree& tree, const camera& c, const frustum& f, int width,
                                    int height);

} // namespace ao::tools
