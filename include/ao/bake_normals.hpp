// Vertex normals from faces, weighted by their angles at the vertex (G. Thürmer, C. A. Wüthrich, "Computing vertex normals from
// polygonal facets", 1998), in whole numbers: the same bits whatever order the faces come in.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <vector>

namespace ao {

namespace detail {

struct whole_vector {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;

    // |v| <= 4; 2^22 of them may be added.
    void add(const glm::dvec3& v)
    {
        constexpr double one = 549755813888.0; // 2^39
        x += std::llround(v.x * one);
        y += std::llround(v.y * one);
        z += std::llround(v.z * one);
    }
    // Unit length, or 0.
    glm::dvec3 direction() const
    {
        const glm::dvec3 v(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        const double length = glm::length(v);
        return length > 1024 ? v / length : glm::dvec3(0.0);
    }
};

inline double angle_between(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Of a triangle, unit length, or 0 where it has no area. Offsets first: edges of far-off and of tiny triangles keep their digits.
inline glm::dvec3 face_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    glm::dvec3 along = b - a;
    glm::dvec3 across = c - a;
    const auto largest = [](const glm::dvec3& v) { return std::max({ std::abs(v.x), std::abs(v.y), std::abs(v.z) }); };
    const double size = std::max(largest(along), largest(across));
    if (!(size > 0) || !std::isfinite(size)) {
        return glm::dvec3(0.0);
    }
    const int exponent = -std::ilogb(size);
    const auto scaled = [&](glm::dvec3& v) {
        v = { std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent) };
    };
    scaled(along);
    scaled(across);
    const glm::dvec3 product = glm::cross(along, across);
    const double length = glm::length(product);
    return length > 0 ? product / length : glm::dvec3(0.0);
}

} // namespace detail

// A mesh whose vertices are split along sharp edges.
struct split_mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> source; // vertex of the input
};

// Gives every corner the mean normal of those faces at its place (welded by equal positions) that differ from its own face by
// `crease_degrees` at most, and splits vertices where corners differ: 0 splits all but flat edges, 180 none. Faces without area
// keep their corners, with normal 0.
// Precondition: every index is below positions.size(), and there are whole triangles of them.
inline split_mesh split_by_crease(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> indices,
                                  double crease_degrees)
{
    const std::size_t faces = indices.size() / 3;
    std::map<std::array<double, 3>, std::uint32_t> places;
    std::vector<std::uint32_t> place(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3& p = positions[i];
        const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        place[i] = finite ? places.try_emplace({ p.x + 0.0, p.y + 0.0, p.z + 0.0 }, static_cast<std::uint32_t>(i)).first->second
                          : static_cast<std::uint32_t>(i);
    }
    std::vector<glm::dvec3> normals(faces);
    std::vector<std::vector<std::uint32_t>> corners(positions.size());
    for (std::size_t f = 0; f < faces; ++f) {
        normals[f] = detail::face_normal(positions[indices[3 * f]], positions[indices[3 * f + 1]], positions[indices[3 * f + 2]]);
        for (std::size_t k = 0; k < 3; ++k) {
            corners[place[indices[3 * f + k]]].push_back(static_cast<std::uint32_t>(3 * f + k));
        }
    }
    const double least = std::cos(std::clamp(crease_degrees, 0.0, 180.0) * std::numbers::pi / 180) - 1e-9;
    split_mesh split;
    split.indices.resize(3 * faces);
    std::map<std::array<double, 4>, std::uint32_t> made;
    for (std::size_t i = 0; i < 3 * faces; ++i) {
        const std::uint32_t vertex = indices[i];
        const glm::dvec3& own = normals[i / 3];
        detail::whole_vector sum;
        for (const std::uint32_t other : corners[place[vertex]]) {
            const glm::dvec3& normal = normals[other / 3];
            if (glm::dot(own, own) > 0 && glm::dot(own, normal) >= least && glm::dot(normal, normal) > 0) {
                const std::size_t first = other - other % 3;
                const glm::dvec3& p = positions[indices[other]];
                sum.add(normal * detail::angle_between(positions[indices[first + (other + 1) % 3]] - p,
                                                       positions[indices[first + (other + 2) % 3]] - p));
            }
        }
        const glm::vec3 normal(sum.direction());
        const auto next = static_cast<std::uint32_t>(split.positions.size());
        const auto [at, added] = made.try_emplace({ static_cast<double>(vertex), static_cast<double>(normal.x),
                                                    static_cast<double>(normal.y), static_cast<double>(normal.z) },
                                                  next);
        if (added) {
            split.positions.push_back(positions[vertex]);
            split.normals.push_back(normal);
            split.source.push_back(vertex);
        }
        split.indices[i] = at->second;
    }
    return split;
}

} // namespace ao
