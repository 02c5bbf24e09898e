// What a plan leaves out changes no bit, and what it saves is counted; the program's facts about a scene. AO_PROGRAM is its path.
#include "program_run.hpp"
#include "tools_support.hpp"

#include "ao/cpu/backend.hpp"
#include "ao/explain.hpp"
#include "host/temporal_runner.hpp"
#include "micro/courtyard_input.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <vector>

namespace {

constexpr int width = 160;
constexpr int height = 90;

ao::picture drawn(const ao::plan& p, const ao::bench::input& in)
{
    auto backend = ao::cpu::backend::create({});
    REQUIRE(backend);
    auto program = backend->prepare(p);
    REQUIRE(program);
    ao::picture depth = in.depth;
    ao::picture normal = in.normal;
    ao::picture visibility(p.facts.output_format, width, height);
    auto bound = backend->bind(*program, p, { ao::cpu::view_of(depth), ao::cpu::view_of(normal), ao::cpu::view_of(visibility) });
    REQUIRE(bound);
    for (std::size_t i = 0; i < p.passes.size(); ++i)
        backend->record_pass({}, *program, *bound, p, i);
    return visibility;
}

} // namespace

TEST_CASE("what a plan leaves out changes no bit and costs something", "[tools][facts]")
{
    const ao::bench::input in = ao::bench::courtyard_input(width, height);
    for (const ao::method method : { ao::method::box, ao::method::hemisphere, ao::method::halton }) {
        ao::settings s;
        s.method = method;
        s.taps = 8;
        s.filter = 1;
        s.thickness = std::numeric_limits<float>::infinity();
        const auto plan = ao::make_plan(s, in.facts, in.camera);
        REQUIRE(plan);
        const ao::picture lean = drawn(*plan, in);
        const std::vector<ao::tools::elimination> all = ao::tools::eliminations_of(*plan);
        REQUIRE(all.size() == 4);
        for (const ao::tools::elimination& each : all) {
            INFO(each.what);
            CHECK_FALSE(each.reason.empty());
            // It is another plan indeed: it has more passes or other options.
            CHECK_FALSE(ao::same_structure(*plan, each.full));
            CHECK(drawn(each.full, in).bytes == lean.bytes);
#ifdef AO_HAS_VK
            REQUIRE(each.saved);
            CHECK(each.saved->operations > 0);
#endif
        }
#ifdef AO_HAS_VK
        CHECK(all[0].saved->passes == 1);
        CHECK(all[0].saved->bytes == 8);
        CHECK(all[1].saved->passes == 2);
        CHECK(all[1].saved->bytes == 24);
        // A far test is more work for every tap.
        CHECK(all[2].saved->operations >= s.taps);
#endif
        // A picture that the far test does change: the comparison above can fail.
        s.thickness = 0.5f;
        const auto limited = ao::make_plan(s, in.facts, in.camera);
        REQUIRE(limited);
        CHECK(drawn(*limited, in).bytes != lean.bytes);
        CHECK(ao::tools::eliminations_of(*limited).size() == 3);
    }
    // Nothing is left out that is needed.
    ao::settings full;
    ao::facts known = in.facts;
    known.depth = ao::depth_source::hardware;
    known.depth_format = ao::pixel_format::d32f;
    known.world_normals = true;
    ao::camera camera = in.camera;
    for (int i = 0; i < 3; ++i)
        camera.normal_to_view[i][i] = 1.0f;
    CHECK(ao::tools::eliminations_of(*ao::make_plan(full, known, camera)).empty());
}

TEST_CASE("no reprojection where nothing moves changes no bit", "[tools][facts]")
{
    const ao::bench::input in = ao::bench::courtyard_input(width, height);
    ao::temporal_camera camera;
    camera.projection = in.camera.projection;
    for (int i = 0; i < 3; ++i)
        camera.world_to_view[i][i] = 1.0f;
    const auto after_frames = [&](bool motion) {
        auto runners = ao::host::make_temporal_runners("cpu");
        REQUIRE(runners);
        ao::host::temporal_runner& r = *runners->front();
        ao::temporal_facts f;
        f.frame = in.facts;
        f.motion = motion;
        f.motion_format = ao::pixel_format::rg32f;
        REQUIRE(r.prepare({}, f));
        REQUIRE(r.upload(in.depth, in.normal, motion ? ao::picture(f.motion_format, width, height) : ao::picture()));
        std::size_t reprojecting = 0;
        for (int frame = 0; frame < 3; ++frame)
            REQUIRE(r.frame(camera));
        for (const ao::temporal_step& step : r.plan().steps)
            reprojecting += step.options.use_motion ? 1 : 0;
        CHECK(reprojecting == (motion ? 1 : 0));
        auto seen = r.download();
        REQUIRE(seen);
        return seen->bytes;
    };
    CHECK(after_frames(false) == after_frames(true));
}

TEST_CASE("the program tells a scene's facts and its plan", "[tools][facts]")
{
    const scratch_directory dir;
    const std::string file = (dir.path / "facts.json").string();
    REQUIRE(run(dir, { "facts", "courtyard", "--size", "160x90", "--json", file, "--temporal", "--motion", "pan" }) == 0);
    const auto facts = nlohmann::json::parse(read_all(file));
    CHECK(facts.at("normal_maps") > 0);
    CHECK(facts.at("alpha_maps") > 0);
    CHECK(facts.at("moves_objects") == true);
    CHECK(facts.at("moves_camera") == true);
    const double near = facts.at("eye_depth").at(0), far = facts.at("eye_depth").at(1);
    CHECK(near < far);
    CHECK(facts.at("radius_pixels").at(0).get<double>() * far == Approx(facts.at("radius_pixels").at(1).get<double>() * near));
    std::size_t pixels = 0;
    for (const auto& [name, count] : facts.at("class_pixels").items())
        pixels += count.get<std::size_t>();
    CHECK(pixels == 160 * 90);
    CHECK(facts.at("class_pixels").at("thin") > 0);

    // A floor seen from above: no map, nothing that stands out, nothing that moves.
    const std::string floor = dir.file("floor.obj", "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 4 3 2 1\n");
    REQUIRE(run(dir, { "facts", floor, "--eye", "0,2,0", "--pitch", "-90", "--size", "64x64", "--radius", "0.1", "--json",
                       file }) == 0);
    const auto plain = nlohmann::json::parse(read_all(file));
    CHECK(plain.at("normal_maps") == 0);
    CHECK(plain.at("jump_pixels") == 0);
    CHECK(plain.at("motion") == "none");
    CHECK(plain.at("class_pixels").at("thin") == 0);
    CHECK(plain.at("eye_depth").at(0).get<double>() == Approx(2.0).epsilon(1e-5));
    CHECK(plain.at("eye_depth").at(1).get<double>() == Approx(2.0).epsilon(1e-5));

    REQUIRE(run(dir, { "render", "courtyard", "--explain", "--gbuffer", "rays", "--method", "hemisphere", "--filter", "1",
                       "--thickness", "infinite" }) == 0);
    const std::string lean = read_all(dir.path / "out");
    for (const char* what : { "pass linearize", "filter rows", "far test", "rotation of normals" })
        CHECK(lean.find(what) != std::string::npos);
    REQUIRE(run(dir, { "render", "courtyard", "--explain", "--temporal" }) == 0);
    CHECK(read_all(dir.path / "out").find("nothing") != std::string::npos);
    check_failure(dir, { "facts", "missing.obj" }, "no such file");
}
