#include "mesh_builder.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace ao::tools {
namespace {

constexpr float full_turn = 6.28318531f;
constexpr float sharp = 0.766f; // cosine of 40 degrees

// Upright and not mirrored as seen from outside.
glm::vec2 project(const glm::vec3& p, const glm::vec3& normal)
{
    const glm::vec3 size = glm::abs(normal);
    if (size.y >= size.x && size.y >= size.z)
        return { normal.y < 0.0f ? -p.x : p.x, p.z };
    return { size.x >= size.z ? (normal.x < 0.0f ? p.z : -p.z) : (normal.z < 0.0f ? -p.x : p.x), -p.y };
}

} // namespace

void mesh_builder::begin(std::string_view object, std::string_view material_name, float texture_scale)
{
    scale = texture_scale;
    s.object_names.emplace_back(object);
    const auto found = std::find(s.material_names.begin(), s.material_names.end(), material_name);
    material = static_cast<std::uint32_t>(found - s.material_names.begin());
    if (found == s.material_names.end())
        s.material_names.emplace_back(material_name);
}

std::uint32_t mesh_builder::vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv)
{
    s.positions.push_back(position);
    s.normals.push_back(normal);
    s.uvs.push_back(uv);
    return static_cast<std::uint32_t>(s.positions.size() - 1);
}

void mesh_builder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    s.triangles.push_back({ a, b, c });
    s.object.push_back(static_cast<std::uint32_t>(s.object_names.size() - 1));
    s.material.push_back(material);
}

void mesh_builder::quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d)
{
    const glm::vec3 normal = glm::cross(c - a, d - b);
    quad({ a, b, c, d },
         { scale * project(a, normal), scale * project(b, normal), scale * project(c, normal), scale * project(d, normal) });
}

void mesh_builder::quad(const std::array<glm::vec3, 4>& corners, const std::array<glm::vec2, 4>& uvs)
{
    // By the diagonals, so that one corner may coincide with the next.
    const glm::vec3 normal = glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
    const auto first = static_cast<std::uint32_t>(s.positions.size());
    for (std::size_t i = 0; i < 4; ++i)
        vertex(corners[i], normal, uvs[i]);
    triangle(first, first + 1, first + 2);
    triangle(first, first + 2, first + 3);
}

void mesh_builder::box(const glm::vec3& low, const glm::vec3& high)
{
    turned_box((low + high) / 2.0f, (high - low) / 2.0f, 0.0f);
}

void mesh_builder::turned_box(const glm::vec3& centre, const glm::vec3& half, float yaw)
{
    const float c = std::cos(glm::radians(yaw)), n = std::sin(glm::radians(yaw));
    const glm::vec3 x = half.x * glm::vec3(c, 0.0f, n);
    const glm::vec3 y{ 0.0f, half.y, 0.0f };
    const glm::vec3 z = half.z * glm::vec3(-n, 0.0f, c);
    const auto face = [&](const glm::vec3& out, const glm::vec3& u, const glm::vec3& v) {
        quad(centre + out - u - v, centre + out + u - v, centre + out + u + v, centre + out - u + v);
    };
    face(x, y, z);
    face(-x, z, y);
    face(y, z, x);
    face(-y, x, z);
    face(z, x, y);
    face(-z, y, x);
}

void mesh_builder::slab(const glm::vec3& low, const glm::vec3& high, float bevel)
{
    const auto ring = [&](float y, float inset) {
        return std::array{ glm::vec3(low.x + inset, y, high.z - inset), glm::vec3(high.x - inset, y, high.z - inset),
                           glm::vec3(high.x - inset, y, low.z + inset), glm::vec3(low.x + inset, y, low.z + inset) };
    };
    const auto foot = ring(low.y, 0.0f), edge = ring(high.y - bevel, 0.0f), top = ring(high.y, bevel);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        quad(foot[i], foot[next], edge[next], edge[i]);
        quad(edge[i], edge[next], top[next], top[i]);
    }
    quad(top[0], top[1], top[2], top[3]);
}

