#include "tools_support.hpp"

#include "scene/courtyard.hpp"
#include "scene/sequence.hpp"
#include "scene/truth.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <set>

namespace {

using namespace ao::tools;

constexpr double pi = std::numbers::pi;

// Estimates against an expectation per pixel. Random sampling is the upper limit of the spread that a scrambled
// sequence has; 5 standard deviations per pixel, 4.5 for the mean.
template <class Expected>
void check_sampling(const gbuffer& g, const std::vector<float>& half, unsigned rays, Expected expected)
{
    double sum = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
        REQUIRE(g.hit[i] == 1);
        const double e = expected(glm::dvec3(g.world[i]));
        const double v = e * (1.0 - e) / rays;
        CHECK(std::abs(static_cast<double>(half[i]) - e) < 5.0 * std::sqrt(v) + 1e-4);
        sum += static_cast<double>(half[i]) - e;
        variance += v;
    }
    CHECK(std::abs(sum) < 4.5 * std::sqrt(variance) + 1e-4 * static_cast<double>(g.size()));
}

truth_halves trace(const scene& s, const camera& c, const gbuffer& g, const truth_settings& settings)
{
    const auto t = trace_truth(s, ray_tree(s), c, g, settings);
    REQUIRE(t.has_value());
    return *t;
}

gbuffer view(const scene& s, const camera& c, int width, int height)
{
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    return trace_gbuffer(s, ray_tree(s), c, perspective(c, aspect, clip_range(bounds_of(s), c)), width, height);
}

scene small_scene()
{
    scene s;
    add_floor(s, 5.0f);
    mesh_builder m(s);
    m.begin("boxes", "any");
    m.turned_box({ 0.5f, 0.4f, 0.0f }, { 0.3f, 0.4f, 0.3f }, 20.0f);
    m.turned_box({ -0.6f, 0.6f, -0.2f }, { 0.3f, 0.2f, 0.4f }, 50.0f);
    return s;
}

} // namespace

TEST_CASE("convex solids see nothing but the open, at any scale and place", "[tools][truth]")
{
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f, 1e6f);
    const float shift = GENERATE(0.0f, 300.0f);
    scene s;
    mesh_builder m(s);
    m.begin("box", "any");
    m.turned_box(scale * glm::vec3(shift, -shift, 0.3f), scale * glm::vec3(1.0f, 0.7f, 0.4f), 31.0f);
    const camera c = frame(bounds_of(s), 1.0f);
    const gbuffer g = view(s, c, 24, 24);
    std::size_t hits = 0;
    for (const std::uint8_t h : g.hit)
        hits += h;
    REQUIRE(hits > 60);
    const truth_halves t = trace(s, c, g, { scale, 128, 3 });
    for (std::size_t i = 0; i < g.size(); ++i)
        CHECK((t.a[i] == 1.0f && t.b[i] == 1.0f));
}

TEST_CASE("a wall's crease has the closed form of a perpendicular rectangle", "[tools][truth]")
{
    constexpr double height = 1.0, length = 20.0; // to either side
    scene s;
    add_floor(s, 20.0f);
    mesh_builder m(s);
    m.begin("wall", "any");
    m.quad({ 0.0f, 0.0f, 20.0f }, { 0.0f, 1.0f, 20.0f }, { 0.0f, 1.0f, -20.0f }, { 0.0f, 0.0f, -20.0f });
    const camera c = camera_above(0.6f, 3.0f, 0.1f, 20.0f);
    const gbuffer g = view(s, c, 48, 12);
    constexpr unsigned rays = 1024;
    const truth_halves t = trace(s, c, g, { 100.0f, 2 * rays, 1 });

    // View factor of an element at distance d: 2 times the rectangle from the foot of its perpendicular to one side.
    const auto expected = [&](const glm::dvec3& p) {
        const double d = std::abs(p.x), slant = std::hypot(d, height);
        const auto side = [&](double b) { return (std::atan(b / d) - d / slant * std::atan(b / slant)) / (2.0 * pi); };
        return 1.0 - side(length - p.z) - side(length + p.z);
    };
    // The wall is long: the formula above is nearly that of the endless one, which tends to 1/2 in the crease.
    CHECK(expected({ 0.5, 0.0, 0.0 }) == Approx((1.0 + 0.5 / std::hypot(0.5, 1.0)) / 2.0).margin(2e-3));
    CHECK(expected({ 1e-6, 0.0, 0.0 }) == Approx(0.5).margin(1e-5));
    check_sampling(g, t.a, rays, expected);
    check_sampling(g, t.b, rays, expected);
}

