#include "scene.hpp"

#include "error.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace ao::tools {
namespace {

bool finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

void check(const scene& s)
{
    if (s.triangles.empty())
        throw error(s.name + ": no triangles");
    if (s.normals.size() != s.positions.size() || s.object.size() != s.triangles.size() ||
        s.material.size() != s.triangles.size())
        throw error(s.name + ": arrays of different lengths");

    for (std::size_t i = 0; i < s.positions.size(); ++i) {
        const std::string vertex = s.name + ": vertex " + std::to_string(i);
        if (!finite(s.positions[i]))
            throw error(vertex + ": position is not finite");
        const glm::vec3 size = glm::abs(s.positions[i]);
        if (std::max(size.x, std::max(size.y, size.z)) > largest_coordinate)
            throw error(vertex + ": coordinate beyond 1e18");
        if (!finite(s.normals[i]))
            throw error(vertex + ": normal is not finite");
        if (std::abs(glm::length(s.normals[i]) - 1.0f) > 1.0e-3f)
            throw error(vertex + ": normal is not of unit length");
    }
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        const std::string triangle = s.name + ": triangle " + std::to_string(t);
        for (int corner = 0; corner < 3; ++corner)
            if (s.triangles[t][corner] >= s.positions.size())
                throw error(triangle + ": index " + std::to_string(s.triangles[t][corner]) + " out of range, " +
                            std::to_string(s.positions.size()) + " vertices");
        if (s.object[t] >= s.object_names.size() || s.material[t] >= s.material_names.size())
            throw error(triangle + ": object or material out of range");
    }
}

bounds bounds_of(const scene& s)
{
    const glm::vec3 first = s.positions[s.triangles.front().x];
    bounds b{ first, first };
    for (const glm::uvec3& t : s.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            b.low = glm::min(b.low, s.positions[t[corner]]);
            b.high = glm::max(b.high, s.positions[t[corner]]);
        }
    return b;
}

bool degenerate(const scene& s, std::size_t triangle)
{
    const glm::uvec3 t = s.triangles[triangle];
    const glm::dvec3 a = s.positions[t.x];
    const glm::dvec3 b = s.positions[t.y];
    const glm::dvec3 c = s.positions[t.z];
    const glm::dvec3 twice_area = glm::cross(b - a, c - a);
    return !(glm::dot(twice_area, twice_area) > 0.0);
}

std::size_t count_degenerate(const scene& s)
{
    std::size_t count = 0;
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
        count += degenerate(s, t) ? 1u : 0u;
    return count;
}

} // namespace ao::tools
