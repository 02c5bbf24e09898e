#include "tools_pictures.hpp"

#include "ao/scene_check.hpp"
#include "scene/drawn.hpp"
#include "scene/load.hpp"
#include "scene/tangents.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstring>

namespace {

using namespace ao::tools;

constexpr std::array<std::uint8_t, 4> red{ 255, 0, 0, 255 }, glass{ 10, 200, 30, 64 };

// One quad in the plane z = 0 from (0, 0) to (1, 1), v upward along y, u along x; `material`: lines of an MTL file.
scene load_obj(const scratch_directory& dir, const std::string& material, bool uvs = true)
{
    dir.file("m.mtl", "newmtl paint\n" + material);
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    return load_model(dir.file("m.obj", "mtllib m.mtl\n" + vertices + "o quad\nusemtl paint\n" +
                                            (uvs ? "f 1/1 2/2 3/3 4/4\n" : "f 1 2 3 4\n")));
}

const ao::standard_material& material_of(const scene& s)
{
    REQUIRE_FALSE(ao::validate(scene_view(s).get()));
    return s.materials[s.material[0]];
}

// The same quad as glTF, v downward along -y; `tangent`, where not 0, is that of all vertices with this w.
scene load_gltf(const scratch_directory& dir, const std::string& material, const std::string& more = "", float tangent_w = 0.0f,
                const std::string& node = "")
{
    const std::vector<float> positions{ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
    const std::vector<float> uvs{ 0, 1, 1, 1, 1, 0, 0, 0 };
    std::string bytes;
    const auto add = [&](const auto& values) {
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
    };
    add(positions);
    add(uvs);
    add(std::vector<std::uint32_t>{ 0, 1, 2, 0, 2, 3 });
    for (int i = 0; i < 4; ++i)
        add(std::vector<float>{ 1, 0, 0, tangent_w });
    dir.file("m.bin", bytes);
    const std::string attribute = tangent_w != 0.0f ? R"(,"TANGENT":3)" : "";
    const std::string normals = tangent_w != 0.0f ? R"(,"NORMAL":4)" : "";
    std::string up;
    for (int i = 0; i < 4; ++i)
        up.append("\0\0\0\0\0\0\0\0\0\0\x80\x3f", 12);
    dir.file("n.bin", up);
    return load_model(dir.file("m.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"quad","mesh":0)" + node + R"(}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1)" +
                                             attribute + normals + R"(},"indices":2,"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"componentType":5125,"count":6,"type":"SCALAR"},
{"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"},{"bufferView":4,"componentType":5126,"count":4,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
{"buffer":0,"byteOffset":80,"byteLength":24},{"buffer":0,"byteOffset":104,"byteLength":64},{"buffer":1,"byteLength":48}],
"buffers":[{"byteLength":168,"uri":"m.bin"},{"byteLength":48,"uri":"n.bin"}],
"materials":[)" + material + "]" + more + "}"));
}

const std::string two_images = R"(,"images":[{"uri":"a.png"},{"uri":"b.png"}],
"samplers":[{"wrapS":33071,"wrapT":33648}],
"textures":[{"source":0},{"source":1},{"source":0,"sampler":0}])";

// Every corner's place in the picture must be where it lies on the quad, (0, 0) at its upper left.
void check_uvs(const scene& s)
{
    REQUIRE(s.uvs.size() == s.positions.size());
    for (std::size_t i = 0; i < s.uvs.size(); ++i)
        CHECK(glm::length(s.uvs[i] - glm::vec2(s.positions[i].x, 1.0f - s.positions[i].y)) < 1e-6f);
}

void check_tangents(const scene& s, const glm::vec4& expected)
{
    REQUIRE(s.tangents.size() == s.positions.size());
    for (const glm::vec4& t : s.tangents)
        CHECK(glm::length(t - expected) < 1e-6f);
}

} // namespace

