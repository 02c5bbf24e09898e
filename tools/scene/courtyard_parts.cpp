#include "courtyard_parts.hpp"

#include "sequence.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace ao::tools::parts {
namespace {

constexpr float half_turn = 3.14159265f;

glm::vec3 direction(dice& d)
{
    const float z = d.between(-1.0f, 1.0f), angle = d.between(-half_turn, half_turn);
    const float r = std::sqrt(1.0f - z * z);
    return { r * std::cos(angle), z, r * std::sin(angle) };
}

void leaf_facing(mesh_builder& m, dice& d, const glm::vec3& stem, const glm::vec3& outward)
{
    const glm::vec3 any = direction(d);
    const glm::vec3 across = glm::normalize(glm::cross(outward, any) + glm::vec3(1.0e-3f));
    const glm::vec3 along = glm::normalize(glm::cross(across, outward) + d.between(0.0f, 0.6f) * outward);
    const float size = d.between(0.07f, 0.13f);
    leaf(m, stem, size * along, 0.6f * size * across);
}

} // namespace

float dice::operator()()
{
    state += 0x9e3779b9u;
    return unit_float(mix_bits(state));
}

void column(mesh_builder& m, const glm::vec3& foot, float radius, float height)
{
    const float r = radius;
    const float plinth = 0.5f * r, abacus = 0.35f * r, shaft_low = 1.35f * r, shaft_high = height - 1.3f * r;
    m.box(foot + glm::vec3(-1.45f * r, 0.0f, -1.45f * r), foot + glm::vec3(1.45f * r, plinth, 1.45f * r));
    m.box(foot + glm::vec3(-1.4f * r, height - abacus, -1.4f * r), foot + glm::vec3(1.4f * r, height, 1.4f * r));

    std::vector<outline_point> outline;
    const auto torus = [&](float centre, float middle, float thickness) {
        for (int i = 0; i <= 6; ++i) {
            const float angle = half_turn * (static_cast<float>(i) / 6.0f - 0.5f);
            outline.push_back({ middle + thickness * std::cos(angle), centre + thickness * std::sin(angle) });
        }
    };
    torus(plinth + 0.22f * r, 1.18f * r, 0.22f * r);
    outline.push_back({ 1.14f * r, plinth + 0.5f * r });
    torus(plinth + 0.65f * r, 1.06f * r, 0.13f * r);
    for (int i = 0; i <= 8; ++i) {
        const float t = static_cast<float>(i) / 8.0f;
        outline.push_back({ r * (1.0f - 0.16f * t * t), shaft_low + t * (shaft_high - shaft_low) });
    }
    torus(shaft_high + 0.09f * r, 0.86f * r, 0.08f * r);
    for (int i = 0; i <= 5; ++i) {
        const float angle = half_turn / 2.0f * static_cast<float>(i) / 5.0f;
        outline.push_back({ r * (0.88f + 0.45f * (1.0f - std::cos(angle))), shaft_high + r * (0.2f + 0.75f * std::sin(angle)) });
    }
    m.lathe(foot, outline, 24);
}

void arches(mesh_builder& m, float x, float thickness, float z_low, float z_high, float spring, float top, float half, int count)
{
    constexpr int steps = 20;
    const float near = x - thickness, far = x + thickness;
    const float pitch = (z_high - z_low) / static_cast<float>(count);
    const auto at = [](float px, float y, float z) { return glm::vec3(px, y, z); };

    for (int i = 0; i < count; ++i) {
        const float start = z_low + pitch * static_cast<float>(i), centre = start + pitch / 2.0f, end = start + pitch;
        const auto flank = [&](float a, float b) {
            m.quad(at(far, spring, b), at(far, spring, a), at(far, top, a), at(far, top, b));
            m.quad(at(near, spring, a), at(near, spring, b), at(near, top, b), at(near, top, a));
            m.quad(at(near, spring, a), at(far, spring, a), at(far, spring, b), at(near, spring, b));
        };
        flank(start, centre - half);
        flank(centre + half, end);
        for (int k = 0; k < steps; ++k) {
            const float a = half_turn * static_cast<float>(k) / steps, b = half_turn * static_cast<float>(k + 1) / steps;
            const float za = centre - half * std::cos(a), zb = centre - half * std::cos(b);
            const float ya = spring + half * std::sin(a), yb = spring + half * std::sin(b);
            m.quad(at(far, yb, zb), at(far, ya, za), at(far, top, za), at(far, top, zb));
            m.quad(at(near, ya, za), at(near, yb, zb), at(near, top, zb), at(near, top, za));
        }
        m.sheet(
            [&](float u, float v) {
                return at(near + u * (far - near), spring + half * std::sin(half_turn * v),
                          centre - half * std::cos(half_turn * v));
            },
            1, steps);
    }
    m.quad(at(near, top, z_high), at(far, top, z_high), at(far, top, z_low), at(near, top, z_low));
    m.quad(at(near, spring, z_high), at(far, spring, z_high), at(far, top, z_high), at(near, top, z_high));
    m.quad(at(far, spring, z_low), at(near, spring, z_low), at(near, top, z_low), at(far, top, z_low));
}

