#include "tangents.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ao::tools {
namespace {

struct direction {
    glm::dvec3 along{ 0.0 };
    int handedness = 0; // 0: the triangle has no area in the picture
};

// With v turned up.
direction direction_of(const scene& s, const glm::uvec3& t, const glm::dvec3& up)
{
    const glm::dvec3 a = s.positions[t.x];
    const glm::dvec3 ab = glm::dvec3(s.positions[t.y]) - a, ac = glm::dvec3(s.positions[t.z]) - a;
    const glm::dvec2 uv = s.uvs[t.x];
    const glm::dvec2 b = glm::dvec2(s.uvs[t.y]) - uv, c = glm::dvec2(s.uvs[t.z]) - uv;
    const double area = c.x * b.y - b.x * c.y;
    const glm::dvec3 along = (area < 0.0 ? 1.0 : -1.0) * (c.y * ab - b.y * ac);
    const double length = glm::length(along);
    if (area == 0.0 || !(length > 0.0) || !std::isfinite(length))
        return {};
    const double front = glm::dot(glm::cross(ab, ac), up);
    return { along / length, (area < 0.0) == (front < 0.0) ? 1 : -1 };
}

glm::dvec3 flat(const glm::dvec3& v, const glm::dvec3& normal)
{
    const glm::dvec3 across = v - glm::dot(v, normal) * normal;
    const double length = glm::length(across);
    return length > 0.0 ? across / length : glm::dvec3(0.0);
}

double angle(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

struct sums {
    std::array<glm::dvec3, 2> along{ glm::dvec3(0.0), glm::dvec3(0.0) }; // of handedness -1, +1
    std::array<bool, 2> used{};
    std::uint32_t twin = 0; // the vertex of handedness -1 where there are both
};

} // namespace

glm::vec3 any_across(const glm::vec3& normal)
{
    const glm::vec3 helper = std::abs(normal.x) < 0.5f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    return glm::normalize(helper - glm::dot(helper, normal) * normal);
}

void add_tangents(scene& s, std::size_t first_vertex, std::size_t first_triangle)
{
    std::vector<sums> vertices(s.positions.size() - first_vertex);
    std::vector<direction> directions;
    directions.reserve(s.triangles.size() - first_triangle);
    for (std::size_t t = first_triangle; t < s.triangles.size(); ++t) {
        const glm::uvec3 corners = s.triangles[t];
        const glm::dvec3 up =
            glm::dvec3(s.normals[corners.x]) + glm::dvec3(s.normals[corners.y]) + glm::dvec3(s.normals[corners.z]);
        const direction& d = directions.emplace_back(direction_of(s, corners, up));
        if (d.handedness == 0)
            continue;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t v = corners[i];
            const glm::dvec3 normal = s.normals[v], here = s.positions[v];
            const glm::dvec3 next = flat(glm::dvec3(s.positions[corners[(i + 1) % 3]]) - here, normal);
            const glm::dvec3 last = flat(glm::dvec3(s.positions[corners[(i + 2) % 3]]) - here, normal);
            sums& sum = vertices[v - first_vertex];
            const std::size_t side = d.handedness > 0 ? 1 : 0;
            sum.along[side] += angle(next, last) * flat(d.along, normal);
            sum.used[side] = true;
        }
    }

    const std::size_t count = vertices.size();
    const auto tangent = [&](std::size_t i, std::size_t side) {
        const glm::vec3 normal = s.normals[first_vertex + i];
        const double length = glm::length(vertices[i].along[side]);
        const glm::vec3 along = length > 1.0e-9 ? glm::vec3(vertices[i].along[side] / length) : any_across(normal);
        return glm::vec4(along, side == 1 ? 1.0f : -1.0f);
    };
    for (std::size_t i = 0; i < count; ++i)
        s.tangents.push_back(tangent(i, vertices[i].used[1] || !vertices[i].used[0] ? 1 : 0));
    for (std::size_t i = 0; i < count; ++i) {
        if (!vertices[i].used[0] || !vertices[i].used[1])
            continue;
        const std::size_t v = first_vertex + i;
        vertices[i].twin = static_cast<std::uint32_t>(s.positions.size());
        s.positions.push_back(glm::vec3(s.positions[v]));
        s.normals.push_back(glm::vec3(s.normals[v]));
        s.uvs.push_back(glm::vec2(s.uvs[v]));
        s.tangents.push_back(tangent(i, 0));
    }
    for (std::size_t t = first_triangle; t < s.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const sums& sum = vertices[s.triangles[t][i] - first_vertex];
            if (directions[t - first_triangle].handedness < 0 && sum.twin != 0)
                s.triangles[t][i] = sum.twin;
        }
}

} // namespace ao::tools
