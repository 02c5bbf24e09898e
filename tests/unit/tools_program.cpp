// The program `ao` as a user meets it. AO_PROGRAM is its path.
#include "tools_support.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/wait.h>
#include <vector>

namespace {

// Runs the program in `dir`, its streams in the files out and err there; stops it after `interrupt_after` milliseconds
// if that is not 0.
int run(const scratch_directory& dir, const std::vector<std::string>& arguments, unsigned interrupt_after = 0)
{
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const auto redirect = [&](const char* name, int to) {
            ::dup2(::open((dir.path / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), to);
        };
        redirect("out", 1);
        redirect("err", 2);
        std::vector<const char*> argv{ AO_PROGRAM };
        for (const std::string& a : arguments)
            argv.push_back(a.c_str());
        argv.push_back(nullptr);
        ::execv(AO_PROGRAM, const_cast<char**>(argv.data()));
        _exit(127);
    }
    if (interrupt_after > 0) {
        ::usleep(interrupt_after * 1000);
        ::kill(child, SIGINT);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

TEST_CASE("bad requests end with one line and status 1", "[tools][program]")
{
    using words = std::vector<std::string>;
    const scratch_directory dir;
    const std::string nan = dir.file("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    const std::pair<words, std::string> cases[] = {
        { {}, "subcommand" },
        { { "render" }, "SCENE" },
        { { "render", "missing.obj" }, "no such file" },
        { { "render", nan }, "vertex 2" },
        { { "render", "courtyard", "--taps", "0" }, "taps" },
        { { "render", "courtyard", "--taps", "1000000" }, "taps" },
        { { "render", "courtyard", "--taps", "many" }, "--taps" },
        { { "render", "courtyard", "--radius", "0" }, "radius" },
        { { "render", "courtyard", "--radius", "-1" }, "radius" },
        { { "render", "courtyard", "--radius", "1e30" }, "radius" },
        { { "render", "courtyard", "--radius", "nan" }, "radius" },
        { { "render", "courtyard", "--bias", "-0.1" }, "bias" },
        { { "render", "courtyard", "--filter", "4" }, "filter" },
        { { "render", "courtyard", "--kernel", "cube" }, "--kernel" },
        { { "render", "courtyard", "--size", "0x4" }, "--size" },
        { { "render", "courtyard", "--size", "99999x99999" }, "--size" },
        { { "render", "courtyard", "--eye", "1,2" }, "--eye" },
        { { "render", "courtyard", "--eye", "1,2,inf" }, "--eye" },
        { { "render", "courtyard", "--yaw", "10" }, "--eye" },
        { { "render", "courtyard", "--fov", "180" }, "--fov" },
        { { "render", "courtyard", "--reference", "3" }, "--reference" },
        { { "render", "courtyard", "--projection", "fisheye" }, "--projection" },
        { { "render", "courtyard", "--projection", "parallel,infinite" }, "--projection" },
        { { "render", "courtyard", "--json", "missing/a.json" }, "missing/a.json" },
        { { "render", "courtyard", "--out", nan }, nan },
        { { "render", "courtyard", "--colour", "red" }, "--colour" },
    };
    for (const auto& [arguments, reason] : cases) {
        CHECK(run(dir, arguments) == 1);
        const std::string message = read_all(dir.path / "err");
        INFO(message);
        CHECK(message.rfind("ao: ", 0) == 0);
        CHECK(message.find('\n') == message.size() - 1);
        CHECK(message.find(reason) != std::string::npos);
        CHECK(read_all(dir.path / "out").empty());
    }
    CHECK(files_in(dir.path) == 3); // the model and the two streams
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
    CHECK(run_0["passes"].size() == 3);
    CHECK(run_0["total_ms"] > 0.0);
    CHECK(run_0["rmse"] < numbers["best_constant_rmse"]);
    CHECK(numbers["agreement"].empty());
}

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
