// Clipping in homogeneous coordinates.
#pragma once

#include "raster_view.hpp"

#include <glm/vec4.hpp>

#include <array>
#include <cstddef>

namespace ao::cpu {

// Convex, in the order of the triangle's corners.
struct clipped_polygon {
    std::array<glm::vec4, 9> corners; // each of six planes adds one at most
    std::size_t count = 0;
};

// The part of a triangle between the near and the far plane and in the guard band. An edge is cut at the same point whichever
// triangle it belongs to. Precondition: finite corners.
clipped_polygon clip_triangle(const raster_view& v, const std::array<glm::vec4, 3>& corners);

} // namespace ao::cpu
