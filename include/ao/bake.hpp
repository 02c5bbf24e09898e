// Ambient occlusion per vertex (paper 3): what is to be baked, what backends give back, and what becomes of it.
//
//     auto rule = ao::lebedev_rule(5810);
//     auto job = ao::prepare_bake({ positions, normals, indices, {} }, *rule, settings);
//     auto cpu = ao::cpu::baker::create();
//     auto sums = cpu->run(*job, {});                       // or by parts: merge_bake_sums
//     ao::bake_result baked = ao::finish_bake(*job, *sums); // baked.coefficients[i] of positions[i]
//
// Sums are whole numbers: the same bits for every route that is not marked otherwise (bake_route), backend, number of threads,
// and division into parts.
#pragma once

#include "ao/bake_lines.hpp"
#include "ao/bake_mesh.hpp"
#include "ao/bake_settings.hpp"
#include "ao/result.hpp"
#include "ao/sphere_rule.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace ao {

struct bake_job {
    bake_settings settings;
    bake_mesh mesh;
    std::vector<bake_line> lines;
    std::vector<std::uint32_t> directions; // bake_lines::directions
    rule_domain domain = rule_domain::sphere;
    float reach = 0;          // settings.distance in units; 1e15 where that is more
    glm::vec4 ground{ 0.0F }; // ao_bake_ground; w in units
    bool by_cosine = false;   // weights are multiplied by the cosine
    bool random = false;      // sphere_rule::random
    // The rule is turned at each vertex (vertex_rotation).
    bool turned() const { return settings.rotate_per_vertex || domain != rule_domain::sphere; }
    std::size_t vertices() const { return mesh.vertices.size(); }
    // Lines that belong together where changes are counted: 2 i and 2 i + 1.
    std::size_t line_pairs() const { return (lines.size() + 1) / 2; }
};

inline constexpr std::size_t bake_all = std::numeric_limits<std::size_t>::max();

// A part of a job. Parts by lines are cheap for the raster route, parts by vertices for the others.
struct bake_request {
    std::size_t first_vertex = 0;
    std::size_t last_vertex = bake_all;       // not included
    std::size_t first_line = 0;               // even
    std::size_t last_line = bake_all;         // not included; even, or the number of lines
    bake_route route = bake_route::automatic; // over that of the settings
    // Called now and then, by the thread that called, with the share done; false ends the bake.
    std::function<bool(double)> progress{};
};

// Of one vertex, over its directions on the side of the normal.
struct bake_sum {
    std::int32_t open = 0;    // weights times visibility
    std::int32_t all = 0;     // weights
    std::int32_t changes = 0; // of visibility between neighbouring lines (ao_bake_level), for the error
    std::int32_t count = 0;   // directions; those in the tangent plane do not count
    std::int32_t x = 0;       // open weights times directions, if bent normals are asked for
    std::int32_t y = 0;
    std::int32_t z = 0;
    std::int32_t reserved = 0;

    bake_sum& operator+=(const bake_sum& s)
    {
        open += s.open;
        all += s.all;
        changes += s.changes;
        count += s.count;
        x += s.x;
        y += s.y;
        z += s.z;
        return *this;
    }
    friend bool operator==(const bake_sum&, const bake_sum&) = default;
};

// What a backend found for a range of vertices and lines: the request's, or, where progress ended the bake, the first part of it.
struct bake_sums {
    std::size_t first_vertex = 0;
    std::size_t last_vertex = 0;
    std::size_t first_line = 0;
    std::size_t last_line = 0;
    std::vector<bake_sum> sums;               // of these vertices
    bake_route route = bake_route::automatic; // taken
    std::string reason;                       // why that one, one line

    bool holds(const bake_job& job) const
    {
        return first_vertex == 0 && last_vertex == job.vertices() && first_line == 0 && last_line == job.lines.size();
    }
};

struct bake_report {
    std::size_t isolated = 0;
    std::size_t not_finite = 0;
    std::size_t no_normal = 0;
    std::size_t enclosed = 0;
    bake_dropped dropped;
    float least = 1;
    float greatest = 1;
    double mean = 1;          // of the baked vertices
    float greatest_error = 0; // estimated
    double typical_error = 0; // root of the mean square of the estimates
};

struct bake_result {
    std::vector<float> coefficients; // per vertex of the input, [0, 1] unless the rule has negative weights; 1 where unbaked
    std::vector<float> errors;       // estimated standard error of each; docs/numerics.md, "Per vertex"
    std::vector<glm::vec3> bent;     // unit, the mean open direction; the normal where nothing is open; if asked for
    std::vector<std::uint8_t> flags; // bake_flag
    bake_report report;
};