void mesh_builder::bar(const glm::vec3& from, const glm::vec3& to, float radius, int sides)
{
    const glm::vec3 along = glm::normalize(to - from);
    const glm::vec3 helper = std::abs(along.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 x = glm::normalize(glm::cross(helper, along));
    const glm::vec3 y = glm::cross(along, x);
    const auto first = static_cast<std::uint32_t>(s.positions.size());
    for (int i = 0; i <= sides; ++i) {
        const float angle = full_turn * static_cast<float>(i) / static_cast<float>(sides);
        const glm::vec3 normal = std::cos(angle) * x + std::sin(angle) * y;
        const float round = scale * radius * angle;
        vertex(from + radius * normal, normal, { round, 0.0f });
        vertex(to + radius * normal, normal, { round, -scale * glm::length(to - from) });
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
        const std::uint32_t a = first + 2 * i;
        triangle(a, a + 2, a + 3);
        triangle(a, a + 3, a + 1);
    }
}

void mesh_builder::lathe(const glm::vec3& foot, std::span<const outline_point> outline, int sides)
{
    const auto normal_of = [&](std::size_t segment) {
        const outline_point &a = outline[segment], &b = outline[segment + 1];
        return glm::normalize(glm::vec3(b.height - a.height, a.radius - b.radius, 0.0f));
    };
    // The end of a segment leans toward its neighbour where the bend is smooth.
    const auto end_normal = [&](std::size_t segment, std::size_t neighbour) {
        const glm::vec3 own = normal_of(segment);
        if (neighbour >= outline.size() - 1) // there is none; before the first it has wrapped around
            return own;
        const glm::vec3 other = normal_of(neighbour);
        return glm::dot(own, other) > sharp ? glm::normalize(own + other) : own;
    };

    float widest = 0.0f;
    for (const outline_point& p : outline)
        widest = std::max(widest, p.radius);
    float along = 0.0f;
    for (std::size_t segment = 0; segment + 1 < outline.size(); ++segment) {
        const float length = glm::length(glm::vec2(outline[segment + 1].radius - outline[segment].radius,
                                                   outline[segment + 1].height - outline[segment].height));
        const glm::vec3 normals[2] = { end_normal(segment, segment - 1), end_normal(segment, segment + 1) };
        const auto first = static_cast<std::uint32_t>(s.positions.size());
        for (int i = 0; i <= sides; ++i) {
            const float angle = full_turn * static_cast<float>(i % sides) / static_cast<float>(sides);
            const float c = std::cos(angle), n = std::sin(angle);
            for (std::size_t end = 0; end < 2; ++end) {
                const outline_point& p = outline[segment + end];
                vertex(foot + glm::vec3(p.radius * c, p.height, -p.radius * n),
                       glm::vec3(normals[end].x * c, normals[end].y, -normals[end].x * n),
                       scale * glm::vec2(widest * full_turn * static_cast<float>(i) / static_cast<float>(sides),
                                         end == 0 ? -along : -along - length));
            }
        }
        along += length;
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
            const std::uint32_t a = first + 2 * i;
            if (outline[segment].radius > 0.0f)
                triangle(a, a + 2, a + 3);
            if (outline[segment + 1].radius > 0.0f)
                triangle(a, a + 3, a + 1);
        }
    }
}

void mesh_builder::sheet(const std::function<glm::vec3(float u, float v)>& surface, int columns, int rows)
{
    constexpr float step = 1.0e-3f;
    const auto first = static_cast<std::uint32_t>(s.positions.size());
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const float u = static_cast<float>(column) / static_cast<float>(columns);
            const float v = static_cast<float>(row) / static_cast<float>(rows);
            const glm::vec3 du = surface(u + step, v) - surface(u - step, v);
            const glm::vec3 dv = surface(u, v + step) - surface(u, v - step);
            vertex(surface(u, v), glm::normalize(glm::cross(du, dv)), scale * glm::vec2(u, 1.0f - v));
        }
    const auto stride = static_cast<std::uint32_t>(columns + 1);
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row)
        for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column) {
            const std::uint32_t a = first + row * stride + column;
            triangle(a, a + 1, a + stride + 1);
            triangle(a, a + stride + 1, a + stride);
        }
}

} // namespace ao::tools