TEST_CASE("a material library's maps, colors and highlight arrive", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(4, 4, red, glass)));
    dir.file("mask.png", opaque_png_of(two_rows(4, 4, red, { 0, 0, 0, 255 })));
    dir.file("n.png", png_of(two_rows(4, 4, { 128, 128, 255, 255 }, { 128, 200, 230, 255 })));
    const scene s = load_obj(dir, "Ka 0 0 0\nKd 0.5 0.25 1\nKs 0.1 0.2 0.3\nKe 0 0.5 0\nNs 20\nillum 2\n"
                                  "map_Kd a.png\nmap_d mask.png\nmap_Ks a.png\nnorm n.png\n");
    const ao::standard_material& m = material_of(s);
    CHECK(m.diffuse == glm::vec3(0.5f, 0.25f, 1.0f));
    CHECK(m.ambient == m.diffuse);
    CHECK(m.specular == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(m.emission == glm::vec3(0.0f, 0.5f, 0.0f));
    CHECK(m.shininess == 20.0f);
    CHECK(m.model == ao::specular_model::phong);
    CHECK(m.two_sided);
    REQUIRE(m.diffuse_map != ao::no_texture);
    REQUIRE(m.alpha_map != ao::no_texture);
    REQUIRE(m.normal_map != ao::no_texture);
    CHECK(m.specular_map == m.diffuse_map);
    CHECK(m.alpha_from_red);
    CHECK(m.alpha_cutoff == 0.5f);
    CHECK_FALSE(m.normal_green_down);
    const auto texture = [&](int i) -> const scene_texture& { return s.textures[static_cast<std::size_t>(i)]; };
    CHECK(texture(m.diffuse_map).srgb);
    CHECK_FALSE(texture(m.alpha_map).srgb);
    CHECK_FALSE(texture(m.normal_map).srgb);
    CHECK(texture(m.diffuse_map).rgba == two_rows(4, 4, red, glass).rgba);
    CHECK(s.warnings.empty());
    check_uvs(s);
    // Green is up: along +y.
    check_tangents(s, { 1.0f, 0.0f, 0.0f, 1.0f });
}

TEST_CASE("what a material library leaves open", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(4, 4, red, glass)));
    SECTION("a black factor of a map is none")
    {
        CHECK(material_of(load_obj(dir, "Kd 0 0 0\nmap_Kd a.png\n")).diffuse == glm::vec3(1.0f));
        CHECK(material_of(load_obj(dir, "Kd 0 0 0\n")).diffuse == glm::vec3(0.0f));
    }
    SECTION("no highlight")
    {
        CHECK(material_of(load_obj(dir, "Ks 1 1 1\nNs 0\nillum 2\n")).specular == glm::vec3(0.0f));
        CHECK(material_of(load_obj(dir, "Ks 1 1 1\nNs 10\nillum 1\n")).specular == glm::vec3(0.0f));
        CHECK(material_of(load_obj(dir, "Ks 1 1 1\nNs 1e9\nillum 2\n")).shininess == 8192.0f);
    }
    SECTION("alpha in the alpha channel of the color's own file")
    {
        const scene s = load_obj(dir, "map_Kd a.png\nmap_d a.png\n");
        const ao::standard_material& m = material_of(s);
        CHECK(m.alpha_map == m.diffuse_map);
        CHECK_FALSE(m.alpha_from_red);
        CHECK(s.textures.size() == 1);
    }
    SECTION("color with an alpha channel that nobody asked for")
    {
        CHECK(material_of(load_obj(dir, "map_Kd a.png\n")).alpha_map == ao::no_texture);
    }
    SECTION("clamped")
    {
        const scene s = load_obj(dir, "map_Kd -clamp on a.png\n");
        CHECK(s.textures[0].wrap_u == ao::wrap_mode::clamp);
        CHECK(s.textures[0].wrap_v == ao::wrap_mode::clamp);
    }
    SECTION("bumps that are heights become normals")
    {
        dir.file("h.png", png_of(two_rows(4, 8, { 0, 0, 0, 255 }, { 255, 255, 255, 255 })));
        const scene s = load_obj(dir, "map_bump -bm 0.5 h.png\n");
        const scene_texture& t = s.textures[static_cast<std::size_t>(material_of(s).normal_map)];
        CHECK_FALSE(t.srgb);
        // Row 4 is where the height grows downward: half a step, slope 2 * 0.5 / 2, so it leans up.
        const double up = 0.5 / std::sqrt(1.25);
        const std::size_t at = 4 * 4 * 4;
        CHECK(std::abs(t.rgba[at] - 127.5) <= 1.0);
        CHECK(std::abs(t.rgba[at + 1] - 127.5 * (1.0 + up)) <= 1.0);
        CHECK(t.rgba[0 + 1] < 100); // across the edge of the picture: the other way
    }
    SECTION("the last picture of the file is not there")
    {
        const scene s = load_obj(dir, "map_Kd no.jpg\nmap_bump no.jpg\n");
        (void)material_of(s);
        REQUIRE(s.textures.size() == 2);
        CHECK(s.textures[0].missing);
        CHECK(s.textures[0].name == "no.jpg");
        REQUIRE(s.warnings.size() == 1);
        CHECK(s.warnings[0] == s.name + ": texture 'no.jpg': no such file; a checkerboard stands in");
    }
}

