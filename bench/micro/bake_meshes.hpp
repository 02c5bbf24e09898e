// Meshes that bakes are measured on.
#pragma once

#include "micro/measure.hpp"
#include "unit/core_bake_meshes.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

namespace ao::bench {

using plain_mesh = bake_test::mesh;

// A tube around a trefoil, which hides much of itself.
inline plain_mesh knot(int along, int around)
{
    plain_mesh m;
    const auto centre = [](double t) {
        return glm::dvec3(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t));
    };
    for (int i = 0; i < along; ++i) {
        const double t = 2 * std::numbers::pi * i / along;
        const glm::dvec3 tangent = glm::normalize(centre(t + 1e-4) - centre(t - 1e-4));
        const glm::dvec3 side = glm::normalize(glm::cross(tangent, glm::dvec3(0, 0, 1)));
        const glm::dvec3 up = glm::cross(side, tangent);
        for (int j = 0; j < around; ++j) {
            const double a = 2 * std::numbers::pi * j / around;
            const double r = 0.7 + 0.1 * std::sin(9 * t + 3 * a);
            m.positions.push_back(centre(t) + r * (std::cos(a) * side + std::sin(a) * up));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % along) * around + j % around); };
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < around; ++j) {
            m.indices.insert(m.indices.end(), { at(i, j), at(i + 1, j + 1), at(i, j + 1) });
            m.indices.insert(m.indices.end(), { at(i, j), at(i + 1, j), at(i + 1, j + 1) });
        }
    }
    return m;
}

// A sphere with bumps upon bumps.
inline plain_mesh rough_ball(int levels)
{
    plain_mesh m = bake_test::sphere({ 0, 0, 0 }, 1, levels);
    for (glm::dvec3& p : m.positions) {
        double height = 1;
        for (double f = 3; f < 40; f *= 2) {
            height += 0.25 / f * 3 * std::sin(f * p.x + 1) * std::sin(f * p.y + 2) * std::sin(f * p.z + 3);
        }
        p *= height;
    }
    return m;
}

// ASCII PLY: x y z first of each vertex, triangles.
inline plain_mesh read_ply(const std::string& file)
{
    std::ifstream in(file);
    std::string line;
    std::size_t vertices = 0;
    std::size_t faces = 0;
    while (std::getline(in, line) && line.rfind("end_header", 0) != 0) {
        std::istringstream words(line);
        std::string first;
        std::string second;
        std::size_t number = 0;
        words >> first >> second >> number;
        (second == "vertex" ? vertices : second == "face" ? faces : number) = number;
    }
    plain_mesh m;
    for (std::size_t i = 0; i < vertices && std::getline(in, line); ++i) {
        std::istringstream words(line);
        glm::dvec3 p(0.0);
        words >> p.x >> p.y >> p.z;
        m.positions.push_back(p);
    }
    for (std::size_t i = 0; i < faces && std::getline(in, line); ++i) {
        std::istringstream words(line);
        std::uint32_t corners = 0;
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        std::uint32_t c = 0;
        words >> corners >> a >> b >> c;
        m.indices.insert(m.indices.end(), { a, b, c });
    }
    if (m.indices.empty()) {
        stop(file + " is no ASCII PLY of triangles");
    }
    return m;
}

} // namespace ao::bench
