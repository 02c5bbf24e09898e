// Meshes with known ambient occlusion.
#pragma once

#include "ao/bake.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace bake_test {

struct mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> objects;

    ao::bake_input input() const { return { positions, normals, indices, objects }; }
};

inline void append(mesh& to, const mesh& other)
{
    const auto base = static_cast<std::uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), other.positions.begin(), other.positions.end());
    to.normals.insert(to.normals.end(), other.normals.begin(), other.normals.end());
    for (const std::uint32_t i : other.indices) {
        to.indices.push_back(base + i);
    }
    to.objects.insert(to.objects.end(), other.objects.begin(), other.objects.end());
}

// cells x cells squares from `corner` along two edges; the front is along x y.
inline mesh grid(const glm::dvec3& corner, const glm::dvec3& x, const glm::dvec3& y, int cells)
{
    mesh m;
    const auto side = static_cast<std::uint32_t>(cells + 1);
    const glm::vec3 normal(glm::normalize(glm::cross(x, y)));
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            m.positions.push_back(corner + x * (static_cast<double>(i) / cells) + y * (static_cast<double>(j) / cells));
            m.normals.push_back(normal);
        }
    }
    for (std::uint32_t j = 0; j + 1 < side; ++j) {
        for (std::uint32_t i = 0; i + 1 < side; ++i) {
            const std::uint32_t at = j * side + i;
            m.indices.insert(m.indices.end(), { at, at + 1, at + side + 1, at, at + side + 1, at + side });
        }
    }
    return m;
}

// A box of six grids that look outwards, or inwards.
inline mesh box(const glm::dvec3& low, const glm::dvec3& high, int cells, bool inwards)
{
    mesh m;
    const glm::dvec3 size = high - low;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 x(0.0);
        glm::dvec3 y(0.0);
        glm::dvec3 z(0.0);
        x[(axis + 1) % 3] = size[(axis + 1) % 3];
        y[(axis + 2) % 3] = size[(axis + 2) % 3];
        z[axis] = size[axis];
        append(m, inwards ? grid(low, x, y, cells) : grid(low, y, x, cells));
        append(m, inwards ? grid(low + z, y, x, cells) : grid(low + z, x, y, cells));
    }
    return m;
}

// An icosahedron, its triangles quartered `levels` times, on a sphere; without normals.
inline mesh sphere(const glm::dvec3& centre, double radius, int levels)
{
    const double g = std::numbers::phi;
    std::vector<glm::dvec3> p{ { -1, g, 0 },  { 1, g, 0 },  { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g },  { 0, 1, g },
                               { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 },  { g, 0, 1 },  { -g, 0, -1 }, { -g, 0, 1 } };
    std::vector<std::uint32_t> t{ 0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                  4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                  6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1 };
    for (glm::dvec3& v : p) {
        v = glm::normalize(v);
    }
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, added] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
            if (added) {
                p.push_back(glm::normalize(p[a] + p[b]));
            }
            return at->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t i = 0; i < t.size(); i += 3) {
            const std::uint32_t ab = middle(t[i], t[i + 1]);
            const std::uint32_t bc = middle(t[i + 1], t[i + 2]);
            const std::uint32_t ca = middle(t[i + 2], t[i]);
            finer.insert(finer.end(), { t[i], ab, ca, ab, t[i + 1], bc, ca, bc, t[i + 2], ab, bc, ca });
        }
        t = std::move(finer);
    }
    mesh m;
    for (const glm::dvec3& v : p) {
        m.positions.push_back(centre + v * radius);
    }
    m.indices = std::move(t);
    return m;
}

// With the vertices of a place made one, their normals added.
inline mesh welded(const mesh& from)
{
    mesh m;
    std::map<std::array<double, 3>, std::uint32_t> places;
    std::vector<std::uint32_t> renamed;
    for (std::size_t i = 0; i < from.positions.size(); ++i) {
        const glm::dvec3& p = from.positions[i];
        const auto [at, added] = places.try_emplace({ p.x, p.y, p.z }, static_cast<std::uint32_t>(m.positions.size()));
        if (added) {
            m.positions.push_back(p);
            m.normals.emplace_back(0.0F);
        }
        m.normals[at->second] += from.normals[i];
        renamed.push_back(at->second);
    }
    for (const std::uint32_t i : from.indices) {
        m.indices.push_back(renamed[i]);
    }
    return m;
}

} // namespace bake_test
