// `ao render --temporal` as a user meets it. AO_PROGRAM is the program's path.
#include "program_run.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace {

using words = std::vector<std::string>;
using nlohmann::json;

json numbers_of(const scratch_directory& dir, words request)
{
    const std::string file = (dir.path / "numbers.json").string();
    for (const char* word : { "--temporal", "--json", file.c_str() })
        request.emplace_back(word);
    request.insert(request.begin(), "render");
    REQUIRE(run(dir, request) == 0);
    CHECK(read_all(dir.path / "err").empty());
    return json::parse(read_all(file));
}

// A box on a floor.
std::string box_on_floor(const scratch_directory& dir)
{
    return dir.file("box.obj", "v -3 0 3\nv 3 0 3\nv 3 0 -3\nv -3 0 -3\n"
                               "v -0.5 0.01 0.5\nv 0.5 0.01 0.5\nv 0.5 0.01 -0.5\nv -0.5 0.01 -0.5\n"
                               "v -0.5 1 0.5\nv 0.5 1 0.5\nv 0.5 1 -0.5\nv -0.5 1 -0.5\n"
                               "o floor\nf 1 2 3 4\n"
                               "o box\nf 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n");
}

} // namespace

TEST_CASE("bad requests for an animation end with one line and status 1", "[tools][temporal]")
{
    const scratch_directory dir;
    const std::string no_json = dir.file("no.json", "{");
    const std::size_t count = files_in(dir.path);
    const std::pair<words, std::string> cases[] = {
        { { "--motion", "orbit" }, "--motion requires --temporal" },
        { { "--samples", "8,8" }, "--samples requires --temporal" },
        { { "--most-weight", "8" }, "--most-weight requires --temporal" },
        { { "--history", "packed" }, "--history requires --temporal" },
        { { "--temporal", "--shade" }, "--shade" },
        { { "--temporal", "--taps", "8" }, "--taps" },
        { { "--temporal", "--method", "box" }, "--method" },
        { { "--temporal", "--route", "fragment" }, "--route fragment" },
        { { "--temporal", "--frames", "0" }, "--frames" },
        { { "--temporal", "--motion", "spiral" }, "spiral" },
        { { "--temporal", "--motion", no_json }, "no.json:1:" },
        { { "--temporal", "--motion", dir.path.string() }, dir.path.string() },
        { { "--temporal", "--samples", "8" }, "--samples" },
        { { "--temporal", "--samples", "8,x" }, "--samples" },
        { { "--temporal", "--samples", "0,8" }, "samples" },
        { { "--temporal", "--samples", "8,100000" }, "samples" },
        { { "--temporal", "--most-weight", "0" }, "weight" },
        { { "--temporal", "--most-weight", "2147483648" }, "--most-weight" },
        { { "--temporal", "--most-weight", "5000", "--history", "packed" }, "weight" },
        { { "--temporal", "--contribution", "alchemy" }, "--contribution" },
        { { "--temporal", "--density", "cone" }, "--density" },
        { { "--temporal", "--density", "disc-area" }, "density" }, // ritschel has another
        { { "--temporal", "--contribution", "fox-compton", "--density", "hemisphere" }, "density" },
        { { "--density", "disc-area" }, "--density requires --temporal" },
        { { "--temporal", "--history", "half" }, "--history" },
        { { "--temporal", "--invalidation", "hard" }, "--invalidation" },
        { { "--temporal", "--smoothness", "-1" }, "smoothness" },
        { { "--temporal", "--smoothness", "nan" }, "smoothness" },
        { { "--temporal", "--filter", "4" }, "filter" },
    };
    for (auto [arguments, reason] : cases) {
        arguments.insert(arguments.begin(), { "render", "courtyard", "--backend", "cpu", "--size", "16x9" });
        check_failure(dir, arguments, reason);
    }
    CHECK(files_in(dir.path) == count + 2); // and the two streams
}

