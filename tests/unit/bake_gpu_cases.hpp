// What the bakers of GPU backends must do, whichever they are. Run: result<bake_sums>(const bake_job&, const bake_request&).
#pragma once

#include "core_bake_meshes.hpp"

#include "ao/bake.hpp"
#include "ao/conformance/bake_reference.hpp"
#include "ao/kernel.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace bake_test {

constexpr std::array gpu_routes{ ao::bake_route::brute, ao::bake_route::tiled, ao::bake_route::packed, ao::bake_route::hierarchy,
                                 ao::bake_route::raster };

inline const char* name_of(ao::bake_route route)
{
    return route == ao::bake_route::brute    ? "brute"
           : route == ao::bake_route::tiled  ? "tiled"
           : route == ao::bake_route::packed ? "packed"
           : route == ao::bake_route::raster ? "raster"
                                             : "hierarchy";
}

// Two objects: a sphere over a floor.
inline mesh sphere_on_floor(int cells = 5, int levels = 1)
{
    mesh m = grid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, cells);
    m.objects.assign(m.indices.size() / 3, 7);
    mesh ball = sphere({ 0.1, 0.2, 0.9 }, 0.8, levels);
    ball.objects.assign(ball.indices.size() / 3, 3);
    m.normals.clear();
    append(m, ball);
    return m;
}

// Triangles through one another, twice, without area, far, not finite, with vertices in no face.
inline mesh broken(int triangles, std::uint32_t seed)
{
    mesh m;
    ao::random_stream random(seed);
    const auto real = [&] { return 2 * static_cast<double>(random.uniform()) - 1; };
    for (int i = 0; i < 2 * triangles; ++i) {
        m.positions.emplace_back(real(), real(), real());
    }
    const auto vertices = static_cast<std::uint32_t>(m.positions.size());
    for (int i = 0; i < triangles; ++i) {
        const std::uint32_t a = random.next() % vertices;
        const std::uint32_t b = random.next() % vertices;
        const std::uint32_t c = i % 11 == 0 ? a : random.next() % vertices;
        m.indices.insert(m.indices.end(), { a, b, c });
        if (i % 7 == 0) {
            m.indices.insert(m.indices.end(), { c, b, a });
        }
    }
    m.positions.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
    m.positions.emplace_back(0.0, 0.5, 0.5);
    m.indices.insert(m.indices.end(), { 0, 1, vertices });
    return m;
}

inline ao::bake_job job_of(const mesh& m, const ao::sphere_rule& rule, const ao::bake_settings& settings)
{
    auto job = ao::prepare_bake(m.input(), rule, settings);
    INFO((job ? std::string() : std::string(job.error().reason())));
    REQUIRE(job);
    return std::move(*job);
}

inline std::size_t differing_sums(const ao::bake_sums& a, const ao::bake_sums& b)
{
    if (a.sums.size() != b.sums.size()) {
        return std::max(a.sums.size(), b.sums.size());
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.sums.size(); ++i) {
        count += a.sums[i] == b.sums[i] ? 0 : 1;
    }
    return count;
}

struct setting_case {
    const char* name;
    ao::bake_settings settings;
};

// Every setting away from its default at least once.
inline std::vector<setting_case> setting_cases()
{
    using namespace ao;
    return {
        { "uniform", { .bent_normals = true } },
        { "cosine", { .coefficient = bake_coefficient::cosine, .bent_normals = true } },
        { "near", { .distance = 0.1 } },
        { "front", { .sides = bake_sides::front } },
        { "own object", { .occluders = bake_occluders::own_object } },
        { "other objects", { .occluders = bake_occluders::other_objects } },
        { "ground", { .ground = true, .ground_up = { 0.1, 0, 2 }, .ground_height = -0.1 } },
        { "linear", { .distance = 0.4, .falloff = bake_falloff::linear, .ground = true, .ground_up = { 0, 0, 1 } } },
        { "smooth",
          { .coefficient = bake_coefficient::cosine,
            .distance = 0.7,
            .falloff = bake_falloff::smooth,
            .sides = bake_sides::front,
            .bent_normals = true } },
        { "rotated", { .rotate_per_vertex = true, .seed = 5 } },
    };
}

inline bool able(ao::bake_route route, const ao::bake_job& job)
{
    return route == ao::bake_route::packed   ? job.settings.falloff == ao::bake_falloff::none && !job.turned()
           : route == ao::bake_route::raster ? !job.turned()
                                             : true;
}

template <class Run>
void require_reference(const Run& run, const ao::bake_job& job, const ao::bake_request& part = {})
{
    const auto expected = ao::bake_reference(job, part);
    REQUIRE(expected);
    for (const ao::bake_route route : gpu_routes) {
        INFO(name_of(route));
        ao::bake_request request = part;
        request.route = route;
        const auto sums = run(job, request);
        if (!able(route, job)) {
            REQUIRE_FALSE(sums);
            CHECK(sums.error().code() == ao::errc::unsupported_format);
            continue;
        }
        INFO((sums ? std::string() : std::string(sums.error().reason())));
        REQUIRE(sums);
        CHECK(differing_sums(*sums, *expected) == 0);
        CHECK(sums->route == route);
        CHECK_FALSE(sums->reason.empty());
        CHECK(sums->first_vertex == expected->first_vertex);
        CHECK(sums->last_vertex == expected->last_vertex);
        CHECK(sums->first_line == expected->first_line);
        CHECK(sums->last_line == expected->last_line);
    }
}

