#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ao::tools {

struct bounds {
    glm::vec3 low;
    glm::vec3 high;
};

// Indexed triangles in world space, right-handed, in the model's own unit of length. Both sides of a triangle are surface.
struct scene {
    std::string name;

    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // one per position, unit

    std::vector<glm::uvec3> triangles; // indices into positions
    std::vector<std::uint32_t> object; // one per triangle, index into object_names
    std::vector<std::uint32_t> material;

    std::vector<std::string> object_names;
    std::vector<std::string> material_names;
};

// Coordinates beyond this make Embree drop a triangle without a word, and their squares come near the end of float.
inline constexpr float largest_coordinate = 1.0e18f;

// Throws `error`, naming the first vertex or triangle at fault: nothing to show, a position or normal not finite,
// a position beyond largest_coordinate, a normal not of unit length (1e-3), an index out of range.
void check(const scene& s);

// Of the vertices that triangles use. Precondition: at least one triangle.
[[nodiscard]] bounds bounds_of(const scene& s);

// No area: equal corners, or corners on one line as far as double can tell.
[[nodiscard]] bool degenerate(const scene& s, std::size_t triangle);
[[nodiscard]] std::size_t count_degenerate(const scene& s);

} // namespace ao::tools
