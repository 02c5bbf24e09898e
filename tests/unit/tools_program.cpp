// The program `ao` as a user meets it. AO_PROGRAM is its path.
#include "program_run.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <optional>
#include <vector>

namespace {

// For the programs started during its life.
class environment_value {
public:
    environment_value(const char* which, const char* value) : name(which)
    {
        if (const char* before = std::getenv(name))
            old = before;
        ::setenv(name, value, 1);
    }
    environment_value(const environment_value&) = delete;
    environment_value& operator=(const environment_value&) = delete;
    ~environment_value()
    {
        if (old)
            ::setenv(name, old->c_str(), 1);
        else
            ::unsetenv(name);
    }

private:
    const char* name;
    std::optional<std::string> old;
};

} // namespace

TEST_CASE("bad requests end with one line and status 1", "[tools][program]")
{
    using words = std::vector<std::string>;
    const scratch_directory dir;
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::string nan = dir.file("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    const std::string infinite = dir.file("infinite.obj", "v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n");
    const std::string empty = dir.file("empty.obj", "");
    const std::string no_faces = dir.file("no_faces.obj", triangle);
    const std::string out_of_range = dir.file("out_of_range.obj", triangle + "f 1 2 9\n");
    const std::string cut_text = dir.file("cut.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[");
    const std::string cut_binary = dir.file("cut.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1000\n"
                                                       "property float x\nproperty float y\nproperty float z\n"
                                                       "element face 100\nproperty list uchar int vertex_indices\n"
                                                       "end_header\nabc");
    const std::string blend = dir.file("blend.json", "{\"blends\": {\n  \"x\": {\"first\": \"no such material\"}}}");
    const std::string lights = dir.file("lights.json", "{\"lights\": [\n  {\"type\": \"spot\"}]}");
    const std::string no_json = dir.file("no.json", "{");
    const std::size_t count = files_in(dir.path);
    const std::pair<words, std::string> cases[] = {
        { {}, "subcommand" },
        { { "render" }, "SCENE" },
        { { "render", "missing.obj" }, "no such file" },
        { { "render", dir.path.string() }, "not a regular file" },
        { { "render", empty }, "empty" },
        { { "render", nan }, "vertex 2" },
        { { "render", infinite }, "vertex 2" },
        { { "render", no_faces }, "no_faces.obj" },
        { { "render", out_of_range }, "out_of_range.obj" },
        { { "render", cut_text }, "cut.gltf" },
        { { "render", cut_binary }, "cut.ply" },
        { { "render", "courtyard", "--taps", "0" }, "taps" },
        { { "render", "courtyard", "--taps", "1000000" }, "taps" },
        { { "render", "courtyard", "--taps", "many" }, "--taps" },
        { { "render", "courtyard", "--radius", "0" }, "radius" },
        { { "render", "courtyard", "--radius", "-1" }, "radius" },
        { { "render", "courtyard", "--radius", "1e30" }, "radius" },
        { { "render", "courtyard", "--radius", "nan" }, "radius" },
        { { "render", "courtyard", "--bias", "-0.1" }, "bias" },
        { { "render", "courtyard", "--bias", "inf" }, "bias" },
        { { "render", "courtyard", "--thickness", "0" }, "thickness" },
        { { "render", "courtyard", "--thickness", "nan" }, "thickness" },
        { { "render", "courtyard", "--filter", "4" }, "filter" },
        { { "render", "courtyard", "--filter", "0" }, "filter" },
        { { "render", "courtyard", "--filter", "33" }, "filter" },
        { { "render", "courtyard", "--method", "cube" }, "--method" },
        { { "render", "courtyard", "--backend", "metal" }, "--backend" },
        { { "render", "courtyard", "--lanes", "3" }, "--lanes" },
        { { "render", "courtyard", "--route", "raster" }, "--route" },
        { { "render", "courtyard", "--size", "0x4" }, "--size" },
        { { "render", "courtyard", "--size", "0x0" }, "--size" },
        { { "render", "courtyard", "--size", "100000x1" }, "--size" },
        { { "render", "courtyard", "--size", "99999x99999" }, "--size" },
        { { "render", "courtyard", "--size", "5x" }, "--size" },
        { { "render", "courtyard", "--eye", "1,2" }, "--eye" },
        { { "render", "courtyard", "--eye", "1,2,inf" }, "--eye" },
        { { "render", "courtyard", "--eye", "nan,0,0" }, "--eye" },
        { { "render", "courtyard", "--eye", "0,1,0", "--yaw", "nan" }, "--yaw" },
        { { "render", "courtyard", "--eye", "0,1,0", "--pitch", "nan" }, "--pitch" },
        { { "render", "courtyard", "--yaw", "10" }, "--eye" },
        { { "render", "courtyard", "--fov", "180" }, "--fov" },
        { { "render", "courtyard", "--fov", "nan" }, "--fov" },
        { { "render", "courtyard", "--frames", "0" }, "--frames" },
        { { "render", "courtyard", "--seed", "-1" }, "--seed" },
        { { "render", "courtyard", "--reference", "3" }, "--reference" },
        { { "render", "courtyard", "--projection", "fisheye" }, "--projection" },
        { { "render", "courtyard", "--projection", "parallel,infinite" }, "--projection" },
        { { "render", "courtyard", "--json", "missing/a.json" }, "missing/a.json" },
        { { "render", "courtyard", "--json", dir.path.string() }, "cannot write" },
        { { "render", "courtyard", "--backend", "cpu", "--size", "32x18", "--frames", "1", "--json", "/dev/full" }, "/dev/full" },
        { { "render", "courtyard", "--out", nan }, nan },
        { { "render", "courtyard", "--out", nan + "/inside" }, nan },
        { { "render", "courtyard", "--out", "/proc/pictures" }, "/proc/pictures" },
        { { "render", "courtyard", "--colour", "red" }, "--colour" },
        { { "render", "courtyard", "--gbuffer", "film" }, "--gbuffer" },
        { { "render", "courtyard", "--depth", "linear" }, "--depth linear" },
        { { "render", "courtyard", "--shade", "--normals", "none" }, "--shade needs normals" },
        { { "render", "courtyard", "--blend", blend }, "--blend needs --shade" },
        { { "render", "courtyard", "--lights", "none" }, "--lights needs --shade" },
        { { "render", "courtyard", "--shade", "--blend", blend }, "blend.json:2:8: /blends/x: has no member 'second'" },
        { { "render", "courtyard", "--shade", "--blend", "missing.json" }, "missing.json: no such file" },
        { { "render", "courtyard", "--shade", "--blend", no_json }, "no.json:1:" },
        { { "render", "courtyard", "--shade", "--blend", dir.path.string() }, "not a regular file" },
        { { "render", "courtyard", "--shade", "--lights", lights }, "lights.json:2:12: /lights/0/type" },
        { { "render", "courtyard", "--shade", "--lights", "missing.json" }, "missing.json: no such file" },
        { { "render", "courtyard", "--shade", "--lights", no_json }, "no.json:1:" },
    };
    for (const auto& [arguments, reason] : cases)
        check_failure(dir, arguments, reason);
    CHECK(files_in(dir.path) == count + 2); // and the two streams
}

TEST_CASE("a device that is not there ends with one line and status 1", "[tools][program]")
{
    const scratch_directory dir;
    const auto request = [](const std::string& backend, const std::string& device) {
        return std::vector<std::string>{ "render", "courtyard", "--backend", backend, "--device", device, "--size", "32x18" };
    };
#ifdef AO_HAS_GL
    check_failure(dir, request("gl", "nonsense"), "ao: gl: no GL");
    {
        const environment_value old_gl("MESA_GL_VERSION_OVERRIDE", "3.3");
        check_failure(dir, request("gl", ""), "ao: gl: no GL context");
    }
#endif
#ifdef AO_HAS_VK
    check_failure(dir, request("vk", "nonsense"), "\"nonsense\"");
    {
        const environment_value no_driver("VK_ICD_FILENAMES", "/nonexistent");
        check_failure(dir, request("vk", ""), "ao: vk: no Vulkan device");
    }
#endif
    CHECK(files_in(dir.path) <= 2);
}

TEST_CASE("the narrowest pictures are pictures", "[tools][program]")
{
    const scratch_directory dir;
    for (const char* size : { "1x1", "1x7", "4097x1" }) {
        const std::string json = (dir.path / "numbers.json").string();
        CHECK(run(dir, { "render", "courtyard", "--gbuffer", "rays", "--size", size, "--frames", "1", "--json", json }) == 0);
        CHECK(read_all(dir.path / "err").empty());
        const auto numbers = nlohmann::json::parse(read_all(json));
        for (const auto& pair : numbers["agreement"])
            CHECK(pair["differing"] == 0);
    }
}

TEST_CASE("render writes what it says, and the numbers agree with themselves", "[tools][program]")
{
    const scratch_directory dir;
    const std::string out = (dir.path / "pictures").string(), json = (dir.path / "numbers.json").string();
    REQUIRE(run(dir, { "render", "courtyard", "--backend", "cpu", "--size", "96x54", "--frames", "1", "--reference", "64",
                       "--out", out, "--json", json }) == 0);
    CHECK(read_all(dir.path / "err").empty());
    for (const char* name : { "visibility-cpu.png", "visibility-cpu.exr", "reference.png", "reference.exr", "depth.exr",
                              "normal.exr", "difference-cpu-reference.png", "report.html" })
        CHECK(std::filesystem::file_size(dir.path / "pictures" / name) > 100);
    CHECK(files_in(out) == 8);
    const auto numbers = nlohmann::json::parse(read_all(json));
    CHECK(numbers["size"] == std::vector<int>{ 96, 54 });
    const auto run_0 = numbers["runs"][0];
    CHECK(run_0["backend"] == "cpu");
    CHECK(run_0["passes"].size() == 4); // a depth buffer is made linear first
    CHECK(run_0["total_ms"] > 0.0);
    CHECK(run_0["rmse"] < numbers["best_constant_rmse"]);
    CHECK(numbers["agreement"].empty());
}

TEST_CASE("shading writes its pictures with and without occlusion, and the numbers say what was done", "[tools][program]")
{
    const scratch_directory dir;
    const std::string json = (dir.path / "numbers.json").string();
    // Two walls of different materials; one is drawn with a blend of the two.
    const std::string model = dir.file("model.obj", "mtllib model.mtl\n"
                                                    "v -1 0 0\nv 1 0 0\nv 1 1 0\nv -1 1 0\nv -1 0 1\nv 1 0 1\n"
                                                    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                                    "o wall\nusemtl red\nf 1/1 2/2 3/3 4/4\n"
                                                    "o floor\nusemtl blue\nf 5/1 6/2 2/3 1/4\n");
    dir.file("model.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nmap_Kd missing.png\n");
    const std::string blend = dir.file("blend.json", R"({"blends": {"purple": {"first": "red", "second": "blue", "k": 0.5}},
"use": {"materials": {"red": "purple"}}})");
    for (const char* gbuffer : { "raster", "rays" }) {
        const std::filesystem::path out = dir.path / gbuffer;
        INFO(gbuffer);
        REQUIRE(run(dir, { "render", model,         "--backend", "cpu",       "--size",     "96x54",   "--frames",
                           "1",      "--reference", "16",        "--gbuffer", gbuffer,      "--shade", "--blend",
                           blend,    "--lights",    "none",      "--out",     out.string(), "--json",  json }) == 0);
        for (const char* name :
             { "shaded-cpu.png", "shaded-cpu-plain.png", "visibility-cpu.png", "reference.png", "report.html" })
            CHECK(std::filesystem::file_size(out / name) > 100);
        CHECK(read_all(out / "shaded-cpu.png") != read_all(out / "shaded-cpu-plain.png"));
        // What is missing is said once, and the name is kept.
        const std::string message = read_all(dir.path / "err");
        CHECK(message.rfind("ao: warning: ", 0) == 0);
        CHECK(message.find('\n') == message.size() - 1);
        const auto numbers = nlohmann::json::parse(read_all(json));
        CHECK(numbers["missing_textures"] == std::vector<std::string>{ "missing.png" });
        CHECK(numbers["settings"]["gbuffer"] == gbuffer);
        CHECK(numbers["shading"]["blends"].size() == 1);
        CHECK(numbers["shading"]["blends"][0]["leaves"] == 2);
        CHECK(numbers["shading"]["passes"] == 1);
        CHECK(numbers["scenes"][0]["shade_ms"] > 0.0);
        CHECK(numbers["scenes"][0]["clamped_weights"] == 0);
        CHECK(numbers["scenes"][0].contains("draw_ms") == (std::string(gbuffer) == "raster"));
        CHECK(numbers["variants"].empty() == (std::string(gbuffer) == "rays"));
        CHECK(numbers["runs"][0]["rmse"] < 1.0);
    }
}

