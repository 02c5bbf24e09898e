// Every row of the catalogue of failures, over every backend. AO_STABILITY=full: the long form, with more inputs.
// AO_STABILITY_TABLE=PATH: writes PATH.md and PATH.json as well.
#include "stability/table.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

using namespace stability;

namespace {

std::string setting(const char* name)
{
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

std::string page(const std::vector<outcome>& all, const std::vector<subject>& subjects)
{
    std::string text =
        "# Where methods fail, measured\n\n"
        "Written by `./run stability` (`tests/stability`); every row of the catalogue is here, none is left out.\n"
        "A figure is held against its bound on every backend. The same measurement of a subject with a fault in it, or of\n"
        "a published method that must fail, stands beside it and must not hold. `core`: measured once, for what is no\n"
        "backend's. Figures are rounded to three digits; `endless` is infinite, or what is not a number.\n\n";
    std::size_t held = 0;
    for (const outcome& o : all) {
        held += o.held && o.caught ? 1 : 0;
    }
    text += std::to_string(held) + " of " + std::to_string(all.size()) +
            " rows hold, and their faults are caught. Rows that are `missed` have a goal that is not met; the figure says by how "
            "much.\n\n" +
            markdown(all, subjects);
    text += "\n## Rows without a measurement of their own\n\n| row | why, or where it is measured |\n|---|---|\n";
    for (const remark& r : all_remarks()) {
        text += std::string("| ") + r.id + " | " + r.reason + " |\n";
    }
    return text;
}

} // namespace

TEST_CASE("Every row holds on every backend, and no fault passes it", "[stability]")
{
    const bool thorough = setting("AO_STABILITY") == "full";
    const std::string only = setting("AO_STABILITY_ROW");
    const bool aloud = !setting("AO_STABILITY_ALOUD").empty();
    std::vector<subject> subjects = all_subjects(thorough);
    REQUIRE_FALSE(subjects.empty());
    const std::vector<row> rows = all_rows();
    std::vector<outcome> all;
    for (const row& r : rows) {
        if (!only.empty() && std::string_view(r.id).substr(0, only.size()) != only) {
            continue;
        }
        const auto start = std::chrono::steady_clock::now();
        const outcome& o = all.emplace_back(run(r, subjects));
        const std::string line = markdown({ o }, subjects);
        if (aloud) {
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
            std::string figures;
            for (const auto& f : o.figures) {
                figures += " " + (f ? rounded(*f) : std::string("-"));
            }
            std::printf("%-5s %s%s | broken %s | %s, %.2f s\n", r.id, rounded(r.bound).c_str(), figures.c_str(),
                        rounded(*o.broken).c_str(),
                        o.held != r.missed ? o.caught ? r.missed ? "missed" : "holds" : "DOES NOT BITE" : "FAILS", took.count());
            std::fflush(stdout);
        }
        INFO(line.substr(line.find("\n| ") + 1));
        CHECK(o.held != r.missed);
        CHECK(o.caught);
    }
    const std::string path = setting("AO_STABILITY_TABLE");
    if (!path.empty()) {
        std::ofstream(path + ".md") << page(all, subjects);
        std::ofstream(path + ".json") << json(all, subjects);
    }
}

TEST_CASE("No row of the catalogue is missing, and none stands twice", "[stability]")
{
    std::set<std::string> seen;
    std::set<std::string> subsections;
    for (const row& r : all_rows()) {
        INFO(r.id);
        CHECK(seen.insert(r.id).second);
    }
    for (const remark& r : all_remarks()) {
        INFO(r.id);
        CHECK(seen.insert(r.id).second);
    }
    const auto has = [&](const std::string& id) {
        INFO(id);
        CHECK(seen.count(id) == 1);
    };
    const struct {
        const char* letter;
        int count;
    } catalogue[] = { { "T", 5 }, { "H", 7 }, { "W", 4 }, { "D", 5 }, { "S", 7 }, { "P", 2 },  { "F", 9 },
                      { "B", 8 }, { "R", 6 }, { "M", 6 }, { "I", 1 }, { "X", 1 }, { "7.", 40 } };
    for (const auto& [letter, count] : catalogue) {
        for (int i = 1; i <= count; ++i) {
            has(letter + std::to_string(i));
        }
    }
}