TEST_CASE("a sphere above a plane has the closed form", "[tools][truth]")
{
    constexpr float radius = 1.0f, above = 2.0f;
    constexpr auto ball = static_cast<double>(radius), lift = static_cast<double>(above);
    scene s;
    add_floor(s, 30.0f);
    mesh_builder m(s);
    m.begin("sphere", "any");
    std::vector<outline_point> outline;
    for (int i = 0; i <= 128; ++i) {
        const float angle = static_cast<float>(pi) * (static_cast<float>(i) / 128.0f);
        outline.push_back({ i % 128 == 0 ? 0.0f : radius * std::sin(angle), above - radius * std::cos(angle) });
    }
    m.lathe({ 0.0f, 0.0f, 0.0f }, outline, 256);
    const camera c = camera_above(0.3f, 0.7f, 0.0f, 90.0f);
    const gbuffer g = view(s, c, 31, 17);
    constexpr unsigned rays = 1024;
    const truth_halves t = trace(s, c, g, { 100.0f, 2 * rays, 7 });
    const auto expected = [&](const glm::dvec3& p) {
        return 1.0 - ball * ball * lift / std::pow(p.x * p.x + p.z * p.z + lift * lift, 1.5);
    };
    CHECK(expected({ 0.0, 0.0, 0.0 }) == Approx(1.0 - 0.25));
    check_sampling(g, t.a, rays, expected);
    check_sampling(g, t.b, rays, expected);
}

TEST_CASE("the fall-off is a step at the radius", "[tools][truth]")
{
    scene s;
    add_floor(s, 30.0f);
    mesh_builder m(s);
    m.begin("ceiling", "any");
    m.quad({ -30.0f, 2.0f, 30.0f }, { 30.0f, 2.0f, 30.0f }, { 30.0f, 2.0f, -30.0f }, { -30.0f, 2.0f, -30.0f });
    const camera c = camera_above(0.0f, 1.0f, 0.0f, 60.0f);
    const gbuffer g = view(s, c, 16, 16);
    constexpr unsigned rays = 1024;
    for (const float radius : { 1.9f, 2.5f, 4.0f }) {
        // Blocked within the cone cos > h / r, whose cosine-weighted share is 1 - (h / r)^2.
        const double share = radius > 2.0f ? std::pow(2.0 / static_cast<double>(radius), 2) : 1.0;
        check_sampling(g, trace(s, c, g, { radius, 2 * rays, 5 }).a, rays, [&](const glm::dvec3&) { return share; });
    }
}

TEST_CASE("rays gather about the shading normal", "[tools][truth]")
{
    scene s;
    add_floor(s, 30.0f);
    constexpr double lean = 0.5;
    for (glm::vec3& n : s.normals)
        n = glm::vec3(static_cast<float>(std::sin(lean)), static_cast<float>(std::cos(lean)), 0.0f);
    const camera c = camera_above(0.0f, 1.0f, 0.0f, 60.0f);
    const gbuffer g = view(s, c, 16, 16);
    constexpr unsigned rays = 1024;
    // Of the cosine lobe of a normal that leans by a, the share (1 + cos a) / 2 lies above the plane.
    check_sampling(g, trace(s, c, g, { 1.0f, 2 * rays, 5 }).b, rays,
                   [&](const glm::dvec3&) { return (1.0 + std::cos(lean)) / 2.0; });
}

