#include "tools_support.hpp"

#include "ao/scene_check.hpp"
#include "scene/courtyard.hpp"
#include "scene/drawn.hpp"
#include "scene/error.hpp"
#include "scene/gbuffer.hpp"
#include "scene/tangents.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

using namespace ao::tools;

TEST_CASE("the courtyard is sound and all there", "[tools][scene]")
{
    const scene s = courtyard();
    CHECK_NOTHROW(check(s));
    CHECK(count_degenerate(s) == 0);
    CHECK(s.triangles.size() > 20000);
    CHECK(s.triangles.size() <= 60000);
    const std::set<std::string> names(s.object_names.begin(), s.object_names.end());
    CHECK(names.size() == s.object_names.size());
    for (const char* name : { "paving", "arcade column 0", "arches", "vault", "steps", "railing left", "wall ivy", "shrub 0",
                              "crate 0", "fountain", "distant wall" })
        CHECK(names.count(name) == 1);
    std::vector<std::size_t> triangles(s.object_names.size());
    for (const std::uint32_t o : s.object)
        ++triangles[o];
    CHECK(*std::min_element(triangles.begin(), triangles.end()) > 0);

    const scene again = courtyard();
    CHECK(again.positions == s.positions);
    CHECK(again.normals == s.normals);
}

TEST_CASE("every solid shape's normals point the way its triangles face", "[tools][scene]")
{
    scene s;
    mesh_builder m(s);
    m.begin("shapes", "any");
    m.turned_box({ 1.0f, 2.0f, 3.0f }, { 0.5f, 1.0f, 2.0f }, 30.0f);
    m.slab({ -1.0f, 0.0f, -1.0f }, { 1.0f, 0.5f, 1.0f }, 0.1f);
    m.bar({ 0.0f, 0.0f, 0.0f }, { 1.0f, 2.0f, 0.5f }, 0.1f, 8);
    const outline_point outline[] = { { 1.0f, 0.0f }, { 1.2f, 0.5f }, { 0.5f, 1.0f }, { 0.0f, 1.2f } };
    m.lathe({ 0.0f, 0.0f, 0.0f }, outline, 12);
    check(s);
    for (const glm::uvec3& t : s.triangles) {
        const glm::vec3 a = s.positions[t.x];
        const glm::vec3 face = glm::normalize(glm::cross(s.positions[t.y] - a, s.positions[t.z] - a));
        for (int corner = 0; corner < 3; ++corner)
            CHECK(glm::dot(face, s.normals[t[corner]]) > 0.5f);
    }
}

TEST_CASE("a damaged scene is refused", "[tools][scene]")
{
    scene s;
    CHECK_THROWS_AS(check(s), error);
    add_floor(s, 1.0f);
    CHECK_NOTHROW(check(s));
    SECTION("index")
    {
        s.triangles[1].z = 4;
    }
    SECTION("position")
    {
        s.positions[2].y = std::numeric_limits<float>::quiet_NaN();
    }
    SECTION("normal")
    {
        s.normals[0] *= 1.1f;
    }
    SECTION("object")
    {
        s.object[0] = 7;
    }
    SECTION("texture coordinate")
    {
        s.uvs[3].x = std::numeric_limits<float>::infinity();
    }
    SECTION("texture coordinates")
    {
        s.uvs.pop_back();
    }
    SECTION("two materials")
    {
        s.material_names.push_back("other");
        s.material[1] = 1;
    }
    SECTION("no such blend")
    {
        s.object_material = { -1 };
    }
    SECTION("texels")
    {
        s.textures.push_back({ "t", 2, 2, false, {}, {}, std::vector<std::uint8_t>(15), false });
    }
    SECTION("size of a texture")
    {
        s.textures.push_back({ "t", 0, 2, false, {}, {}, {}, false });
    }
    CHECK_THROWS_AS(check(s), error);
}

