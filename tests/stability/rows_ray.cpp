// 4.9: rays of bakes per vertex, and poison in their meshes.
#include "stability/figure.hpp"
#include "stability/row.hpp"

#include "ao/conformance/bake_reference.hpp"
#include "unit/core_bake_meshes.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace stability {

namespace {

using bake_test::mesh;

void mark_faulty(subject& s)
{
    s.faulty = true;
}

ao::sphere_rule upright(int points)
{
    return *ao::lebedev_rule(points, ao::no_rotation);
}

// Empty where the backend refuses.
std::vector<float> bake(subject& s, const mesh& m, const ao::sphere_rule& rule, const ao::bake_settings& settings = {})
{
    const auto job = ao::prepare_bake(m.input(), rule, settings);
    if (!job) {
        return {};
    }
    const auto sums = s.baker()->run(*job, {});
    return sums && sums->holds(*job) ? ao::finish_bake(*job, *sums).coefficients : std::vector<float>{};
}

// Rays in float from a fixed offset along the normal, by Moeller and Trumbore: as published, without regard to scale.
std::vector<float> naive_bake(const mesh& m, const ao::sphere_rule& rule)
{
    std::vector<float> all;
    for (std::size_t v = 0; v < m.positions.size(); ++v) {
        const glm::vec3 n = m.normals.empty() ? glm::vec3(glm::normalize(m.positions[v])) : m.normals[v];
        const glm::vec3 start = glm::vec3(m.positions[v]) + n * 1e-4F;
        int open = 0;
        int count = 0;
        for (const auto& d : rule.directions) {
            const glm::vec3 to(static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2]));
            if (glm::dot(n, to) <= 0) {
                continue;
            }
            bool hit = false;
            for (std::size_t i = 0; i < m.indices.size() && !hit; i += 3) {
                const glm::vec3 a(m.positions[m.indices[i]]);
                const glm::vec3 e(glm::vec3(m.positions[m.indices[i + 1]]) - a);
                const glm::vec3 f(glm::vec3(m.positions[m.indices[i + 2]]) - a);
                const glm::vec3 p = glm::cross(to, f);
                const float inverse = 1 / glm::dot(e, p);
                const glm::vec3 t = start - a;
                const glm::vec3 q = glm::cross(t, e);
                const float u = glm::dot(t, p) * inverse;
                const float w = glm::dot(to, q) * inverse;
                hit = u >= 0 && w >= 0 && u + w <= 1 && glm::dot(f, q) * inverse > 0;
            }
            open += hit ? 0 : 1;
            ++count;
        }
        all.push_back(static_cast<float>(open) / static_cast<float>(std::max(count, 1)));
    }
    return all;
}

// 1 - coefficient of convex bodies, from 1e-3 to 1e6 in size and as far from the origin.
double self_hits(subject& s)
{
    worst w;
    for (const double scale : { 1e-3, 1.0, 100.0, 1e6 }) {
        for (const double shift : { 0.0, 1.0 }) {
            const glm::dvec3 centre = glm::dvec3(0.3, -0.7, 1.1) * (shift * scale * 3);
            mesh ball = bake_test::sphere(centre, scale, s.thorough && !s.faulty ? 3 : 2);
            for (glm::dvec3& p : ball.positions) { // as floats hold them, still convex but for rounding at 1e-7
                p = glm::dvec3(glm::vec3((p - centre) / scale)) * scale + centre;
            }
            for (const mesh& m :
                 { ball, bake_test::box(centre - scale, centre + scale, s.thorough && !s.faulty ? 6 : 3, false) }) {
                const auto all = s.faulty ? naive_bake(m, upright(110)) : bake(s, m, *ao::lebedev_rule(s.thorough ? 590 : 302));
                w.add(all.empty() ? endless : 0);
                for (const float x : all) {
                    w.add(1 - static_cast<double>(x));
                }
            }
        }
    }
    return w.value();
}

