// Checking scenes, planning the geometry pass, and its mathematics.
#include "ao/gbuffer.hpp"
#include "unit/core_support.hpp"

#include <catch2/catch.hpp>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace core_test;

namespace {

const float infinite = std::numeric_limits<float>::infinity();

// A triangle with everything, a texture, two materials, one blend, one object, one light.
struct small_scene {
    std::vector<glm::vec3> positions{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
    std::vector<glm::vec3> normals{ 3, { 0, 0, 1 } };
    std::vector<glm::vec4> tangents{ 3, { 1, 0, 0, 1 } };
    std::vector<glm::vec2> uvs{ { 0, 0 }, { 1, 0 }, { 0, 1 } };
    std::vector<std::uint32_t> indices{ 0, 1, 2 };
    std::vector<std::uint8_t> texels = std::vector<std::uint8_t>(16, 100);
    std::vector<ao::mesh> meshes{ 1 };
    std::vector<ao::texture> textures{ 1 };
    std::vector<ao::standard_material> materials{ 2 };
    std::vector<ao::blend_node> blends{ { 0, 1, 0.5F, ao::no_texture } };
    std::vector<ao::object> objects{ 1 };
    std::vector<ao::light> lights{ 1 };
    ao::ambient_light ambient;

    small_scene() { textures[0].width = textures[0].height = 2; }
    ao::scene get()
    {
        meshes[0].positions = positions;
        meshes[0].normals = normals;
        meshes[0].tangents = tangents;
        meshes[0].uvs = uvs;
        meshes[0].indices = indices;
        textures[0].texels = texels;
        ao::scene s;
        s.meshes = meshes;
        s.textures = textures;
        s.materials = materials;
        s.blends = blends;
        s.objects = objects;
        s.lights = lights;
        s.ambient = ambient;
        return s;
    }
    std::string reason()
    {
        const auto wrong = ao::validate(get());
        return wrong ? std::string(wrong->reason()) : std::string();
    }
};

std::string reason_after(void (*change)(small_scene&))
{
    small_scene s;
    change(s);
    return s.reason();
}

ao::gbuffer_facts facts()
{
    ao::gbuffer_facts f;
    f.width = 64;
    f.height = 32;
    return f;
}

} // namespace

TEST_CASE("The first thing wrong with a scene is named", "[core][scene]")
{
    using s = small_scene;
    CHECK(reason_after([](s&) {}).empty());
    CHECK(reason_after([](s& x) { x.indices[1] = 3; }) == "mesh 0: index 3 of 3 vertices");
    CHECK(reason_after([](s& x) { x.indices.pop_back(); }) == "mesh 0: 2 indices are not three per triangle");
    CHECK(reason_after([](s& x) { x.normals.pop_back(); }) == "mesh 0: arrays of different lengths");
    CHECK(reason_after([](s& x) { x.textures[0].width = 0; }) == "texture 0: 0 x 2 pixels, must have 1 to 16384 a side");
    CHECK(reason_after([](s& x) { x.texels.pop_back(); }) == "texture 0: 15 bytes of texels instead of 16");
    CHECK(reason_after([](s& x) { x.materials[1].diffuse_map = 1; }) == "material 1: no texture 1");
    CHECK(reason_after([](s& x) { x.materials[1].normal_map = -2; }) == "material 1: no texture -2");
    CHECK(reason_after([](s& x) { x.materials[0].shininess = 8193; }) == "material 0: shininess is not in 0 to 8192");
    CHECK(reason_after([](s& x) { x.materials[0].shininess = std::nanf(""); }) == "material 0: shininess is not in 0 to 8192");
    CHECK(reason_after([](s& x) { x.materials[0].emission.y = infinite; }) == "material 0: a number that is not finite");
    CHECK(reason_after([](s& x) { x.blends[0].second = -1; }) == "blend 0 contains itself");
    CHECK(reason_after([](s& x) { x.blends[0].second = 9; }) == "blend 0: no material 9");
    CHECK(reason_after([](s& x) { x.blends[0].k = 2; }) == "blend 0: k is not a number in [0, 1]");
    CHECK(reason_after([](s& x) { x.objects[0].mesh = 1; }) == "object 0: no mesh 1");
    CHECK(reason_after([](s& x) { x.objects[0].material = 2; }) == "object 0: no material 2");
    CHECK(reason_after([](s& x) { x.objects[0].material = -2; }) == "object 0: no blend 1");
    CHECK(reason_after([](s& x) { x.objects[0].model[3][1] = std::nanf(""); }) == "object 0: a transform that is not finite");
    CHECK(reason_after([](s& x) { x.objects[0].model[0][3] = 1; }) == "object 0: a transform whose last row is not (0, 0, 0, 1)");
    CHECK(reason_after([](s& x) { x.lights[0].color.x = infinite; }) == "light 0: a number that is not finite");
    CHECK(reason_after([](s& x) { x.ambient.coefficients[3].x = infinite; }) == "ambient light: a number that is not finite");
    const auto maps = [](s& x) {
        x.uvs.clear();
        x.materials[1].diffuse_map = 0;
        x.objects[0].material = -1;
    };
    CHECK(reason_after(maps) == "object 0: its material has maps, mesh 0 no texture coordinates");
    const auto normal_map = [](s& x) {
        x.tangents.clear();
        x.materials[1].normal_map = 0;
        x.objects[0].material = -1;
    };
    CHECK(reason_after(normal_map) == "object 0: its material has a normal map, mesh 0 no tangents");
}

TEST_CASE("Triangles with vertices that are not finite are left out and counted", "[core][scene]")
{
    small_scene s;
    s.positions.push_back({ 0, infinite, 0 });
    s.positions.push_back({ std::nanf(""), 0, 0 });
    s.normals.clear();
    s.tangents.clear();
    s.uvs.clear();
    s.indices = { 0, 1, 2, 0, 1, 3, 4, 1, 2, 2, 1, 0 };
    const ao::scene scene = s.get();
    CHECK(ao::drawable_indices(scene.meshes[0]) == std::vector<std::uint32_t>{ 0, 1, 2, 2, 1, 0 });
    const auto plan = ao::plan_drawing(scene, facts());
    REQUIRE(plan);
    CHECK(plan->skipped_triangles == 2);
    REQUIRE(plan->draws.size() == 1);
    CHECK(plan->variants[0].flat_normals);
}

TEST_CASE("A variant holds what the object needs and no more", "[core][scene]")
{
    small_scene s;
    const auto variant = [&](const ao::gbuffer_facts& f) {
        const auto plan = ao::plan_drawing(s.get(), f);
        REQUIRE(plan);
        REQUIRE(plan->variants.size() == 1);
        return plan->variants[0];
    };
    CHECK(variant(facts()) == ao::draw_variant{});
    s.materials[0].diffuse_map = 0; // of no use to the geometry
    CHECK(variant(facts()) == ao::draw_variant{});
    ao::gbuffer_facts surface = facts();
    surface.surface = true;
    CHECK(variant(surface).uvs);
    s.materials[0].alpha_map = 0;
    CHECK(variant(facts()).alpha_map);
    CHECK(variant(facts()).uvs);
    s.materials[0].alpha_map = ao::no_texture;
    s.materials[0].normal_map = 0;
    CHECK(variant(facts()).normal_map);
    ao::gbuffer_facts no_normals = facts();
    no_normals.normals = ao::normal_source::from_depth;
    CHECK(variant(no_normals) == ao::draw_variant{});
    s.materials[0].normal_map = ao::no_texture;
    s.materials[0].two_sided = false;
    CHECK(variant(facts()).cull_back);
    s.objects[0].model[0][0] = -1;
    CHECK(variant(facts()).mirrored);
    s.objects[0].model[1][1] = -1;
    CHECK_FALSE(variant(facts()).mirrored);

    // Blends: maps of the first leaf; a frame where another leaf has its own normal map.
    s.objects[0].material = -1;
    s.materials[1].normal_map = 0;
    ao::gbuffer_facts frame = facts();
    frame.frame = true;
    CHECK(variant(frame).frame);
    CHECK_FALSE(variant(frame).normal_map);
    CHECK(ao::needs_frame(s.get()));
    s.materials[0].normal_map = 0;
    CHECK_FALSE(variant(frame).frame);
    CHECK(variant(frame).normal_map);
    CHECK_FALSE(ao::needs_frame(s.get()));
}

TEST_CASE("Motion is drawn with the depth of the last frame or without", "[core][scene]")
{
    small_scene s;
    ao::gbuffer_facts f = facts();
    for (const auto format :
         { ao::pixel_format::rg32f, ao::pixel_format::rgba32f, ao::pixel_format::rgba16f, ao::pixel_format::r32f }) {
        const bool known = format == ao::pixel_format::rg32f || format == ao::pixel_format::rgba32f;
        f.motion_format = format;
        f.motion = true;
        const auto plan = ao::plan_drawing(s.get(), f);
        CHECK(static_cast<bool>(plan) == known);
        if (!plan) {
            CHECK(plan.error().code() == ao::errc::unsupported_format);
        }
        f.motion = false;
        CHECK(ao::plan_drawing(s.get(), f));
    }
}

TEST_CASE("Draws are sorted, variants counted once, for a million objects over deep blends", "[core][scene]")
{
    small_scene s;
    s.materials[1].two_sided = false;
    s.blends.clear();
    for (int i = 0; i < 100000; ++i) {
        s.blends.push_back({ i == 0 ? 1 : -i, 0, 0.5F, ao::no_texture });
    }
    s.objects.resize(1000000);
    for (std::size_t i = 0; i < s.objects.size(); ++i) {
        s.objects[i].material = i % 3 == 0 ? -1 - static_cast<int>(i % 100000) : static_cast<int>(i % 2);
    }
    const auto plan = ao::plan_drawing(s.get(), facts());
    REQUIRE(plan);
    CHECK(plan->variants.size() == 2);
    CHECK(plan->draws.size() == 1000000);
    CHECK(std::is_sorted(plan->draws.begin(), plan->draws.end(), [](const ao::draw& a, const ao::draw& b) {
        return std::array{ a.variant, a.material, a.object } < std::array{ b.variant, b.material, b.object };
    }));
    CHECK(std::all_of(plan->draws.begin(), plan->draws.end(), [&](const ao::draw& d) {
        const int m = s.objects[static_cast<std::size_t>(d.object)].material;
        return d.material == (m < 0 ? 1 : m) &&
               plan->variants[static_cast<std::size_t>(d.variant)].cull_back == (d.material == 1);
    }));
    CHECK(ao::geometry_material(s.get(), -100000) == 1);
}

TEMPLATE_TEST_CASE("Normals go by the inverse transpose, mirroring maps included", "[core][scene]", float, double)
{
    using m = ao::math<TestType>;
    directions random(3);
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
        glm::dmat3 a =
            glm::dmat3(glm::rotate(glm::dmat4(1), 3 * uniform(engine), glm::dvec3(uniform(engine), 1, 0.5))) *
            glm::dmat3(glm::scale(glm::dmat4(1), glm::dvec3(std::exp2(3 * uniform(engine)), std::exp2(3 * uniform(engine)),
                                                            (i % 2 == 0 ? -1 : 1) * std::exp2(3 * uniform(engine)))));
        const auto row = [&](int r) {
            return typename m::vec4(static_cast<TestType>(a[0][r]), static_cast<TestType>(a[1][r]),
                                    static_cast<TestType>(a[2][r]), TestType(7));
        };
        const typename m::ao_affine_map map = { row(0), row(1), row(2) };
        const auto n = random.next();
        const glm::dvec3 exact = glm::normalize(glm::transpose(glm::inverse(a)) * glm::dvec3(n[0], n[1], n[2]));
        const typename m::vec3 turned =
            m::ao_normalize_or(m::ao_transform_normal(map, { static_cast<TestType>(n[0]), static_cast<TestType>(n[1]),
                                                             static_cast<TestType>(n[2]) }),
                               {});
        worst = std::max(worst, glm::length(glm::dvec3(turned) - exact));
    }
    CAPTURE(worst);
    CHECK(worst < (sizeof(TestType) == 4 ? 1e-5 : 1e-6));

