// Scenes at the ends of what is allowed, and just beyond: the largest textures, meshes that lack arrays or area, blends that
// contain themselves by a detour, a million objects.
#include "ao/drawing.hpp"
#include "ao/shading.hpp"
#include "ao/texture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

ao::gbuffer_facts facts()
{
    ao::gbuffer_facts f;
    f.width = 64;
    f.height = 32;
    return f;
}

std::string reason(const ao::scene& s)
{
    const auto wrong = ao::validate(s);
    return wrong ? std::string(wrong->reason()) : std::string();
}

} // namespace

TEST_CASE("Textures may have 16384 pixels a side and not one more", "[core][scene]")
{
    std::vector<std::uint8_t> row(std::size_t{ 4 } * 16385, 200);
    row[4 * 16383] = 100;
    ao::texture t;
    t.width = 16384;
    t.height = 1;
    t.wrap_u = ao::wrap_mode::clamp;
    t.texels = std::span(row).first(std::size_t{ 4 } * 16384);
    ao::scene s;
    s.textures = { &t, 1 };
    CHECK(reason(s).empty());
    const auto heap = ao::make_texel_heap({ &t, 1 });
    REQUIRE(heap);
    CHECK(ao::sample<float>(*heap, 0, { 1 - 0.5F / 16384, 0.5F }, 0).x == Approx(100 / 255.0));
    CHECK(ao::sample<float>(*heap, 0, { 0.5F, 0.5F }, 1).x == Approx(200 / 255.0).margin(1e-6));

    const std::string too_large = "texture 0: 16385 x 1 pixels, must have 1 to 16384 a side";
    t.width = 16385;
    t.texels = row;
    CHECK(reason(s) == too_large);
    CHECK(ao::make_texel_heap({ &t, 1 }).error().reason() == too_large);
    t.width = 1;
    t.height = -1;
    CHECK(reason(s) == "texture 0: 1 x -1 pixels, must have 1 to 16384 a side");

    // The largest of all is a valid one, and beyond the heap's limit. Its memory is never touched.
    const std::unique_ptr<void, void (*)(void*)> memory(std::calloc(std::size_t{ 1 } << 30U, 1), std::free);
    REQUIRE(memory);
    t.width = t.height = 16384;
    t.texels = { static_cast<const std::uint8_t*>(memory.get()), std::size_t{ 1 } << 30U };
    CHECK(reason(s).empty());
    const auto refused = ao::make_texel_heap({ &t, 1 });
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code() == ao::errc::out_of_memory);
    CHECK(refused.error().reason() == "textures 0 to 0 with their levels need 1366 MiB, the limit is 1024 MiB");
}

TEST_CASE("Meshes without normals have those of their triangles, whatever the triangles are", "[core][scene]")
{
    const std::vector<glm::vec3> positions{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 }, { 1, 0, 0 }, { 0, infinite, 0 }, { 0, 0, 7 } };
    const std::vector<std::uint32_t> indices{ 0, 1, 2, 2, 1, 0, 0, 3, 1, 0, 0, 0, 0, 4, 1, 0, 5, 2 };
    ao::mesh m;
    m.positions = positions;
    m.indices = indices;
    const ao::standard_material material;
    const ao::object object;
    ao::scene s;
    s.meshes = { &m, 1 };
    s.materials = { &material, 1 };
    s.objects = { &object, 1 };
    const auto plan = ao::plan_drawing(s, facts());
    REQUIRE(plan);
    CHECK(plan->skipped_triangles == 1);
    const ao::mesh_arrays arrays = ao::gather_meshes(s, *plan);
    const auto& normals = arrays.streams[ao::normal_attribute];
    REQUIRE(normals.size() == 3 * 3 * 5);
    const auto normal = [&](std::size_t triangle, std::size_t corner) {
        const std::size_t at = 9 * triangle + 3 * corner;
        return glm::vec3(normals[at], normals[at + 1], normals[at + 2]);
    };
    for (std::size_t corner = 0; corner < 3; ++corner) {
        CHECK(normal(0, corner) == glm::vec3(0, 0, 1));
        CHECK(normal(1, corner) == glm::vec3(0, 0, -1));
        CHECK(normal(2, corner) == glm::vec3(0, 0, 1)); // on a line
        CHECK(normal(3, corner) == glm::vec3(0, 0, 1)); // a point
        CHECK(normal(4, corner) == glm::vec3(-1, 0, 0));
    }
    CHECK(arrays.indices.size() == 15);
    CHECK(arrays.streams[ao::uv_attribute].empty());
    CHECK(arrays.streams[ao::tangent_attribute].empty());
}