// The greatest coefficient in sealed rooms, directions aimed at edges and vertices among them; faulty: a triangle is missing.
double leaks(subject& s)
{
    worst w;
    mesh room = bake_test::box({ -1, -1, -1 }, { 1, 1, 1 }, s.thorough ? 8 : 4, true);
    mesh round = bake_test::sphere({ 0.1, 0.2, 0.3 }, 2, s.thorough ? 3 : 2);
    for (std::size_t i = 0; i < round.indices.size(); i += 3) {
        std::swap(round.indices[i], round.indices[i + 1]); // inwards
    }
    if (s.faulty) {
        room.indices.resize(room.indices.size() - 3);
    }
    for (const mesh& m : { room, round }) {
        for (const ao::sphere_rule& rule : { upright(s.thorough ? 2030 : 1202), *ao::lebedev_rule(s.thorough ? 2030 : 302) }) {
            const auto all = bake(s, m, rule);
            w.add(all.empty() ? endless : 0);
            for (const float x : all) {
                w.add(static_cast<double>(x));
            }
        }
    }
    return w.value();
}

// A ball before a wall.
mesh ball_and_wall()
{
    mesh m = bake_test::sphere({ 0, 0, 1.2 }, 1, 2);
    for (const glm::dvec3& p : m.positions) {
        m.normals.emplace_back(p - glm::dvec3(0, 0, 1.2));
    }
    bake_test::append(m, bake_test::grid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 6));
    return m;
}

// Triangles without area, doubled, with a vertex that is not finite, far slivers.
mesh with_litter(mesh m, bool occluding)
{
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    m.positions.insert(m.positions.end(),
                       { { nan, 0, 0 }, { 0, infinite, 0 }, { -infinite, nan, 1 }, { 0, 0, 30 }, { 1e-300, 0, 30 } });
    m.indices.insert(m.indices.end(), { 0, 0, 0, 1, 2, 1, base, 1, 2, 3, base + 1, 4, base, base + 1, base + 2 });
    m.indices.insert(m.indices.end(), m.indices.begin(), m.indices.begin() + 30);
    if (occluding) {
        m.positions.insert(m.positions.end(), { { -9, -9, 3 }, { 9, -9, 3 }, { 0, 9, 3 } });
        m.indices.insert(m.indices.end(), { base + 5, base + 6, base + 7 });
    }
    m.normals.resize(m.positions.size(), glm::vec3(0, 0, 1));
    return m;
}

// Coefficients that litter changes, and bad ones.
double litter(subject& s)
{
    const mesh clean = ball_and_wall();
    const auto plain = bake(s, clean, *ao::lebedev_rule(302));
    const auto littered = bake(s, with_litter(clean, s.faulty), *ao::lebedev_rule(302));
    if (plain.empty() || littered.size() < plain.size()) {
        return endless;
    }
    double wrong = 0;
    for (std::size_t i = 0; i < littered.size(); ++i) {
        wrong += littered[i] >= 0 && littered[i] <= 1 ? 0 : 1;
        wrong += i < plain.size() && std::abs(littered[i] - plain[i]) > 0.02F ? 1 : 0;
    }
    return wrong;
}

// Axis-parallel rays along flat boxes and walls: an open plane is 1, a sealed room 0.
double axis_rays(subject& s)
{
    worst w;
    const mesh plane = bake_test::grid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 6);
    for (const float x : bake(s, plane, upright(302))) {
        w.add(1 - static_cast<double>(x));
    }
    mesh steps = plane; // a wall whose plane holds the rays along z
    bake_test::append(steps, bake_test::grid({ 2, 0, -1 }, { 0, 1, 0 }, { 0, 0, s.faulty ? 3.0 : 1.0 }, 3));
    const auto all = bake(s, steps, upright(302));
    w.add(all.empty() ? endless : 0);
    for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 49); ++i) {
        w.add(1 - static_cast<double>(all[i]));
    }
    return w.value();
}