TEST_CASE("without texture coordinates a mesh goes without maps", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(4, 4, red, glass)));
    const scene s = load_obj(dir, "Kd 0.5 0.5 0.5\nmap_Kd a.png\nmap_d a.png\nnorm a.png\n", false);
    const ao::standard_material& m = material_of(s);
    CHECK(m.diffuse == glm::vec3(0.5f));
    CHECK(m.diffuse_map == ao::no_texture);
    CHECK(m.alpha_map == ao::no_texture);
    CHECK(m.normal_map == ao::no_texture);
    CHECK(s.material_names[s.material[0]] == "paint without maps");
    REQUIRE(s.warnings.size() == 1);
    CHECK(s.warnings[0] == s.name + ": 'quad' has no texture coordinates for material 'paint', whose maps are left out there");
}

TEST_CASE("glTF's alpha modes", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(4, 4, red, glass)));
    dir.file("b.png", opaque_png_of(two_rows(4, 4, red, glass)));
    const auto load = [&](const std::string& mode, const std::string& base) {
        const scene s = load_gltf(dir, R"({"pbrMetallicRoughness":{)" + base + "}" + mode + "}", two_images);
        return material_of(s);
    };
    const std::string with_alpha = R"("baseColorTexture":{"index":0})", without = R"("baseColorTexture":{"index":1})";
    CHECK(load("", with_alpha).alpha_map == ao::no_texture);
    CHECK(load(R"(,"alphaMode":"OPAQUE")", with_alpha).alpha_map == ao::no_texture);
    CHECK(load(R"(,"alphaMode":"MASK")", without).alpha_map == ao::no_texture);
    const ao::standard_material mask = load(R"(,"alphaMode":"MASK","alphaCutoff":0.25)", with_alpha);
    CHECK(mask.alpha_map == mask.diffuse_map);
    CHECK(mask.alpha_map != ao::no_texture);
    CHECK_FALSE(mask.alpha_from_red);
    CHECK(mask.alpha_cutoff == 0.25f);
    CHECK(load(R"(,"alphaMode":"MASK")", with_alpha).alpha_cutoff == 0.5f);
    CHECK(load(R"(,"alphaMode":"BLEND","alphaCutoff":0.25)", with_alpha).alpha_cutoff == 0.5f);
    // The factor multiplies the texel.
    CHECK(load(R"(,"alphaMode":"MASK","alphaCutoff":0.25)", R"("baseColorFactor":[1,1,1,0.5],)" + with_alpha).alpha_cutoff ==
          0.5f);
}

TEST_CASE("glTF's materials", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(4, 4, red, glass)));
    dir.file("b.png", png_of(two_rows(4, 4, { 128, 128, 255, 255 }, red)));
    const scene s = load_gltf(dir, R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1],"baseColorTexture":{"index":2},
