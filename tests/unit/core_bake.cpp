// Ambient occlusion per vertex in closed form, by the reference.
#include "core_bake_meshes.hpp"

#include "ao/bake.hpp"
#include "ao/bake_crease.hpp"
#include "ao/conformance/bake_reference.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

using namespace bake_test;

namespace {

ao::bake_result baked(const mesh& m, const ao::bake_settings& settings = {}, int points = 1202)
{
    const auto rule = ao::lebedev_rule(points);
    const auto job = ao::prepare_bake(m.input(), *rule, settings);
    INFO((job ? std::string() : std::string(job.error().reason())));
    REQUIRE(job);
    return ao::finish_bake(*job, *ao::bake_reference(*job));
}

constexpr ao::bake_settings by_cosine{ .coefficient = ao::bake_coefficient::cosine };

} // namespace

TEST_CASE("convex meshes are open everywhere, exactly", "[bake]")
{
    const mesh shape = GENERATE(sphere({ 0, 0, 0 }, 1, 2), box({ -1, -2, -3 }, { 1, 2, 3 }, 2, false),
                                welded(box({ -1, -2, -3 }, { 1, 2, 3 }, 2, false)), sphere({ 100, 7, 3 }, 0.01, 1));
    for (const ao::bake_settings& settings : { ao::bake_settings{}, by_cosine }) {
        const ao::bake_result r = baked(shape, settings, 302);
        CHECK(std::all_of(r.coefficients.begin(), r.coefficients.end(), [](float c) { return c == 1; }));
        CHECK(std::all_of(r.errors.begin(), r.errors.end(), [](float e) { return e > 0 && e < 1e-2F; }));
        CHECK(r.report.enclosed == 0);
    }
}

TEST_CASE("walls through a vertex block what is behind them: the joints of a room of three grids", "[bake]")
{
    constexpr int cells = 10;
    mesh room;
    append(room, grid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, cells));
    append(room, grid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, cells));
    append(room, grid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, cells));
    // Half of the half sphere is behind a wall; of the rest the other wall, a unit square at distance a, hides the solid angle
    // atan(1 / (a sqrt(a^2 + 2))).
    const auto exact = [](double a) { return 0.5 - std::atan(1 / (a * std::sqrt(a * a + 2))) / (2 * std::numbers::pi); };
    const bool shared = GENERATE(false, true);
    const mesh m = shared ? welded(room) : room;
    const auto rule = ao::lebedev_rule(5810);
    const auto job = ao::prepare_bake(m.input(), *rule, {});
    INFO((job ? std::string() : std::string(job.error().reason())));
    REQUIRE(job);
    double sum = 0;
    double exact_sum = 0;
    int joint = 0;
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        const glm::dvec3& p = m.positions[i];
        const int walls = (p.x == 0) + (p.y == 0) + (p.z == 0);
        const double a = p.x + p.y + p.z;
        if (walls < 2 || a == 1) { // where the wall ends, half of it is missing
            continue;
        }
        const auto sums = ao::bake_vertex_reference(*job, i, 0, job->lines.size());
        const double value = static_cast<double>(sums.open) / sums.all;
        // Of 57 values that scatter by 7.8e-4 one is off by 2.1e-3; 20 000 directions bring all below 6e-4 (docs/numerics.md).
        CHECK(std::abs(value - (walls == 3 ? 0.25 : exact(a))) < (walls == 3 ? 1e-3 : 2.5e-3));
        sum += value;
        exact_sum += walls == 3 ? 0.25 : exact(a);
        ++joint;
    }
    CHECK(std::abs(sum - exact_sum) / joint < 5e-4);
}

namespace {

// A cone of rough ridges around vertex 0.
mesh fan(std::uint32_t faces)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> height(0.0, 3.0 / faces);
    mesh m;
    m.positions.emplace_back(0.0, 0.0, 1.0);
    for (std::uint32_t i = 0; i < faces; ++i) {
        const double angle = 2 * std::numbers::pi * i / faces;
        m.positions.emplace_back(std::cos(angle), std::sin(angle), height(random));
        m.indices.insert(m.indices.end(), { 0, 1 + i, 1 + (i + 1) % faces });
    }
    return m;
}

// The normal of the apex in one face, face by face.
glm::dvec3 apex_normal(const mesh& m, std::size_t face, double degrees)
{
    const auto corner = [&](std::size_t f, std::size_t k) { return m.positions[m.indices[3 * f + k]]; };
    const auto normal = [&](std::size_t f) {
        return glm::normalize(glm::cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0)));
    };
    glm::dvec3 sum(0.0);
    for (std::size_t f = 0; f < m.indices.size() / 3; ++f) {
        if (glm::dot(normal(face), normal(f)) >= std::cos(degrees * std::numbers::pi / 180) - 1e-9) {
            const glm::dvec3 a = glm::normalize(corner(f, 1) - corner(f, 0));
            const glm::dvec3 b = glm::normalize(corner(f, 2) - corner(f, 0));
            sum += normal(f) * std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
        }
    }
    return glm::normalize(sum);
}

} // namespace

TEST_CASE("corners around a vertex of many faces take the faces within the crease angle", "[bake][crease]")
{
    const std::uint32_t faces = GENERATE(7U, 300U, 100000U);
    const double degrees = GENERATE(20.0, 60.0);
    const mesh m = fan(faces);
    const ao::split_mesh split = ao::split_by_crease(m.positions, m.indices, degrees);
    REQUIRE(split.indices.size() == m.indices.size());
    for (std::size_t f = 0; f < faces; f += 1 + faces / 30) {
        const std::uint32_t vertex = split.indices[3 * f];
        CHECK(split.source[vertex] == 0);
        CHECK(glm::distance(glm::dvec3(split.normals[vertex]), apex_normal(m, f, degrees)) < 1e-4);
    }
}