TEST_CASE("the view of a scene has its triangles, object by object", "[tools][scene]")
{
    const scene s = courtyard();
    const scene_view view(s);
    const ao::scene seen = view.get();
    REQUIRE_FALSE(ao::validate(seen));
    REQUIRE(seen.objects.size() == s.object_names.size());
    REQUIRE(seen.meshes.size() == s.object_names.size());
    const std::vector<int> materials = materials_of_objects(s);
    std::vector<std::size_t> next(seen.meshes.size());
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        const std::uint32_t object = s.object[t];
        const ao::mesh& m = seen.meshes[object];
        REQUIRE(seen.objects[object].mesh == static_cast<int>(object));
        REQUIRE(seen.objects[object].material == materials[object]);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = s.triangles[t][corner];
            const std::uint32_t drawn = m.indices[next[object]++];
            REQUIRE(m.positions[drawn] == s.positions[v]);
            REQUIRE(m.normals[drawn] == s.normals[v]);
            REQUIRE(m.uvs[drawn] == s.uvs[v]);
            REQUIRE(m.tangents[drawn] == s.tangents[v]);
        }
    }
    for (std::size_t i = 0; i < next.size(); ++i)
        CHECK(next[i] == seen.meshes[i].indices.size());
    // The terrace is the one blend, of asphalt and snow.
    CHECK(std::count(materials.begin(), materials.end(), -1) == 1);
    REQUIRE(seen.blends.size() == 1);
    CHECK(s.material_names[static_cast<std::size_t>(seen.blends[0].first)] == "asphalt");
    CHECK(s.material_names[static_cast<std::size_t>(seen.blends[0].second)] == "snow");
}

TEST_CASE("the view takes objects whose triangles are scattered, or that have none", "[tools][scene]")
{
    scene s;
    mesh_builder m(s);
    m.begin("one", "any");
    m.quad({ 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 });
    m.begin("none", "other");
    m.begin("two", "other");
    m.quad({ 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 });
    std::swap(s.triangles[1], s.triangles[2]);
    std::swap(s.object[1], s.object[2]);
    std::swap(s.material[1], s.material[2]);
    s.object_has_uvs = { 1, 1, 0 };
    check(s);
    const scene_view view(s);
    const ao::scene seen = view.get();
    CHECK_FALSE(ao::validate(seen));
    REQUIRE(seen.objects.size() == 3);
    CHECK(seen.meshes[0].indices.size() == 6);
    CHECK(seen.meshes[1].indices.empty());
    CHECK(seen.meshes[2].indices.size() == 6);
    CHECK(seen.meshes[0].uvs.size() == 4);
    CHECK(seen.meshes[2].uvs.empty());
    CHECK(seen.objects[1].material == 0);
    CHECK(seen.objects[2].material == 1);
    for (const std::uint32_t i : seen.meshes[2].indices)
        CHECK(seen.meshes[2].positions[i].z == 1.0f);
    CHECK(seen.materials.size() == 2);
}

TEST_CASE("faces are covered by pictures the right way round", "[tools][scene]")
{
    scene s;
    mesh_builder m(s);
    m.begin("box", "any");
    m.box({ -1.0f, -2.0f, -3.0f }, { 1.0f, 2.0f, 3.0f });
    m.begin("round", "any");
    const outline_point outline[] = { { 1.0f, 0.0f }, { 1.2f, 0.5f }, { 0.5f, 1.0f } };
    m.lathe({ 0.0f, 0.0f, 0.0f }, outline, 12);
    m.bar({ 0.0f, 0.0f, 0.0f }, { 0.0f, 2.0f, 0.0f }, 0.1f, 8);
    add_tangents(s, 0, 0);
    check(s);
    for (std::size_t i = 0; i < s.tangents.size(); ++i) {
        CHECK(s.tangents[i].w == 1.0f);
        const glm::vec3 up = glm::cross(s.normals[i], glm::vec3(s.tangents[i]));
        if (std::abs(s.normals[i].y) < 0.5f)
            CHECK(up.y > 0.5f);
    }
}