TEST_CASE("A mesh without a triangle that can be drawn is not drawn", "[core][scene]")
{
    const std::vector<glm::vec3> positions{ { 0, 0, 0 }, { 2, 0, 0 }, { std::nanf(""), 3, 0 } };
    const std::vector<std::uint32_t> indices{ 0, 1, 2 };
    std::vector<ao::mesh> meshes(2);
    meshes[0].positions = positions;
    meshes[0].indices = indices;
    const ao::standard_material material;
    std::vector<ao::object> objects(2);
    objects[1].mesh = 1;
    ao::scene s;
    s.meshes = meshes;
    s.materials = { &material, 1 };
    s.objects = objects;
    const auto plan = ao::plan_drawing(s, facts());
    REQUIRE(plan);
    CHECK(plan->draws.empty());
    CHECK(plan->variants.empty());
    CHECK(plan->skipped_triangles == 1);

    const std::vector<std::uint32_t> beyond{ 0, 1, std::numeric_limits<std::uint32_t>::max() };
    meshes[0].indices = beyond;
    CHECK(ao::plan_drawing(s, facts()).error().reason() == "mesh 0: index 4294967295 of 3 vertices");
    meshes[0].positions = {};
    meshes[0].indices = indices;
    CHECK(ao::plan_drawing(s, facts()).error().reason() == "mesh 0: index 2 of 0 vertices");
}

TEST_CASE("Every plan refuses blends that contain themselves, and takes those that share", "[core][scene]")
{
    const ao::mesh none;
    const std::vector<ao::standard_material> materials(2);
    ao::object object;
    object.material = -1;
    std::vector<ao::blend_node> blends{ { -2, 0 }, { 1, -3 }, { -4, -4 }, { 0, 1 } };
    ao::scene s;
    s.meshes = { &none, 1 };
    s.materials = materials;
    s.objects = { &object, 1 };
    s.blends = blends;
    ao::shade_facts f;
    f.width = f.height = 1;
    const ao::shade_camera camera{ ao::make_projection({}), {} };
    const auto shared = ao::make_shade_plan(s, f, camera);
    REQUIRE(shared);
    CHECK(shared->blends[0].mixes == 4);
    CHECK(shared->blends[0].leaves == 4);
    CHECK(ao::plan_drawing(s, facts()));
    blends[3].second = -2;
    const std::string text = "blend 1 contains itself";
    CHECK(reason(s) == text);
    CHECK(ao::plan_drawing(s, facts()).error().reason() == text);
    CHECK(ao::make_shade_plan(s, f, camera).error().reason() == text);

    // A circle of a million.
    blends.assign(1000000, { 0, 0 });
    for (int i = 0; i < 1000000; ++i) {
        blends[static_cast<std::size_t>(i)].first = -1 - (i + 1) % 1000000;
    }
    s.blends = blends;
    CHECK(reason(s) == "blend 0 contains itself");
}

TEST_CASE("A million objects are uploaded as instances of one draw", "[core][scene]")
{
    const std::vector<glm::vec3> positions{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 } };
    const std::vector<std::uint32_t> indices{ 0, 1, 2 };
    ao::mesh m;
    m.positions = m.normals = positions;
    m.indices = indices;
    const ao::standard_material material;
    std::vector<ao::object> objects(1000000);
    ao::scene s;
    s.meshes = { &m, 1 };
    s.materials = { &material, 1 };
    s.objects = objects;
    const auto plan = ao::plan_drawing(s, facts());
    REQUIRE(plan);
    const ao::indirect_draws draws = ao::make_draws(s, *plan, ao::gather_meshes(s, *plan), false);
    REQUIRE(draws.draws.size() == 1);
    CHECK(draws.draws[0].instances == 1000000);
    CHECK(draws.batches.size() == 1);
    objects[999999].material = 1;
    CHECK(ao::plan_drawing(s, facts()).error().reason() == "object 999999: no material 1");
}