"roughnessFactor":0.5},"normalTexture":{"index":1},"emissiveFactor":[0,0.5,0],"doubleSided":true})",
                              two_images);
    const ao::standard_material& m = material_of(s);
    CHECK(m.diffuse == glm::vec3(0.5f, 0.25f, 1.0f));
    CHECK(m.emission == glm::vec3(0.0f, 0.5f, 0.0f));
    CHECK(m.two_sided);
    CHECK(m.model == ao::specular_model::blinn);
    CHECK(m.shininess == Approx(30.0));
    CHECK(m.specular == glm::vec3(0.04f));
    REQUIRE(m.diffuse_map != ao::no_texture);
    REQUIRE(m.normal_map != ao::no_texture);
    const scene_texture& color = s.textures[static_cast<std::size_t>(m.diffuse_map)];
    CHECK(color.srgb);
    CHECK(color.wrap_u == ao::wrap_mode::clamp);
    CHECK(color.wrap_v == ao::wrap_mode::mirror);
    CHECK(color.rgba == two_rows(4, 4, red, glass).rgba);
    CHECK_FALSE(s.textures[static_cast<std::size_t>(m.normal_map)].srgb);
    check_uvs(s);
    check_tangents(s, { 1.0f, 0.0f, 0.0f, 1.0f });
    CHECK_FALSE(material_of(load_gltf(dir, R"({"name":"plain"})")).two_sided);
}

TEST_CASE("tangents of the file are kept, under mirroring nodes, too", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(4, 4, red, glass)));
    dir.file("b.png", png_of(two_rows(4, 4, { 128, 128, 255, 255 }, red)));
    const std::string bumpy = R"({"normalTexture":{"index":1}})";
    const float w = GENERATE(1.0f, -1.0f);
    check_tangents(load_gltf(dir, bumpy, two_images, w), { 1.0f, 0.0f, 0.0f, w });
    // Mirrored in x, what was up in the picture still is, and u runs the other way.
    const scene s = load_gltf(dir, bumpy, two_images, w, R"(,"scale":[-2,1,1])");
    check_tangents(s, { -1.0f, 0.0f, 0.0f, -w });
    // The front stays in front.
    const glm::uvec3 t = s.triangles[0];
    const glm::vec3 a = s.positions[t.x];
    CHECK(glm::dot(glm::cross(s.positions[t.y] - a, s.positions[t.z] - a), s.normals[t.x]) > 0.0f);
}

TEST_CASE("texture transforms of glTF", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("a.png", png_of(two_rows(4, 4, red, glass)));
    dir.file("b.png", png_of(two_rows(4, 4, red, glass)));
    const auto load = [&](const std::string& transform) {
        return load_gltf(dir,
                         R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{)" +
                             transform + "}}}}}",
                         two_images + R"(,"extensionsUsed":["KHR_texture_transform"])");
    };
    const auto expect = [](const scene& s, const std::function<glm::vec2(glm::vec2)>& place) {
        for (std::size_t i = 0; i < s.uvs.size(); ++i) {
            const glm::vec2 own(s.positions[i].x, 1.0f - s.positions[i].y);
            const glm::vec2 drawn = s.uvs[i] * material_of(s).repeat;
            CHECK(glm::length(drawn - place(own)) < 1e-5f);
        }
    };
    const scene scaled = load(R"("scale":[3,2])");
    CHECK(glm::length(material_of(scaled).repeat - glm::vec2(3.0f, 2.0f)) < 1e-6f);
    expect(scaled, [](glm::vec2 uv) { return uv * glm::vec2(3.0f, 2.0f); });
    expect(load(R"("offset":[0.25,0.5],"scale":[3,2])"),
           [](glm::vec2 uv) { return uv * glm::vec2(3.0f, 2.0f) + glm::vec2(0.25f, 0.5f); });
    // offset + rotation * scale * uv, counter-clockwise where v is downward.
    expect(load(R"("offset":[0.25,0.5],"scale":[3,2],"rotation":0.5)"), [](glm::vec2 uv) {
        const float c = std::cos(0.5f), n = std::sin(0.5f), u = 3.0f * uv.x, v = 2.0f * uv.y;
        return glm::vec2(0.25f + c * u + n * v, 0.5f - n * u + c * v);
    });
}