TEST_CASE("rays pass through holes that alpha cuts", "[tools][gbuffer]")
{
    // A floor 2 x 2 whose picture is opaque on the left only, over a larger solid one.
    scene s;
    mesh_builder m(s);
    m.begin("cut", "cut", 0.5f);
    m.quad({ -1.0f, 1.0f, 1.0f }, { 1.0f, 1.0f, 1.0f }, { 1.0f, 1.0f, -1.0f }, { -1.0f, 1.0f, -1.0f });
    m.begin("solid", "solid");
    m.quad({ -4.0f, 0.0f, 4.0f }, { 4.0f, 0.0f, 4.0f }, { 4.0f, 0.0f, -4.0f }, { -4.0f, 0.0f, -4.0f });
    scene_texture t{ "half", 2, 1, false, {}, {}, { 255, 0, 0, 0, 0, 255, 255, 255 }, false };
    const bool from_red = GENERATE(false, true);
    const bool in_blend = GENERATE(false, true);
    s.textures.push_back(t);
    s.materials.resize(2);
    s.materials[0].alpha_map = 0;
    s.materials[0].alpha_from_red = from_red;
    if (in_blend) {
        s.blends.push_back({ 0, 1, 0.5f, ao::no_texture });
        s.object_material = { -1, 1 };
    }
    REQUIRE_FALSE(ao::validate(scene_view(s).get()));
    const ray_tree tree(s);
    const camera c = camera_above(0.0f, 3.0f, 0.0f, 40.0f);
    const gbuffer g = trace_gbuffer(s, tree, c, perspective(c, 1.0f, { 0.1f, 10.0f }), 32, 32);
    std::size_t upper = 0, through = 0;
    for (std::size_t i = 0; i < g.size(); ++i) {
        REQUIRE(g.hit[i] == 1);
        // Where this ray meets the upper floor, in its picture: u = x / 2, repeated; texel centres at 1/4 and 3/4, between
        // them alpha goes from one to the other. Red and alpha are each other's opposite.
        const double x = static_cast<double>(g.world[i].x) * 2.0 / (3.0 - static_cast<double>(g.world[i].y));
        const double z = static_cast<double>(g.world[i].z) * 2.0 / (3.0 - static_cast<double>(g.world[i].y));
        const double u = x / 2.0 - std::floor(x / 2.0);
        const bool opaque = (u > 0.5) != from_red;
        if (std::abs(u - 0.5) < 0.01 || u < 0.01 || u > 0.99 || std::abs(std::abs(z) - 1.0) < 0.01)
            continue;
        const bool inside = std::abs(x) < 1.0 && std::abs(z) < 1.0;
        CHECK(g.object[i] == (inside && opaque ? 0 : 1));
        CHECK(g.material[i] == (inside && opaque ? (in_blend ? 0xffffffffu : 0u) : 1u));
        upper += inside && opaque ? 1 : 0;
        through += inside && !opaque ? 1 : 0;
    }
    CHECK(upper > 100);
    CHECK(through > 100);
}

TEST_CASE("a scene of degenerate triangles has no ray tree", "[tools][scene]")
{
    scene s;
    add_floor(s, 1.0f);
    const std::size_t real = s.triangles.size();
    s.triangles.push_back({ 0, 0, 1 });
    s.object.push_back(0);
    s.material.push_back(0);
    CHECK(ray_tree(s).degenerate_count() == 1);
    CHECK(ray_tree(s).triangle_of(0, 0) < real);
    for (glm::vec3& p : s.positions)
        p = glm::vec3(1.0f);
    CHECK_THROWS_AS(ray_tree(s), error);
}

TEST_CASE("view space follows yaw and pitch", "[tools][camera]")
{
    camera c;
    c.eye = { 1.0f, 2.0f, 3.0f };
    c.yaw = GENERATE(0.0f, 37.0f, 90.0f, -135.0f);
    c.pitch = GENERATE(0.0f, -20.0f, 90.0f, -90.0f);
    const glm::mat4 view = view_matrix(c);
    const float yaw = c.yaw * 3.14159265f / 180.0f, pitch = c.pitch * 3.14159265f / 180.0f;
    const glm::vec3 f{ std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch) };
    CHECK(glm::length(forward(c) - f) < 1e-6f);
    CHECK(glm::length(glm::vec3(view * glm::vec4(c.eye + 2.0f * f, 1.0f)) - glm::vec3(0.0f, 0.0f, -2.0f)) < 1e-5f);
    const glm::mat3 r(view);
    CHECK(std::abs(glm::determinant(r) - 1.0f) < 1e-6f);
    CHECK(r[1].y >= -1e-6f); // world up is never drawn downward
    CHECK(std::abs(r[0].x * r[0].y + r[1].x * r[1].y + r[2].x * r[2].y) < 1e-6f);
}

