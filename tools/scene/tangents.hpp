#pragma once

#include "scene.hpp"

namespace ao::tools {

// Tangents of the vertices from `first_vertex` on, which the triangles from `first_triangle` on use: of each triangle the
// direction in which u grows, along the vertex's tangent plane, weighted by the angle there, as MikkTSpace does (Mikkelsen,
// Simulation of Wrinkled Surfaces Revisited, 2008). Where triangles of a vertex differ in handedness it becomes two, the new
// one at the end. Triangles without an area in the picture go with their neighbours. Vertices of no direction get any tangent.
// Preconditions: s.tangents.size() == first_vertex; uvs are finite and as many as positions.
void add_tangents(scene& s, std::size_t first_vertex, std::size_t first_triangle);

// A unit vector across `normal`, which is a unit vector.
[[nodiscard]] glm::vec3 any_across(const glm::vec3& normal);

} // namespace ao::tools
