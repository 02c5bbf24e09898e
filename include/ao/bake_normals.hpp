// Vertex normals from faces, weighted by their angles at the vertex (G. Thürmer, C. A. Wüthrich, "Computing vertex normals from
// polygonal facets", 1998), in whole numbers: the same bits whatever order the faces come in.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

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

} // namespace ao