    // A flat map keeps its only normal.
    const typename m::ao_affine_map flat = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 0, 0 } };
    CHECK(m::ao_transform_normal(flat, { 0, 0, 1 }).z == 1);
}

TEST_CASE("Normal maps: mirrored UVs, green up and down, non-uniform scale", "[core][scene]")
{
    // A plane whose uv and position are known in double: tangent = dp/du, bitangent = dp/dv, normal of the scaled plane.
    using m = ao::math<float>;
    std::mt19937 engine(17);
    std::uniform_real_distribution<double> uniform(-1, 1);
    double worst = 0;
    double packed_worst = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 3 * uniform(engine), glm::dvec3(uniform(engine), uniform(engine), 1.1)));
        const double stretch = std::exp2(2 * uniform(engine));
        const double mirrored = i % 2 == 0 ? -1 : 1;
        const double green = i % 4 < 2 ? 1 : -1;
        const glm::dvec3 along_u = turn[0] * stretch; // scaled along u only
        const glm::dvec3 along_v = turn[1] * mirrored;
        const glm::dvec3 normal = turn[2];
        const glm::dvec3 texel(0.5 + 0.4 * uniform(engine), 0.5 + 0.4 * uniform(engine), 0.75 + 0.25 * uniform(engine));
        const glm::dvec3 t = texel * 2.0 - 1.0;
        const glm::dvec3 exact =
            glm::normalize(glm::normalize(along_u) * t.x + glm::normalize(along_v) * t.y * green + normal * t.z);
        const glm::vec3 tangent(along_u);
        const float handedness = glm::dot(glm::cross(normal, along_u), along_v) < 0 ? -1.0F : 1.0F;
        const glm::vec3 mapped =
            m::ao_mapped_normal(glm::vec3(normal * 3.0), tangent, handedness, glm::vec3(texel), static_cast<float>(green));
        worst = std::max(worst, glm::length(glm::dvec3(mapped) - exact));
        const glm::vec4 packed = m::ao_packed_frame(glm::vec3(normal * 0.1), tangent, handedness);
        const glm::vec3 unpacked = m::ao_normal_of_frame(packed, glm::vec3(texel), static_cast<float>(green));
        packed_worst = std::max(packed_worst, glm::length(glm::dvec3(unpacked) - exact));
    }
    CAPTURE(worst, packed_worst);
    // Inputs round by 6e-8, each axis of the frame by 3e-7, and the mapped vector may be as short as 1/2. Octahedral coordinates
    // of both axes add as much again.
    CHECK(worst < 2e-6);
    CHECK(packed_worst < 4e-6);

    CHECK(m::ao_facing_normal({ 1, -2, 3 }, 1.0F) == glm::vec3(1, -2, 3));
    CHECK(m::ao_facing_normal({ 1, -2, 3 }, -1.0F) == glm::vec3(-1, 2, -3));
    // A flat texel, and tangents that are of no use.
    CHECK(m::ao_mapped_normal({ 0, 0, 2 }, { 0, 0, 1 }, 1, { 0.5F, 0.5F, 1 }, 1) == glm::vec3(0, 0, 1));
    CHECK(m::ao_mapped_normal({ 0, 0, 0 }, { std::nanf(""), 0, 1 }, 1, { 0.5F, 0.5F, 1 }, 1) == glm::vec3(0, 0, 1));
}