void railing(mesh_builder& m, const glm::vec3& from, const glm::vec3& to, float height)
{
    const glm::vec3 up{ 0.0f, 1.0f, 0.0f };
    const float length = glm::length(to - from);
    const auto at = [&](float distance) { return from + (to - from) * (distance / length); };

    m.bar(from + up * height, to + up * height, 0.03f, 10);
    m.bar(from + up * 0.12f, to + up * 0.12f, 0.0125f, 8);
    const int posts = std::max(1, static_cast<int>(length / 1.6f));
    for (int i = 0; i <= posts; ++i) {
        const glm::vec3 foot = at(length * static_cast<float>(i) / static_cast<float>(posts));
        m.bar(foot, foot + up * (height + 0.02f), 0.03f, 10);
        m.turned_box(foot + up * (height + 0.05f), glm::vec3(0.045f, 0.03f, 0.045f), 0.0f);
    }
    const int bars = static_cast<int>(length / 0.12f);
    for (int i = 1; i < bars; ++i) {
        const glm::vec3 foot = at(length * static_cast<float>(i) / static_cast<float>(bars));
        m.bar(foot + up * 0.12f, foot + up * height, 0.0125f, 6);
    }
}

void crate(mesh_builder& m, const glm::vec3& centre, float side, float yaw)
{
    const float h = side / 2.0f, beam = 0.08f * side;
    const float c = std::cos(glm::radians(yaw)), n = std::sin(glm::radians(yaw));
    const auto part = [&](const glm::vec3& offset, const glm::vec3& half) {
        const glm::vec3 turned(offset.x * c - offset.z * n, offset.y, offset.x * n + offset.z * c);
        m.turned_box(centre + turned, half, yaw);
    };
    part(glm::vec3(0.0f), glm::vec3(h - 0.45f * beam));
    for (const float a : { -1.0f, 1.0f })
        for (const float b : { -1.0f, 1.0f }) {
            const float edge = h - beam;
            part({ a * edge, 0.0f, b * edge }, { beam, h, beam });
            part({ 0.0f, a * edge, b * edge }, { h - 2.0f * beam, beam, beam });
            part({ a * edge, b * edge, 0.0f }, { beam, beam, h - 2.0f * beam });
        }
}

void leaf(mesh_builder& m, const glm::vec3& stem, const glm::vec3& along, const glm::vec3& across)
{
    const glm::vec3 fold = 0.25f * glm::length(across) * glm::normalize(glm::cross(along, across));
    const glm::vec3 middle = stem + 0.5f * along, tip = stem + along;
    constexpr glm::vec2 at_stem{ 0.5f, 1.0f }, at_tip{ 0.5f, 0.0f };
    m.quad({ stem, middle - across + fold, tip, stem + 0.5f * along - 0.02f * across },
           { at_stem, glm::vec2(1.0f, 0.5f), at_tip, glm::vec2(0.51f, 0.5f) });
    m.quad({ stem, stem + 0.5f * along + 0.02f * across, tip, middle + across + fold },
           { at_stem, glm::vec2(0.49f, 0.5f), at_tip, glm::vec2(0.0f, 0.5f) });
}

void shrub(mesh_builder& m, dice& d, const glm::vec3& centre, float radius, int count)
{
    for (int i = 0; i < count; ++i) {
        const glm::vec3 out = direction(d);
        const float depth = std::cbrt(d.between(0.25f, 1.0f));
        leaf_facing(m, d, centre + radius * depth * out, glm::normalize(out + 0.7f * direction(d)));
    }
}

void ivy(mesh_builder& m, dice& d, float x, float side, float z_low, float z_high, float height, int count)
{
    const glm::vec3 out{ side, 0.0f, 0.0f };
    for (int i = 0; i < count; ++i) {
        const float z = d.between(z_low, z_high);
        const float middle = 1.0f - std::abs(2.0f * (z - z_low) / (z_high - z_low) - 1.0f);
        const float reach = height * (0.35f + 0.65f * middle) * (0.85f + 0.15f * std::sin(9.0f * z));
        const float y = reach * (1.0f - std::sqrt(d()));
        const float off = d.between(0.03f, 0.10f);
        leaf_facing(m, d, glm::vec3(x + side * off, y + 0.1f, z), glm::normalize(out + 0.5f * direction(d)));
    }
}

} // namespace ao::tools::parts