TEST_CASE("truth depends on nothing but its inputs", "[tools][truth]")
{
    const scene s = small_scene();
    const camera c = frame(bounds_of(s), 1.5f);
    const gbuffer g = view(s, c, 48, 32);
    const truth_settings settings{ 1.0f, 40, 9 }; // 20 per half: not a multiple of the packet
    const truth_halves first = trace(s, c, g, settings);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const truth_halves again = trace(s, c, g, settings);
        CHECK(again.a == first.a);
        CHECK(again.b == first.b);
    }
    CHECK(first.a != first.b);
    CHECK(trace(s, c, g, { 1.0f, 40, 10 }).a != first.a);
    CHECK(trace(s, c, g, { 1.0f, 80, 9 }).a != first.a);
    for (std::size_t i = 0; i < g.size(); ++i) {
        if (g.hit[i] == 0)
            CHECK((first.a[i] == 1.0f && first.b[i] == 1.0f));
        CHECK(first.a[i] * 20.0f == std::round(first.a[i] * 20.0f));
        CHECK((first.a[i] >= 0.0f && first.a[i] <= 1.0f));
    }
}

TEST_CASE("longer rays never see more", "[tools][truth]")
{
    const scene s = small_scene();
    const camera c = frame(bounds_of(s), 1.5f);
    const gbuffer g = view(s, c, 48, 32);
    const truth_halves small = trace(s, c, g, { 50.0f, 64, 2 }), large = trace(s, c, g, { 1.0e30f, 64, 2 });
    std::size_t darker = 0;
    const truth_halves nearer = trace(s, c, g, { 0.5f, 64, 2 });
    for (std::size_t i = 0; i < g.size(); ++i) {
        CHECK(large.a[i] <= small.a[i]);
        darker += small.a[i] < nearer.a[i] ? 1u : 0u;
    }
    CHECK(darker > 10);
}

TEST_CASE("cancelled work gives nothing, finished work reports all of it", "[tools][truth]")
{
    const scene s = small_scene();
    const camera c = frame(bounds_of(s), 1.5f);
    const gbuffer g = view(s, c, 96, 64);
    const ray_tree tree(s);
    std::atomic<bool> cancel{ true };
    CHECK_FALSE(trace_truth(s, tree, c, g, { 1.0f, 16, 1 }, &cancel).has_value());

    cancel = false;
    double last = 0.0;
    const auto stop_half_way = [&](double share) { cancel = share > 0.5; };
    CHECK_FALSE(trace_truth(s, tree, c, g, { 1.0f, 16, 1 }, &cancel, stop_half_way).has_value());

    cancel = false;
    bool rising = true;
    const auto listen = [&](double share) {
        rising = rising && share > last;
        last = share;
    };
    CHECK(trace_truth(s, tree, c, g, { 1.0f, 16, 1 }, &cancel, listen).has_value());
    CHECK(rising);
    CHECK(last == 1.0);
}

TEST_CASE("every power of two of scrambled points fills every elementary interval once", "[tools][sequence]")
{
    const std::uint32_t seed = GENERATE(0u, 1u, 0xdeadbeefu, 77u);
    for (unsigned bits = 1; bits <= 8; ++bits)
        for (unsigned wide = 0; wide <= bits; ++wide) {
            std::set<std::pair<unsigned, unsigned>> cells;
            for (std::uint32_t i = 0; i < 1u << bits; ++i) {
                const float u = unit_float(owen_scramble(i, mix_bits(seed)));
                const float v = unit_float(owen_scramble(sobol_1_reversed(i), mix_bits(seed + 1)));
                cells.insert({ static_cast<unsigned>(u * static_cast<float>(1u << wide)),
                               static_cast<unsigned>(v * static_cast<float>(1u << (bits - wide))) });
            }
            CHECK(cells.size() == 1u << bits);
        }
    CHECK(unit_float(0xffffffffu) < 1.0f);
    CHECK(reverse_bits(0x00000003u) == 0xc0000000u);
}