TEST_CASE("mirrored texture coordinates split the vertices between", "[tools][materials]")
{
    const scratch_directory dir;
    dir.file("n.png", png_of(two_rows(4, 4, { 128, 128, 255, 255 }, red)));
    dir.file("m.mtl", "newmtl paint\nnorm n.png\n");
    // Two quads side by side in z = 0 that share the edge x = 0, where u is 1; u falls to 0 on both sides. The normals are
    // shared.
    const scene s = load_model(dir.file("m.obj", "mtllib m.mtl\nv -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv 1 0 0\nv 1 1 0\n"
                                                 "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl paint\n"
                                                 "f 1/1/1 2/2/1 3/3/1 4/4/1\nf 2/2/1 5/1/1 6/4/1 3/3/1\n"));
    REQUIRE_FALSE(ao::validate(scene_view(s).get()));
    CHECK(s.positions.size() == 8);
    for (const glm::uvec3& t : s.triangles) {
        const float middle = s.positions[t.x].x + s.positions[t.y].x + s.positions[t.z].x;
        const float side = middle < 0.0f ? 1.0f : -1.0f;
        for (int corner = 0; corner < 3; ++corner) {
            // u along +x on the left, -x on the right; the bitangent is +y on both.
            const glm::vec4 tangent = s.tangents[t[corner]];
            CHECK(glm::length(tangent - glm::vec4(side, 0.0f, 0.0f, side)) < 1e-6f);
            const glm::vec3 bitangent = tangent.w * glm::cross(s.normals[t[corner]], glm::vec3(tangent));
            CHECK(glm::length(bitangent - glm::vec3(0.0f, 1.0f, 0.0f)) < 1e-6f);
        }
    }
}

TEST_CASE("tangents are weighted by angle, not by number or area of triangles", "[tools][materials]")
{
    // A fan about the origin: 90 degrees with u along x; 90 degrees, cut into nine, with u along (x + y) / sqrt 2.
    scene s;
    const auto add = [&](float degrees, float reach, bool turned) {
        const float angle = degrees * 3.14159265f / 180.0f;
        const glm::vec3 p(reach * std::cos(angle), reach * std::sin(angle), 0.0f);
        s.positions.push_back(p);
        s.normals.push_back({ 0.0f, 0.0f, 1.0f });
        const float h = std::sqrt(0.5f);
        s.uvs.push_back(turned ? glm::vec2(h * (p.x + p.y), h * (p.x - p.y)) : glm::vec2(p.x, -p.y));
        return static_cast<std::uint32_t>(s.positions.size() - 1);
    };
    const std::uint32_t centre = add(0.0f, 0.0f, false);
    const std::uint32_t first = add(0.0f, 5.0f, false), last = add(90.0f, 5.0f, false);
    s.triangles.push_back({ centre, first, last });
    for (int i = 0; i < 9; ++i) {
        const float from = 90.0f + 10.0f * static_cast<float>(i);
        const std::uint32_t a = add(from, 1.0f, true), b = add(from + 10.0f, 1.0f, true);
        s.triangles.push_back({ centre, a, b });
    }
    // No area in the picture: it counts for nothing.
    const std::uint32_t flat = add(0.0f, 1.0f, true);
    s.triangles.push_back({ centre, flat, flat });
    add_tangents(s, 0, 0);
    CHECK(s.positions.size() == s.tangents.size());
    const float half = 22.5f * 3.14159265f / 180.0f;
    CHECK(glm::length(s.tangents[centre] - glm::vec4(std::cos(half), std::sin(half), 0.0f, 1.0f)) < 1e-5f);
    for (std::size_t i = 0; i < s.tangents.size(); ++i) {
        CHECK(glm::length(glm::vec3(s.tangents[i])) == Approx(1.0f));
        CHECK(std::abs(s.tangents[i].z) < 1e-6f);
    }
}
