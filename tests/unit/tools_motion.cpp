// Motion of the camera and of objects: presets, the courtyard's own, and what a scene becomes by it.
#include "scene/motion.hpp"

#include "scene/courtyard.hpp"
#include "scene/drawn.hpp"
#include "scene/error.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

using namespace ao::tools;
using glm::dvec3;

namespace {

scene two_boxes()
{
    scene s;
    mesh_builder m(s);
    m.begin("low", "any");
    m.box({ -1.0f, 0.0f, -1.0f }, { 1.0f, 1.0f, 1.0f });
    m.begin("high", "any");
    m.box({ 2.0f, 2.0f, -1.0f }, { 4.0f, 3.0f, 0.0f });
    return s;
}

double degrees_between(const dvec3& a, const dvec3& b)
{
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

dvec3 ahead(const camera& c)
{
    return -view_axes(c)[2];
}

bool same(const camera& a, const camera& b)
{
    return a.eye == b.eye && a.yaw == b.yaw && a.pitch == b.pitch && a.fov == b.fov;
}

double distance(const glm::dmat4& a, const glm::dmat4& b)
{
    double most = 0.0;
    for (int i = 0; i < 4; ++i)
        most = std::max(most, glm::length(a[i] - b[i]));
    return most;
}

} // namespace

TEST_CASE("nothing moves in a static motion, and the first frame's last frame is itself", "[tools][motion]")
{
    const scene s = two_boxes();
    const camera start = frame(bounds_of(s), 1.5f);
    const motion m = choose_motion("static", { s, start });
    CHECK_FALSE(m.moves_camera());
    CHECK_FALSE(m.moves_objects());
    for (const int f : { 0, 1, 7, 1000 }) {
        CHECK(same(m.camera_at(f), start));
        CHECK_FALSE(m.cut_at(f));
    }
    const motion turning = orbit({ s, start });
    CHECK(same(turning.previous_camera(0), turning.camera_at(0)));
    CHECK(same(turning.previous_camera(5), turning.camera_at(4)));
}

TEST_CASE("an orbit turns by half a degree a frame about what the start camera looks at", "[tools][motion]")
{
    const scene s = two_boxes();
    const camera start = frame(bounds_of(s), 1.5f);
    const motion m = choose_motion("orbit", { s, start });
    CHECK(m.moves_camera());
    const dvec3 middle = (dvec3(bounds_of(s).low) + dvec3(bounds_of(s).high)) / 2.0;
    for (const int f : { 0, 1, 90, 360, 719, 720 }) {
        INFO("frame " << f);
        const camera c = m.camera_at(f);
        CHECK(degrees_between(ahead(c), middle - dvec3(c.eye)) < 1e-4);
        CHECK(glm::length(middle - dvec3(c.eye)) == Approx(glm::length(middle - dvec3(start.eye))).epsilon(1e-6));
        CHECK(c.eye.y == Approx(start.eye.y).epsilon(1e-6));
        const dvec3 before(m.previous_camera(f).eye - glm::vec3(middle)), now(c.eye - glm::vec3(middle));
        const double turn = degrees_between({ before.x, 0.0, before.z }, { now.x, 0.0, now.z });
        CHECK(turn == Approx(f == 0 ? 0.0 : 0.5).margin(1e-4));
    }
    CHECK(glm::length(m.camera_at(720).eye - start.eye) < 1e-4f);
}

TEST_CASE("a pan moves what the start camera looks at by half a pixel a frame", "[tools][motion]")
{
    const scene s = two_boxes();
    const camera start = frame(bounds_of(s), 1.5f);
    constexpr int height = 540;
    const motion m = choose_motion("pan", { s, start, false, 64, height });
    const dvec3 middle = (dvec3(bounds_of(s).low) + dvec3(bounds_of(s).high)) / 2.0;
    const auto column = [&](int f) {
        const glm::dvec4 p = glm::dmat4(view_matrix(m.camera_at(f))) * glm::dvec4(middle, 1.0);
        return p.x / -p.z / std::tan(glm::radians(static_cast<double>(start.fov)) / 2.0) * height / 2.0;
    };
    for (const int f : { 1, 2, 50 }) {
        CHECK(column(f) - column(f - 1) == Approx(0.5).margin(1e-3));
        CHECK(m.camera_at(f).yaw == start.yaw);
        CHECK(m.camera_at(f).pitch == start.pitch);
    }
    for (int f = 0; f < 5000; f += 7)
        REQUIRE(glm::length(m.camera_at(f).eye - start.eye) < 0.26f * glm::length(start.eye - glm::vec3(middle)));
}

TEST_CASE("a cut comes once, in the middle", "[tools][motion]")
{
    const scene s = two_boxes();
    const camera start = frame(bounds_of(s), 1.5f);
    for (const int frames : { 1, 2, 9, 64 }) {
        const motion m = choose_motion("cut", { s, start, false, frames });
        for (int f = 0; f < 70; ++f) {
            INFO("frame " << f << " of " << frames);
            CHECK(m.cut_at(f) == (f == std::max(frames / 2, 1)));
            CHECK(same(m.camera_at(f), m.previous_camera(f)) != m.cut_at(f));
        }
        CHECK(same(m.camera_at(0), start));
    }
}

TEST_CASE("both transforms of an object are set, and the moved scene is where they say", "[tools][motion]")
{
    const scene s = two_boxes();
    const auto way = [](int f) {
        const glm::dmat4 there = glm::translate(glm::dmat4(1.0), dvec3(0.25 * f, 0.0, -1.0));
        return glm::scale(glm::rotate(there, 0.1 * f, glm::normalize(dvec3(1.0, 2.0, 3.0))), dvec3(1.0, 2.0, 0.5));
    };
    const motion m(camera{}, { { 1, way } });
    CHECK(m.moves_objects());
    CHECK(m.moves(1));
    CHECK_FALSE(m.moves(0));
    scene_view drawn(s);
    for (const int f : { 0, 1, 9 }) {
        INFO("frame " << f);
        m.move(drawn.objects(), f);
        CHECK(drawn.objects()[1].model.to_glm() == glm::mat4(way(f)));
        CHECK(drawn.objects()[1].previous_model.to_glm() == glm::mat4(way(f == 0 ? 0 : f - 1)));
        CHECK(drawn.objects()[0].model.to_glm() == glm::mat4(1.0f));
        CHECK(drawn.objects()[0].previous_model.to_glm() == glm::mat4(1.0f));
        CHECK(m.transform(0, f) == glm::dmat4(1.0));
        CHECK(m.transform(1, f) == way(f));

        const scene there = m.moved(s, f);
        REQUIRE(there.triangles == s.triangles);
        REQUIRE_NOTHROW(check(there));
        for (std::size_t t = 0; t < s.triangles.size(); ++t) {
            dvec3 corners[3];
            for (int i = 0; i < 3; ++i) {
                const auto v = s.triangles[t][i];
                corners[i] = s.object[t] == 1 ? dvec3(way(f) * glm::dvec4(s.positions[v], 1.0)) : dvec3(s.positions[v]);
                REQUIRE(glm::length(dvec3(there.positions[v]) - corners[i]) < 1e-5);
            }
            const dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
            REQUIRE(glm::length(dvec3(there.normals[s.triangles[t].x]) - normal) < 1e-5);
        }
    }
}

TEST_CASE("vertices that two objects share part when one of them moves", "[tools][motion]")
{
    scene s;
    s.positions = { { 0.0f, 0.0f, 0.0f }, { 1.0f, 0.0f, 0.0f }, { 0.0f, 1.0f, 0.0f }, { 1.0f, 1.0f, 0.0f } };
    s.normals.assign(4, { 0.0f, 0.0f, 1.0f });
    s.triangles = { { 0, 1, 2 }, { 1, 3, 2 } };
    s.object = { 0, 1 };
    s.material = { 0, 0 };
    s.object_names = { "a", "b" };
    s.material_names = { "any" };
    const motion m(camera{}, { { 1, [](int) { return glm::translate(glm::dmat4(1.0), dvec3(0.0, 0.0, 5.0)); } } });
    const scene there = m.moved(s, 3);
    REQUIRE_NOTHROW(check(there));
    for (int i = 0; i < 3; ++i) {
        CHECK(there.positions[there.triangles[0][i]] == s.positions[s.triangles[0][i]]);
        CHECK(there.positions[there.triangles[1][i]] == s.positions[s.triangles[1][i]] + glm::vec3(0.0f, 0.0f, 5.0f));
    }
}

TEST_CASE("the animated courtyard is the courtyard and what moves in it", "[tools][motion]")
{
    const scene plain = courtyard(), s = courtyard(true);
    REQUIRE_NOTHROW(check(s));
    REQUIRE(s.triangles.size() > plain.triangles.size());
    CHECK(std::equal(plain.triangles.begin(), plain.triangles.end(), s.triangles.begin()));
    CHECK(std::equal(plain.object_names.begin(), plain.object_names.end(), s.object_names.begin()));
    CHECK(s.material_names == plain.material_names);

    for (const char* words : { "orbit", "pan", "cut" })
        CHECK(choose_motion(words, { s, courtyard_camera(), true }).moves_objects());
    CHECK_FALSE(choose_motion("static", { s, courtyard_camera(), true }).moves_objects());
    CHECK_FALSE(moves_courtyard("static"));
    CHECK(moves_courtyard("orbit"));

    const auto objects = courtyard_motion(s);
    REQUIRE(objects.size() == 3);
    for (const auto& each : objects) {
        INFO(s.object_names[each.object]);
        CHECK(distance(each.at(0), glm::dmat4(1.0)) < 1e-12);
        bool moves = false;
        for (int f = 0; f < 600; ++f) {
            const glm::dmat4 at = each.at(f);
            moves = moves || distance(at, each.at(f + 1)) > 1e-3;
            REQUIRE(distance(glm::dmat4(glm::dmat3(at) * glm::transpose(glm::dmat3(at))), glm::dmat4(1.0)) < 1e-12);
            REQUIRE(glm::determinant(glm::dmat3(at)) > 0.0);
        }
        CHECK(moves);
    }
}

TEST_CASE("nothing that moves in the courtyard runs into the floor, the wall or the rest", "[tools][motion]")
{
    const scene s = courtyard(true);
    const motion m(courtyard_camera(), courtyard_motion(s));
    const auto named = [&](const char* name) {
        return static_cast<std::size_t>(std::find(s.object_names.begin(), s.object_names.end(), name) - s.object_names.begin());
    };
    const auto overlap = [](const bounds& a, const bounds& b) {
        return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y && a.low.z < b.high.z &&
               b.low.z < a.high.z;
    };
    const std::size_t wall = named("screen wall"), coping = named("screen coping"), paving = named("paving");
    // In the screen's own axes, boxes are tight: its front is that of the greatest of its normals across.
    const glm::dmat3 own(glm::inverse(glm::rotate(glm::dmat4(1.0), glm::radians(30.0), dvec3(0.0, 1.0, 0.0))));
    const auto depth_of = [&](const scene& at, std::size_t object) {
        glm::dvec2 d(1e9, -1e9);
        for (std::size_t t = 0; t < at.triangles.size(); ++t)
            for (int i = 0; at.object[t] == object && i < 3; ++i) {
                const double z = (own * dvec3(at.positions[at.triangles[t][i]])).z;
                d = { std::min(d.x, z), std::max(d.y, z) };
            }
        return d;
    };
    const glm::dvec2 screen = depth_of(s, wall);
    for (int f = 0; f < 200; f += 10) {
        INFO("frame " << f);
        const scene at = m.moved(s, f);
        CHECK(depth_of(at, named("box")).x > screen.y);
        for (const char* name : { "box", "door", "fan" }) {
            INFO(name);
            const bounds b = *bounds_of(at, named(name));
            CHECK(b.low.y > bounds_of(s, paving)->high.y);
            for (std::size_t other = 0; other < s.object_names.size(); ++other) {
                const auto there = bounds_of(at, other);
                if (other == wall || other == coping || other == named(name) || !m.moves(named(name)) || !there || m.moves(other))
                    continue;
                INFO(s.object_names[other]);
                CHECK_FALSE(overlap(b, *there));
            }
        }
    }
}