TEST_CASE("a still picture converges: the error falls, every pixel reaches the greatest weight, then nothing runs",
          "[tools][temporal]")
{
    const scratch_directory dir;
    const json numbers =
        numbers_of(dir, { box_on_floor(dir), "--backend", "cpu", "--gbuffer", "rays", "--size", "64x40", "--frames", "20",
                          "--reference", "256", "--samples", "8,8", "--most-weight", "96", "--filter", "1" });
    REQUIRE(numbers["frames"].size() == 20);
    const auto frame = [&](std::size_t f) { return numbers["frames"][f]["backends"][0]; };
    const double surface = frame(0)["surface_pixels"];
    REQUIRE(surface > 300);
    CHECK(frame(0)["share_invalidated"] == 1.0); // nothing was known
    CHECK(frame(0)["flicker"].is_null());
    for (std::size_t f = 0; f < 20; ++f) {
        INFO(f);
        CHECK(numbers["frames"][f]["frame"] == f);
        CHECK(frame(f)["surface_pixels"] == surface);
        // 96 samples are twelve frames of 8.
        CHECK(frame(f)["samples"] == (f < 12 ? 8 * surface : 0.0));
        CHECK(frame(f)["passes"].empty() == (f >= 12));
        CHECK(frame(f)["share_converged"] == (f < 11 ? 0.0 : 1.0));
        if (f > 0) {
            CHECK(frame(f)["share_invalidated"] == 0.0);
            CHECK((frame(f)["flicker"] == 0.0) == (f >= 12));
        }
    }
    CHECK(frame(11)["rmse"] < 0.75 * frame(0)["rmse"].get<double>());
    CHECK(frame(19)["rmse"] == frame(11)["rmse"]);
    CHECK(frame(11)["flicker_p99"] < 0.25 * frame(1)["flicker_p99"].get<double>());
    // With the same samples in every frame one frame alone stays where it is.
    CHECK(numbers["frames"][19]["alone_rmse"] == numbers["frames"][0]["alone_rmse"]);
    CHECK(frame(11)["rmse"] < 0.75 * numbers["frames"][11]["alone_rmse"].get<double>());
    CHECK(frame(11)["rmse"] < numbers["best_constant_rmse"].get<double>());
}

TEST_CASE("a cut forgets the history and is marked", "[tools][temporal]")
{
    const scratch_directory dir;
    const json numbers = numbers_of(dir, { box_on_floor(dir), "--backend", "cpu", "--gbuffer", "rays", "--size", "48x30",
                                           "--frames", "8", "--motion", "cut" });
    int cuts = 0;
    for (const json& f : numbers["frames"]) {
        const double invalidated = f["backends"][0]["share_invalidated"];
        CHECK((invalidated == 1.0) == (f["cut"] == true || f["frame"] == 0));
        cuts += f["cut"] == true ? 1 : 0;
    }
    CHECK(cuts == 1);
}

TEST_CASE("every history, contribution and invalidation is accepted, and says so", "[tools][temporal]")
{
    const scratch_directory dir;
    const std::string model = box_on_floor(dir);
    const std::pair<const char*, std::vector<const char*>> all[] = {
        { "history", { "precise", "packed", "half-stalls" } },
        { "contribution", { "ritschel", "fox-compton" } },
        { "invalidation", { "none", "smooth", "clamp" } },
    };
    for (const auto& [option, choices] : all)
        for (const char* choice : choices) {
            INFO(option << " " << choice);
            const json numbers = numbers_of(
                dir, { model, "--backend", "cpu", "--size", "32x18", "--frames", "2", std::string("--") + option, choice });
            CHECK(numbers["settings"][option] == choice);
            CHECK(numbers["frames"][1]["backends"][0]["draw_ms"] > 0.0);
        }
}