// Bit for bit the reference's sums: settings, rules, broken meshes.
template <class Run>
void check_sums(const Run& run)
{
    const mesh scene = sphere_on_floor();
    for (const setting_case& each : setting_cases()) {
        INFO(each.name);
        const auto job = job_of(scene, *ao::lebedev_rule(74, ao::generic_rotation, ao::negative_weights::allowed), each.settings);
        require_reference(run, job);
    }
    const auto odd = ao::fibonacci_rule(51);
    const auto about_normals = ao::halton_rule(33, ao::rule_domain::cosine_hemisphere);
    const mesh soup = broken(120, 3);
    require_reference(run, job_of(scene, *odd, { .bent_normals = true }));
    require_reference(run, job_of(soup, *odd, { .coefficient = ao::bake_coefficient::cosine }));
    require_reference(run, job_of(soup, *ao::lebedev_rule(50), { .rotate_per_vertex = true }));
    require_reference(run, job_of(scene, *about_normals, { .coefficient = ao::bake_coefficient::cosine }));
    // Directions along the axes of a room: rays through edges and corners, and in the tangent planes of the walls.
    const mesh room = box({ 0, 0, 0 }, { 1, 2, 1 }, 3, true);
    require_reference(run, job_of(room, *ao::lebedev_rule(110, ao::no_rotation), {}));
    require_reference(run, job_of(welded(room), *ao::lebedev_rule(50, ao::no_rotation), {}));
}

template <class Run>
void check_parts(const Run& run)
{
    const auto job = job_of(sphere_on_floor(), *ao::lebedev_rule(86), { .bent_normals = true, .rotate_per_vertex = true });
    const std::size_t vertices = job.vertices();
    require_reference(run, job, { .first_vertex = 13, .last_vertex = 29, .first_line = 6, .last_line = 20 });
    const auto plain = job_of(sphere_on_floor(), *ao::lebedev_rule(86), {});
    require_reference(run, plain, { .first_vertex = vertices - 5, .first_line = 40 });
    require_reference(run, plain, { .first_vertex = 4, .last_vertex = 4 });
    require_reference(run, plain, { .first_line = 8, .last_line = 8 });
    auto whole = run(plain, ao::bake_request{ .last_vertex = 20 });
    const auto rest = run(plain, ao::bake_request{ .first_vertex = 20 });
    REQUIRE(whole);
    REQUIRE(rest);
    REQUIRE(ao::merge_bake_sums(*whole, *rest));
    CHECK(whole->holds(plain));
    CHECK(differing_sums(*whole, *ao::bake_reference(plain)) == 0);
    // No triangles, and none with an area.
    mesh points;
    points.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
    require_reference(run, job_of(points, *ao::lebedev_rule(6), {}));
    points.indices = { 0, 1, 2 };
    require_reference(run, job_of(points, *ao::lebedev_rule(6), {}));
    points.positions[1].y = 1;
    require_reference(run, job_of(points, *ao::lebedev_rule(6), {}));
}

// `run` cuts launches as small as it can.
template <class Run>
void check_progress(const Run& run)
{
    const auto job = job_of(sphere_on_floor(18, 2), *ao::lebedev_rule(38), {});
    REQUIRE(job.vertices() > 512);
    const auto expected = ao::bake_reference(job);
    for (const ao::bake_route route : gpu_routes) {
        INFO(name_of(route));
        std::vector<double> shares;
        ao::bake_request request;
        request.route = route;
        request.progress = [&](double share) {
            shares.push_back(share);
            return true;
        };
        const auto all = run(job, request);
        REQUIRE(all);
        CHECK(differing_sums(*all, *expected) == 0);
        REQUIRE(shares.size() > 4);
        CHECK(std::is_sorted(shares.begin(), shares.end()));
        CHECK(shares.front() > 0);
        CHECK(shares.front() < 0.5);
        CHECK(shares.back() == 1);

        request.progress = [](double share) { return share < 0.6; };
        auto some = run(job, request);
        REQUIRE(some);
        CHECK_FALSE(some->holds(job));
        CHECK(some->first_vertex == 0);
        CHECK(some->first_line == 0);
        CHECK(some->sums.size() == some->last_vertex);
        ao::bake_request left{ .route = route };
        if (route == ao::bake_route::raster) { // by lines
            CHECK(some->last_vertex == job.vertices());
            left.first_line = some->last_line;
        }
        else {
            CHECK(some->last_line == job.lines.size());
            left.first_vertex = some->last_vertex;
        }
        CHECK(some->last_vertex * some->last_line > 0);
        CHECK(some->last_vertex * some->last_line < job.vertices() * job.lines.size());
        const auto rest = run(job, left);
        REQUIRE(rest);
        REQUIRE(ao::merge_bake_sums(*some, *rest));
        CHECK(differing_sums(*some, *expected) == 0);

        request.progress = [](double) { return false; };
        const auto none = run(job, request);
        REQUIRE(none);
        CHECK((route == ao::bake_route::raster ? none->last_line : none->last_vertex) == 0);
    }
}

template <class Run>
void check_refusals(const Run& run)
{
    const auto job = job_of(sphere_on_floor(), *ao::lebedev_rule(6), {});
    using Catch::Matchers::Contains;
    {
        const auto sums = run(job, ao::bake_request{ .route = ao::bake_route::embree });
        REQUIRE_FALSE(sums);
        CHECK(sums.error().code() == ao::errc::unsupported_format);
        CHECK_THAT(std::string(sums.error().reason()), Contains("brute") && Contains("packed"));
    }
    CHECK(run(job, ao::bake_request{ .first_line = 1 }).error().code() == ao::errc::invalid_settings);
    CHECK(run(job, ao::bake_request{ .first_vertex = 3, .last_vertex = 2 }).error().code() == ao::errc::invalid_settings);
    const auto chosen = run(job, ao::bake_request{});
    REQUIRE(chosen);
    CHECK(chosen->route != ao::bake_route::automatic);
    CHECK(differing_sums(*chosen, *ao::bake_reference(job)) == 0);
}

} // namespace bake_test
