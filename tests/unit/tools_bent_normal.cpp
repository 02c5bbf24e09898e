// Bent normals and bounces by the program.
#include "program_run.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

TEST_CASE("bent normals are written, shaded along, and the same on every backend", "[tools][program][bent]")
{
    const scratch_directory dir;
    const std::filesystem::path out = dir.path / "pictures";
    const std::string json = (dir.path / "numbers.json").string();
    REQUIRE(
        run(dir, { "render", "courtyard", "--method", "bitmask", "--preset", "high", "--bent-normal", "--multi-bounce", "--shade",
                   "--gbuffer", "rays", "--size", "96x54", "--frames", "1", "--out", out.string(), "--json", json }) == 0);
    const auto numbers = nlohmann::json::parse(read_all(json));
    CHECK(numbers["settings"]["bent_normal"] == true);
    CHECK(numbers["settings"]["multi_bounce"] == true);
    for (const char* which : { "agreement", "bent_agreement", "shaded_agreement" })
        for (const auto& pair : numbers[which])
            CHECK(pair["differing"] == 0);
    CHECK(numbers["bent_agreement"].size() == numbers["agreement"].size());
    CHECK(std::filesystem::file_size(out / "bent-normal-cpu.png") > 100);
    const std::string along = read_all(out / "shaded-cpu.png");

    // Neither switch is without effect on the shaded picture.
    for (const char* left_out : { "--bent-normal", "--multi-bounce" }) {
        std::vector<std::string> words{ "render",    "courtyard", "--method", "bitmask", "--shade",
                                        "--gbuffer", "rays",      "--size",   "96x54",   "--frames",
                                        "1",         "--backend", "cpu",      "--out",   out.string() };
        for (const char* word : { "--bent-normal", "--multi-bounce" })
            if (std::string(word) != left_out)
                words.push_back(word);
        INFO(left_out);
        REQUIRE(run(dir, words) == 0);
        CHECK(read_all(out / "shaded-cpu.png") != along);
    }
}

TEST_CASE("bent normals and bounces are refused where they make no sense", "[tools][program][bent]")
{
    const scratch_directory dir;
    check_failure(dir, { "render", "courtyard", "--method", "hemisphere", "--bent-normal" },
                  "bent normals come from the method bitmask");
    check_failure(dir, { "render", "courtyard", "--multi-bounce" }, "--multi-bounce needs --shade");
}