// Where an option is read but not used, or another density is the default, two of the errors are not what they must be.
TEST_CASE("patches lie uniformly on the disc unless another density is asked for", "[tools][temporal]")
{
    const scratch_directory dir;
    const std::string model = box_on_floor(dir);
    const auto rmse_with = [&](std::initializer_list<std::string> more, const char* density) {
        words arguments{ model,   "--backend", "cpu", "--gbuffer",      "rays",       "--size",
                         "48x27", "--frames",  "2",   "--filter",       "1",          "--reference",
                         "64",    "--seed",    "1",   "--contribution", "fox-compton" };
        arguments.insert(arguments.end(), more.begin(), more.end());
        const json numbers = numbers_of(dir, arguments);
        CHECK(numbers["settings"]["density"] == density);
        return numbers["frames"][1]["backends"][0]["rmse"].get<double>();
    };
    const double unasked = rmse_with({}, "disc-area");
    CHECK(rmse_with({ "--density", "disc-area" }, "disc-area") == unasked);
    CHECK(rmse_with({ "--density", "disc-linear" }, "disc-linear") != unasked);
}

TEST_CASE("an animation writes what it says", "[tools][temporal]")
{
    const scratch_directory dir;
    const std::filesystem::path out = dir.path / "pictures";
    const json numbers = numbers_of(dir, { "courtyard", "--backend", "cpu", "--size", "48x27", "--frames", "4", "--motion",
                                           "orbit", "--reference", "16", "--out", out.string() });
    for (const char* name : { "temporal-cpu.png", "temporal-cpu.exr", "temporal-cpu.apng", "reference.png", "reference.exr",
                              "reference.apng", "difference-cpu-reference.png", "report.html" })
        CHECK(std::filesystem::file_size(out / name) > 100);
    CHECK(files_in(out) == 8);
    const std::string moving = read_all(out / "temporal-cpu.apng");
    CHECK(moving.find("acTL") == 37); // right behind the header
    std::size_t frames = 0;
    for (std::size_t at = moving.find("fcTL"); at != std::string::npos; at = moving.find("fcTL", at + 1))
        ++frames;
    CHECK(frames == 4);
    const std::string page = read_all(out / "report.html");
    CHECK(page.find("<svg") != std::string::npos);
    CHECK(page.find("RMSE against the truth of the frame") != std::string::npos);
    CHECK(numbers["settings"]["objects_move"] == true);
    CHECK(numbers["frames"][3]["backends"][0]["rmse"] > 0.0);
}

#if defined(AO_HAS_GL) && defined(AO_HAS_VK)
TEST_CASE("in every motion the backends agree in every bit of picture and history, given the same G-buffers", "[tools][temporal]")
{
    const scratch_directory dir;
    for (const char* motion : { "static", "pan", "orbit", "cut" }) {
        INFO(motion);
        const json numbers =
            numbers_of(dir, { "courtyard", "--gbuffer", "rays", "--size", "64x36", "--frames", "8", "--motion", motion });
        CHECK(numbers["agreement"].size() == 3);
        CHECK(numbers["history_agreement"].size() == 3);
        for (const char* which : { "agreement", "history_agreement" })
            for (const json& pair : numbers[which])
                CHECK(pair["differing"] == 0);
        // What was learned of them agrees, too.
        for (const json& f : numbers["frames"])
            for (const json& backend : f["backends"])
                for (const char* number : { "samples", "share_converged", "share_invalidated", "flicker" })
                    CHECK(backend[number] == f["backends"][0][number]);
    }
}
#endif

TEST_CASE("an interrupt in the middle of an animation leaves no file", "[tools][temporal]")
{
    const scratch_directory dir;
    const std::string out = (dir.path / "pictures").string(), numbers = (dir.path / "numbers.json").string();
    CHECK(run(dir,
              { "render", "courtyard", "--backend", "cpu", "--temporal", "--frames", "10000", "--reference", "1024", "--out", out,
                "--json", numbers },
              4000) == 1);
    CHECK(read_all(dir.path / "err") == "ao: interrupted\n");
    CHECK(files_in(out) == 0);
    CHECK_FALSE(std::filesystem::exists(numbers));
}