// A lid at height 1 over a speck: below that distance it does not occlude, above it does.
double ranges(subject& s)
{
    mesh m;
    m.positions = { { 0, 0, 0 }, { 0.01, 0, 0 }, { -0.01, 0.01, 0 }, { -0.01, -0.01, 0 } };
    m.indices = { 0, 1, 2, 0, 2, 3, 0, 3, 1 };
    bake_test::append(m, bake_test::grid({ 2, -2, 1 }, { -4, 0, 0 }, { 0, 4, 0 }, 1));
    m.normals.clear();
    const double diagonal = std::sqrt(33.0);
    const double below = (s.faulty ? 1.5 : 0.999) / diagonal;
    const double above = 1.01 / diagonal;
    ao::bake_settings near;
    near.distance = below;
    ao::bake_settings far;
    far.distance = above;
    const auto open = bake(s, m, upright(1202), near);
    const auto closed = bake(s, m, upright(1202), far);
    if (open.empty() || closed.empty()) {
        return endless;
    }
    return 1 - static_cast<double>(open[0]) + (closed[0] < 1 ? 0 : 1);
}

// Sums that differ from those of every triangle tried in turn, on a ball with noise, doubled and turned faces.
double against_brute_force(subject& s)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    mesh m = bake_test::sphere({ 0.3, 0.1, -0.2 }, 1, s.thorough ? 3 : 2);
    for (glm::dvec3& p : m.positions) {
        p = glm::dvec3(glm::vec3(p * (1 + 0.3 * uniform(random))));
    }
    for (std::size_t i = 60; i < 120; i += 6) {
        std::swap(m.indices[i], m.indices[i + 1]);
        m.indices.insert(m.indices.end(), { m.indices[i], m.indices[i + 1], m.indices[i + 5] });
    }
    const auto job = ao::prepare_bake(m.input(), *ao::lebedev_rule(170), {});
    if (!job) {
        return endless;
    }
    if (s.faulty) {
        m.indices.erase(m.indices.begin(), m.indices.begin() + 3);
    }
    const auto tried = ao::prepare_bake(m.input(), *ao::lebedev_rule(170), {});
    const auto sums = s.baker()->run(*tried, {});
    if (!sums) {
        return endless;
    }
    double wrong = 0;
    for (std::size_t v = 0; v < job->vertices(); ++v) {
        const auto reference = ao::bake_vertex_reference(*job, v, 0, job->lines.size());
        wrong += reference.open == sums->sums[v].open && reference.all == sums->sums[v].all ? 0 : 1;
    }
    return wrong;
}

} // namespace

std::vector<row> ray_rows()
{
    return {
        { "R1", "1 - coefficient of balls and boxes, sizes 1e-3 to 1e6, at and away from the origin", 0, false,
          "rays start 16 steps off the hull; docs/numerics.md, Per vertex", domain::bake, self_hits,
          "rays in float from a fixed offset of 1e-4", mark_faulty },
        { "R2", "greatest coefficient in sealed rooms, rays at edges and vertices among them", 0, false,
          "an edge is the same to both its triangles", domain::bake, leaks, "one triangle missing", mark_faulty },
        { "R3", "coefficients that litter changes by more than 0.02: no area, doubled, NaN and infinite vertices; bad values", 0,
          false, "litter occludes nothing; centre and scale may move", domain::bake, litter, "a triangle overhead as well",
          mark_faulty },
        { "R4", "1 - coefficient of open planes under rays along the axes, beside a wall that ends below", 0, false, "exact",
          domain::bake, axis_rays, "the wall ends above", mark_faulty },
        { "R5", "a lid at height 1: what it takes within a distance of 0.999, and whether it counts within 1.01", 0, false,
          "exact", domain::bake, ranges, "a distance of 1.5", mark_faulty },
        { "R6", "sums of vertices that differ from brute force over all triangles", 0, false, "the same bits", domain::bake,
          against_brute_force, "one triangle missing", mark_faulty },
    };
}

} // namespace stability