#if defined(AO_HAS_GL) && defined(AO_HAS_VK)
TEST_CASE("given the same pictures the backends shade alike in every bit; drawn by each they agree on objects",
          "[tools][program]")
{
    const scratch_directory dir;
    const std::string json = (dir.path / "numbers.json").string();
    const std::vector<std::string> request{ "render", "courtyard", "--shade", "--route", "compute", "--size",
                                            "96x54",  "--frames",  "1",       "--json",  json,      "--gbuffer" };
    const auto with = [&](const char* gbuffer) {
        std::vector<std::string> words = request;
        words.push_back(gbuffer);
        return words;
    };
    REQUIRE(run(dir, with("rays")) == 0);
    const auto rays = nlohmann::json::parse(read_all(json));
    CHECK(rays["shaded_agreement"].size() == 3);
    for (const char* which : { "agreement", "shaded_agreement" })
        for (const auto& pair : rays[which])
            CHECK(pair["differing"] == 0);
    REQUIRE(run(dir, with("raster")) == 0);
    const auto raster = nlohmann::json::parse(read_all(json));
    CHECK(raster["shaded_agreement"].size() == 3);
    int compared = 0;
    for (const auto& pair : raster["gbuffer_agreement"])
        if (pair["of"] == "object and material") {
            ++compared;
            CHECK(pair["differing"] <= 5); // of 5184: pixels whose centres lie on an edge
        }
    CHECK(compared == 3);
}
#endif

TEST_CASE("an interrupt in the middle leaves no file", "[tools][program]")
{
    const scratch_directory dir;
    const std::string out = (dir.path / "pictures").string(), json = (dir.path / "numbers.json").string();
    // Hours of truth if nobody interrupts.
    CHECK(
        run(dir,
            { "render", "courtyard", "--backend", "cpu", "--frames", "1", "--reference", "65536", "--out", out, "--json", json },
            4000) == 1);
    CHECK(read_all(dir.path / "err") == "ao: interrupted\n");
    CHECK(files_in(out) == 0);
    CHECK_FALSE(std::filesystem::exists(json));
}
