#include "tools_support.hpp"

#include "scene/apart.hpp"
#include "scene/courtyard.hpp"
#include "scene/error.hpp"
#include "scene/load.hpp"
#include "scene/scene_bytes.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <atomic>
#include <csignal>
#include <functional>

namespace {

using namespace ao::tools;

std::string message_of(const std::string& path)
{
    try {
        (void)load_model(path);
    } catch (const error& e) {
        return e.what();
    }
    return {};
}

bool says(const std::string& message, const std::string& path, const std::string& reason)
{
    INFO(message);
    CHECK(message.find(path) == 0);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.find(reason) != std::string::npos);
    return message.find(reason) != std::string::npos;
}

constexpr const char* ply_header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                   "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

} // namespace

TEST_CASE("what cannot be loaded is one line that says why", "[tools][load]")
{
    const scratch_directory dir;
    const std::string missing = (dir.path / "no.obj").string();
    says(message_of(missing), missing, "no such file");
    says(message_of(dir.path.string()), dir.path.string(), "not a regular file");

    const auto bad = [&](const std::string& name, std::string_view text, const std::string& reason) {
        const std::string path = dir.file(name, text);
        INFO(name);
        says(message_of(path), path, reason);
    };
    bad("empty.obj", "", "empty");
    bad("unknown.xyzzy", "nothing of this world", ": ");
    bad("points.obj", "v 0 0 0\nv 1 0 0\n", ": ");
    bad("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "No meshes remaining");
    bad("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "vertex 2 of mesh 0");
    bad("inf.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n", "vertex 1 of mesh 0");
    bad("huge.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n", "beyond 1e18");
    bad("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", ": ");
    bad("range.ply", ply_header + std::string("0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"), ": ");
    bad("normal.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 0\nf 1//1 2//1 3//1\n", "normal is not finite");
    bad("half.glb", std::string_view("glTF\x02\0\0\0\xff\0\0\0", 12), ": ");
    bad("half.ply", std::string_view(ply_header).substr(0, 60), "truncated");
    bad("half.gltf", "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[{", ": ");
}

TEST_CASE("a child's crash, endless loop, error and answer reach the parent", "[tools][apart]")
{
    const auto message = [](const std::function<std::string()>& work) {
        try {
            return "answered " + run_apart("it", 1, work);
        } catch (const error& e) {
            return std::string(e.what());
        }
    };
    const std::string large(1 << 20, 'x');
    CHECK(message([&] { return large; }) == "answered " + large);
    CHECK(message([]() -> std::string { throw error("own words"); }) == "own words");
    CHECK(message([]() -> std::string {
              std::raise(SIGSEGV);
              return {};
          }).find("it: the reader crashed") == 0);
    CHECK(message([]() -> std::string {
              for (std::atomic<unsigned> i{ 0 };;)
                  ++i;
          }) == "it: gave up after 1 s");
}

TEST_CASE("a scene survives the way between processes", "[tools][apart]")
{
    scene s = courtyard();
    s.textures[1].missing = true;
    s.textures[2].wrap_v = ao::wrap_mode::mirror;
    s.warnings = { "one", "", "three" };
    const std::string bytes = to_bytes(s);
    const scene again = scene_from_bytes(bytes);
    CHECK(again.positions == s.positions);
    CHECK(again.triangles == s.triangles);
    CHECK(again.object == s.object);
    CHECK(again.object_names == s.object_names);
    CHECK(again.material_names == s.material_names);
    CHECK(again.uvs == s.uvs);
    CHECK(again.tangents == s.tangents);
    CHECK(again.object_material == s.object_material);
    CHECK(again.warnings == s.warnings);
    CHECK(to_bytes(again) == bytes);
    REQUIRE(again.textures.size() == s.textures.size());
    for (std::size_t i = 0; i < s.textures.size(); ++i) {
        CHECK(again.textures[i].name == s.textures[i].name);
        CHECK(again.textures[i].srgb == s.textures[i].srgb);
        CHECK(again.textures[i].wrap_v == s.textures[i].wrap_v);
        CHECK(again.textures[i].rgba == s.textures[i].rgba);
        CHECK(again.textures[i].missing == s.textures[i].missing);
    }
    CHECK_THROWS_AS(scene_from_bytes(bytes.substr(0, bytes.size() - 1)), error);
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 37)
        CHECK_THROWS_AS(scene_from_bytes(bytes.substr(0, size)), error);
}

TEST_CASE("polygons become triangles, missing normals those of the faces", "[tools][load]")
{
    const scratch_directory dir;
    const scene s = load_model(dir.file("roof.obj", "o left\nv 0 0 0\nv 0 0 1\nv -1 -1 1\nv -1 -1 0\nf 1 4 3 2\n"
                                                    "o right\nv 1 -1 0\nv 1 -1 1\nf 1 2 6 5\n"));
    CHECK(s.triangles.size() == 4);
    CHECK(s.object_names == std::vector<std::string>{ "left", "right" });
    CHECK_NOTHROW(check(s));
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 n = s.normals[s.triangles[t][corner]];
            const float side = s.object[t] == 0 ? -1.0f : 1.0f;
            CHECK(std::abs(glm::dot(n, glm::normalize(glm::vec3(side, 1.0f, 0.0f)))) == Approx(1.0f));
        }
}

TEST_CASE("the model's own normals are kept, zero ones replaced by the face's", "[tools][load]")
{
    const scratch_directory dir;
    const scene s = load_model(dir.file("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\nvn 0 0 0\n"
                                                 "f 1//1 2//1 3//2\n"));
    REQUIRE(s.triangles.size() == 1);
    CHECK(glm::length(s.normals[s.triangles[0].x] - glm::vec3(0.6f, 0.0f, 0.8f)) < 1e-6f);
    CHECK(glm::length(s.normals[s.triangles[0].z] - glm::vec3(0.0f, 0.0f, 1.0f)) < 1e-6f);
}

TEST_CASE("node transforms reach positions and normals", "[tools][load]")
{
    const scratch_directory dir;
    // One triangle under a node that scales by (2, 1, 1) and moves by 5 along x; data as base64 of nine floats.
    const scene s = load_model(dir.file("node.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"moved","mesh":0,"translation":[5,0,0],"scale":[2,1,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})"));
    const bounds b = bounds_of(s);
    CHECK(b.low == glm::vec3(5.0f, 0.0f, 0.0f));
    CHECK(b.high == glm::vec3(7.0f, 1.0f, 0.0f));
    CHECK(s.object_names == std::vector<std::string>{ "moved" });
    CHECK(glm::length(s.normals[0] - glm::vec3(0.0f, 0.0f, 1.0f)) < 1e-6f);
}

TEST_CASE("vertices with different texture coordinates stay apart", "[tools][load]")
{
    const scratch_directory dir;
    // Two triangles of one plane that share an edge, once with the same coordinates there, once with others.
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.25\n";
    CHECK(load_model(dir.file("joined.obj", vertices + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n")).positions.size() == 4);
    CHECK(load_model(dir.file("apart.obj", vertices + "f 1/1 2/2 3/3\nf 1/4 3/2 4/4\n")).positions.size() == 6);
}

TEST_CASE("triangles without area are counted", "[tools][load]")
{
    const scratch_directory dir;
    const scene s = load_model(dir.file("thin.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n"));
    CHECK(s.triangles.size() == 3);
    CHECK(count_degenerate(s) == 2);
}