// errc::invalid_settings, errc::invalid_scene.
inline result<bake_job> prepare_bake(const bake_input& input, const sphere_rule& rule, const bake_settings& settings)
{
    if (const auto wrong = validate(settings)) {
        return *wrong;
    }
    if (rule.domain == rule_domain::cosine_hemisphere && settings.coefficient != bake_coefficient::cosine) {
        return error(errc::invalid_settings, "a rule weighted by the cosine gives the cosine coefficient only");
    }
    if (rule.domain != rule_domain::sphere && settings.route == bake_route::raster) {
        return error(errc::invalid_settings, "the raster route takes one rule for all vertices: no rule about the normal");
    }
    auto lines = make_bake_lines(rule);
    if (!lines) {
        return lines.error();
    }
    auto mesh = prepare_bake_mesh(input, settings.own_normals);
    if (!mesh) {
        return mesh.error();
    }
    bake_job job;
    job.settings = settings;
    job.mesh = std::move(*mesh);
    job.lines = std::move(lines->lines);
    job.directions = std::move(lines->directions);
    job.domain = rule.domain;
    job.random = rule.random;
    job.reach = static_cast<float>(std::min(settings.distance * job.mesh.diagonal, 1e15)); // its product with an area is finite
    job.by_cosine = settings.coefficient == bake_coefficient::cosine && rule.domain != rule_domain::cosine_hemisphere;
    if (settings.ground) {
        const glm::dvec3 up = glm::normalize(settings.ground_up);
        const double height = settings.ground_height - glm::dot(up, job.mesh.centre);
        job.ground = glm::vec4(glm::vec3(up), static_cast<float>(std::ldexp(height, -job.mesh.exponent)));
    }
    return job;
}

// By which the rule is turned at a vertex, where it is.
inline bake_pass<float>::ao_rotation vertex_rotation(const bake_job& job, std::size_t vertex)
{
    rotation3 r = no_rotation;
    if (job.domain != rule_domain::sphere) {
        const auto n = glm::dvec3(job.mesh.vertices[vertex].normal);
        r = rotation_to({ n.x, n.y, n.z });
        if (job.settings.rotate_per_vertex) {
            // About the axis only.
            random_stream random(job.settings.seed ^ (static_cast<std::uint32_t>(vertex) * 2654435761U));
            const double angle = 2 * detail::pi * static_cast<double>(random.uniform());
            const rotation3 about = rotation_of_quaternion(detail::cosine(angle / 2), 0, 0, detail::sine(angle / 2));
            const direction3 x = rotated(r, rotated(about, { 1, 0, 0 }));
            const direction3 y = rotated(r, rotated(about, { 0, 1, 0 }));
            r = { x[0], y[0], r.xz, 0, x[1], y[1], r.yz, 0, x[2], y[2], r.zz, 0 };
        }
    }
    else if (job.settings.rotate_per_vertex) {
        random_stream random(job.settings.seed ^ (static_cast<std::uint32_t>(vertex) * 2654435761U));
        r = rotation_of_index(random.next());
    }
    const auto f = [](double x) { return static_cast<float>(x); };
    return { f(r.xx), f(r.xy), f(r.xz), 0, f(r.yx), f(r.yy), f(r.yz), 0, f(r.zx), f(r.zy), f(r.zz), 0 };
}

// errc::invalid_settings for a part that is not one.
inline result<bake_request> checked_request(const bake_job& job, bake_request request)
{
    request.last_vertex = std::min(request.last_vertex, job.vertices());
    request.last_line = std::min(request.last_line, job.lines.size());
    if (request.first_vertex > request.last_vertex || request.first_line > request.last_line) {
        return error(errc::invalid_settings, "a part of a bake must not end before it begins");
    }
    if (request.first_line % 2 != 0 || (request.last_line % 2 != 0 && request.last_line != job.lines.size())) {
        return error(errc::invalid_settings, "a part of a bake must begin and end at an even line");
    }
    if (request.route == bake_route::automatic) {
        request.route = job.settings.route;
    }
    return request;
}

// Adds a part that continues another by vertices (of the same lines) or by lines (of the same vertices).
// False, and nothing done, for other parts.
inline bool merge_bake_sums(bake_sums& into, const bake_sums& next)
{
    const bool same_vertices = into.first_vertex == next.first_vertex && into.last_vertex == next.last_vertex;
    const bool same_lines = into.first_line == next.first_line && into.last_line == next.last_line;
    if (same_vertices && into.last_line == next.first_line) {
        for (std::size_t i = 0; i < into.sums.size(); ++i) {
            into.sums[i] += next.sums[i];
        }
        into.last_line = next.last_line;
        return true;
    }
    if (same_lines && into.last_vertex == next.first_vertex) {
        into.sums.insert(into.sums.end(), next.sums.begin(), next.sums.end());
        into.last_vertex = next.last_vertex;
        return true;
    }
    return false;
}