TEST_CASE("a framed scene is wholly inside the picture and the depth range", "[tools][camera]")
{
    const float aspect = GENERATE(1.0f, 16.0f / 9.0f, 0.5f);
    const bounds b{ { -3.0f, 0.0f, 5.0f }, { 4.0f, 10.0f, 6.0f } };
    const camera c = frame(b, aspect);
    const depth_range range = clip_range(b, c);
    const frustum f = perspective(c, aspect, range);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 p{ (corner & 1) != 0 ? b.high.x : b.low.x, (corner & 2) != 0 ? b.high.y : b.low.y,
                           (corner & 4) != 0 ? b.high.z : b.low.z, 1.0f };
        const glm::vec3 v(view_matrix(c) * p);
        CHECK(-v.z > f.near);
        CHECK(-v.z < f.far);
        CHECK(v.x / -v.z > f.left);
        CHECK(v.x / -v.z < f.right);
        CHECK(v.y / -v.z > f.bottom);
        CHECK(v.y / -v.z < f.top);
    }
}

TEST_CASE("the G-buffer of a plane is its closed form", "[tools][gbuffer]")
{
    scene s;
    add_floor(s, 1000.0f);
    const ray_tree tree(s);
    camera c;
    c.eye = { 3.0f, 2.0f, 5.0f };
    c.yaw = 30.0f;
    c.pitch = -25.0f;
    c.fov = 70.0f;
    constexpr int width = 61, height = 37;
    frustum f = perspective(c, static_cast<float>(width) / height, { 0.1f, 500.0f });
    SECTION("symmetric") {}
    SECTION("off-centre")
    {
        f.left *= 0.3f, f.top *= 1.4f;
    }
    SECTION("orthographic")
    {
        f = orthographic(c, static_cast<float>(width) / height, 2.0f, { 0.1f, 500.0f });
    }
    const gbuffer g = trace_gbuffer(s, tree, c, f, width, height);

    const glm::dmat3 axes = view_axes(c);
    std::size_t hits = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * width + x);
            const double u =
                static_cast<double>(f.left) + (static_cast<double>(f.right) - static_cast<double>(f.left)) * (x + 0.5) / width;
            const double v =
                static_cast<double>(f.top) + (static_cast<double>(f.bottom) - static_cast<double>(f.top)) * (y + 0.5) / height;
            const glm::dvec3 from = f.orthographic ? glm::dvec3(c.eye) + axes * glm::dvec3(u, v, 0.0) : glm::dvec3(c.eye);
            const glm::dvec3 along = axes * (f.orthographic ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(u, v, -1.0));
            const double t = -from.y / along.y;
            const glm::dvec3 p = from + t * along;
            const bool hit = t > 0.1 && t < 500.0 && std::abs(p.x) < 1000.0 && std::abs(p.z) < 1000.0;
            REQUIRE((g.hit[i] != 0) == hit);
            if (!hit) {
                CHECK(g.depth[i] == 0.0f);
                CHECK(g.object[i] == nothing);
                CHECK(g.normal[i] == glm::vec3(0.0f));
                continue;
            }
            ++hits;
            CHECK(std::abs(static_cast<double>(g.depth[i]) - t) <= 1.2e-7 * t);
            CHECK(g.position[i].z == -g.depth[i]);
            CHECK(glm::length(glm::dvec3(g.world[i]) - p) < 1e-6 * (10.0 + t));
            CHECK(glm::length(glm::dvec3(g.normal[i]) - glm::transpose(axes) * glm::dvec3(0.0, 1.0, 0.0)) < 1e-6);
            CHECK(g.geometric_normal[i] == g.normal[i]);
            CHECK(g.object[i] == 0);
        }
    CHECK(hits > 300);
    CHECK(hits <= width * height);
}

TEST_CASE("normals are turned toward the viewer", "[tools][gbuffer]")
{
    const float side = GENERATE(1.0f, -1.0f);
    scene s;
    add_floor(s, 10.0f);
    SECTION("as made") {}
    SECTION("normals reversed")
    {
        for (glm::vec3& n : s.normals)
            n = -n;
    }
    SECTION("winding reversed")
    {
        for (glm::uvec3& t : s.triangles)
            std::swap(t.y, t.z);
    }
    camera c = camera_above(0.0f, 3.0f * side, 0.0f, 60.0f);
    c.pitch *= side;
    const gbuffer g = trace_gbuffer(s, ray_tree(s), c, perspective(c, 1.0f, { 0.1f, 10.0f }), 9, 9);
    for (std::size_t i = 0; i < g.size(); ++i) {
        REQUIRE(g.hit[i] == 1);
        CHECK(glm::length(g.normal[i] - glm::vec3(0.0f, 0.0f, 1.0f)) < 1e-6f);
        CHECK(glm::length(g.geometric_normal[i] - glm::vec3(0.0f, 0.0f, 1.0f)) < 1e-6f);
    }
}