namespace detail {

// Measured on spread rules (docs/numerics.md, "Per vertex"): the error is 0.45 times that of points which lie on either side of
// the boundary of what is open by chance. The rest is for meshes that were not measured.
inline constexpr double bake_error_factor = 0.8;
// Changes that may have been missed: occluders that no pair of neighbours told apart.
inline constexpr double bake_missed_changes = 2;

// Every change between neighbours stands for a point whose cell is cut by the boundary of what is open.
inline float bake_error_of(const bake_sum& s, bool by_cosine)
{
    if (s.count <= 0 || s.all <= 0) {
        return 0;
    }
    const double levels = static_cast<double>(bake_pass<float>::ao_bake_levels);
    const double scale = levels * levels * (by_cosine ? levels / 4 : 1);
    const double changes = static_cast<double>(std::max(s.changes, 0)) / scale + bake_missed_changes;
    return static_cast<float>(bake_error_factor * std::sqrt(changes) / s.count);
}

// Independent directions: the variance of a mean of n of them, each open with the chance that was found. Where all or none are,
// that is taken from two more, one of each. By the cosine squared weights sum to 4 / 3 of what they would if they were equal.
inline float bake_random_error_of(const bake_sum& s, bool by_cosine)
{
    if (s.count <= 0 || s.all <= 0) {
        return 0;
    }
    const double n = s.count;
    const double open = std::clamp(static_cast<double>(s.open) / static_cast<double>(s.all), 0.0, 1.0);
    const double chance = (open * n + 1) / (n + 2);
    return static_cast<float>(std::sqrt(chance * (1 - chance) / n * (by_cosine ? 4.0 / 3 : 1.0)));
}

} // namespace detail

// Precondition: sums.holds(job).
inline bake_result finish_bake(const bake_job& job, const bake_sums& sums)
{
    bake_result baked;
    const std::size_t count = job.vertices();
    baked.coefficients.assign(count, 1.0F);
    baked.errors.assign(count, 0.0F);
    baked.flags = job.mesh.flags;
    if (job.settings.bent_normals) {
        baked.bent.assign(count, glm::vec3(0.0F));
    }
    bake_report& report = baked.report;
    report.dropped = job.mesh.dropped;
    double sum = 0;
    double squares = 0;
    std::size_t done = 0;
    for (std::size_t v = 0; v < count; ++v) {
        const std::uint8_t flags = baked.flags[v];
        report.isolated += (flags & bake_isolated) != 0 ? 1 : 0;
        report.not_finite += (flags & bake_not_finite) != 0 ? 1 : 0;
        report.no_normal += (flags & bake_no_normal) != 0 ? 1 : 0;
        report.enclosed += (flags & bake_enclosed) != 0 ? 1 : 0;
        const glm::vec3& normal = job.mesh.vertices[v].normal;
        if (job.settings.bent_normals) {
            baked.bent[v] = normal;
        }
        const bake_sum& s = sums.sums[v];
        if ((flags & bake_unbaked) != 0 || s.all <= 0) {
            continue;
        }
        const auto coefficient = static_cast<float>(static_cast<double>(s.open) / static_cast<double>(s.all));
        baked.coefficients[v] = coefficient;
        baked.errors[v] = job.random ? detail::bake_random_error_of(s, job.by_cosine) : detail::bake_error_of(s, job.by_cosine);
        if (job.settings.bent_normals) {
            const glm::dvec3 bent(s.x, s.y, s.z);
            const double length = glm::length(bent);
            baked.bent[v] = length > 1 ? glm::vec3(bent / length) : normal;
        }
        report.least = done == 0 ? coefficient : std::min(report.least, coefficient);
        report.greatest = done == 0 ? coefficient : std::max(report.greatest, coefficient);
        report.greatest_error = std::max(report.greatest_error, baked.errors[v]);
        sum += static_cast<double>(coefficient);
        squares += static_cast<double>(baked.errors[v]) * static_cast<double>(baked.errors[v]);
        ++done;
    }
    if (done > 0) {
        report.mean = sum / static_cast<double>(done);
        report.typical_error = std::sqrt(squares / static_cast<double>(done));
    }
    return baked;
}

// All at once. Baker: result<bake_sums> run(const bake_job&, const bake_request&).
template <class Baker>
result<bake_result> bake(Baker& baker, const bake_job& job, const bake_request& request = {})
{
    auto sums = baker.run(job, request);
    if (!sums) {
        return sums.error();
    }
    if (!sums->holds(job)) {
        return error(errc::invalid_settings, "the bake was ended before it was done");
    }
    return finish_bake(job, *sums);
}

} // namespace ao
