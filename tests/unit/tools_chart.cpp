// What the chart measures, the file that it writes, and the pictures and the page that are drawn from it. AO_PROGRAM is the
// program, AO_DRAW the script, AO_PYTHON Debian's Python.
#include "program_run.hpp"
#include "tools_support.hpp"

#include "scene/paired_error.hpp"
#include "scene/pixel_classes.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <vector>

using ao::tools::pixel_class;
using nlohmann::json;

namespace {

// Runs to the end; its status.
int shell(const std::string& command)
{
    return std::system(command.c_str());
}

json small_chart(const scratch_directory& dir, const std::string& name, const std::string& backends)
{
    const int status =
        run(dir, { "chart", "--size", "96x54", "--methods", "hemisphere,ritschel", "--taps", "4,8", "--rounds", "1", "--frames",
                   "4", "--reference", "16", "--parts", "frames,motion", "--backends", backends, "--json", name });
    INFO(read_all(dir.path / "err"));
    REQUIRE(status == 0);
    return json::parse(read_all(dir.path / name));
}

// Absolute, as `run` works in the directory that the test was started in.
std::string in(const scratch_directory& dir, const char* name)
{
    return (dir.path / name).string();
}

bool has_matplotlib()
{
    return shell(std::string(AO_PYTHON) + " -c 'import matplotlib' > /dev/null 2>&1") == 0;
}

// Everything that was drawn, by file name.
std::map<std::string, std::string> drawn(const std::string& chart, const std::filesystem::path& to)
{
    REQUIRE(shell(std::string(AO_PYTHON) + " " + AO_DRAW + " " + chart + " --out " + to.string() + " > /dev/null") == 0);
    std::map<std::string, std::string> files;
    for (const auto& each : std::filesystem::directory_iterator(to))
        files[each.path().filename().string()] = read_all(each.path());
    return files;
}

} // namespace

TEST_CASE("errors come apart into what more seeds average out and what they do not", "[tools][chart]")
{
    // Known: bias 0.1, deviation 0.2, the references' noise 0.3 (which must not be seen).
    std::mt19937 engine(7);
    std::normal_distribution<double> noise(0.0, 1.0);
    ao::tools::error_sums sums;
    constexpr int count = 200000;
    for (int i = 0; i < count; ++i) {
        const double truth = 0.5 + 0.2 * noise(engine);
        sums.add(truth + 0.1 + 0.2 * noise(engine), truth + 0.1 + 0.2 * noise(engine), truth + 0.3 * noise(engine),
                 truth + 0.3 * noise(engine));
    }
    const ao::tools::paired_error e = sums.result();
    CHECK(e.pixels == count);
    CHECK(e.rmse == Approx(std::sqrt(0.05)).margin(0.003));
    CHECK(e.systematic == Approx(0.1).margin(0.004));
    CHECK(e.deviation == Approx(0.2).margin(0.002));
    CHECK(e.bias == Approx(0.1).margin(0.002));
    CHECK(e.rmse * e.rmse == Approx(e.systematic * e.systematic + e.deviation * e.deviation).epsilon(1e-9));
}

TEST_CASE("slopes and percentiles are those of their definitions", "[tools][chart]")
{
    const std::vector<double> x{ 4, 8, 16, 32 };
    std::vector<double> y;
    for (const double each : x)
        y.push_back(3.0 * std::pow(each, -0.75));
    CHECK(ao::tools::log_slope(x, y) == Approx(-0.75));
    CHECK(ao::tools::percentile({ 5, 1, 4, 2, 3 }, 0.5) == 3.0);
    CHECK(ao::tools::percentile({ 5, 1, 4, 2, 3 }, 0.0) == 1.0);
    CHECK(ao::tools::percentile({ 5, 1, 4, 2, 3 }, 1.0) == 5.0);
}

namespace {

// A wall facing the viewer at depth 10, and what stands before it: rectangles at depth 5, [x0, x1) x [y0, y1).
struct rectangle {
    int x0, y0, x1, y1;
};
ao::tools::gbuffer wall_with(const std::vector<rectangle>& before, int width, int height, float focal)
{
    ao::tools::gbuffer g;
    g.width = width;
    g.height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float depth = 10.0f;
            for (const rectangle& r : before)
                if (x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1)
                    depth = 5.0f;
            const float at_x = (static_cast<float>(x) + 0.5f - static_cast<float>(width) / 2.0f) / focal * depth;
            const float at_y = (static_cast<float>(height) / 2.0f - static_cast<float>(y) - 0.5f) / focal * depth;
            g.position.emplace_back(at_x, at_y, -depth);
            g.depth.push_back(depth);
            g.geometric_normal.emplace_back(0.0f, 0.0f, 1.0f);
            g.normal.emplace_back(0.0f, 0.0f, 1.0f);
            g.hit.push_back(1);
        }
    return g;
}

} // namespace

TEST_CASE("pixels are told apart by what makes them hard", "[tools][chart]")
{
    constexpr int width = 200, height = 120;
    constexpr float focal = 200.0f; // the radius of 1 is 20 pixels on the wall, 40 before it; thin is up to 10 pixels there
    const auto g = wall_with({ { 60, 50, 64, 90 }, { 110, 45, 150, 75 } }, width, height, focal);
    const auto classes = ao::tools::classify(g, { 1.0f, focal, false });
    const auto at = [&](int x, int y) { return classes[static_cast<std::size_t>(y * width + x)]; };
    CHECK(at(5, 60) == pixel_class::border);
    CHECK(at(19, 60) == pixel_class::border);
    CHECK(at(20, 60) == pixel_class::interior);
    CHECK(at(61, 70) == pixel_class::thin);
    CHECK(at(57, 70) == pixel_class::thin); // within four pixels of it
    CHECK(at(54, 70) == pixel_class::interior);
    CHECK(at(109, 60) == pixel_class::silhouette);
    CHECK(at(112, 60) == pixel_class::silhouette);
    CHECK(at(104, 60) == pixel_class::interior);
    CHECK(at(130, 60) == pixel_class::interior);
    const auto counts = ao::tools::count_classes(classes);
    CHECK(counts[static_cast<std::size_t>(pixel_class::background)] == 0);
    // The outlines of both, a pixel on either side; the corners outside have no jump to a side.
    CHECK(ao::tools::count_jumps(g, { 1.0f, focal, false }) ==
          2 * (4 + 40) + 2 * (4 + 40) - 4 + 2 * (40 + 30) + 2 * (40 + 30) - 4);

    // The square has moved ten pixels to the right: what it covered in the last frame is uncovered.
    auto later = ao::tools::classify(g, { 1.0f, focal, false });
    const auto before = wall_with({ { 60, 50, 64, 90 }, { 100, 45, 140, 75 } }, width, height, focal);
    std::vector<ao::tools::pixel_motion> motion;
    for (std::size_t i = 0; i < g.size(); ++i) {
        const bool square = g.depth[i] == 5.0f && i % width >= 110;
        motion.push_back({ square ? -10.0f : 0.0f, 0.0f, g.depth[i] });
    }
    ao::tools::mark_disoccluded(later, before, motion);
    CHECK(ao::tools::count_classes(later)[static_cast<std::size_t>(pixel_class::disoccluded)] == 10 * 30);
    CHECK(later[60 * width + 105] == pixel_class::disoccluded);
    CHECK(later[60 * width + 120] != pixel_class::disoccluded);
}

TEST_CASE("a chart holds every configuration on every backend, and the same errors each time", "[tools][chart]")
{
    const scratch_directory dir;
    const json first = small_chart(dir, in(dir, "a.json"), "all");
    CHECK(first.at("routes").size() == 4);
    CHECK(first.at("single").size() >= 15);
    CHECK(first.at("temporal").size() == 5);
    CHECK(first.at("views").at(0).at("best_constant_rmse") > 0.05);
    for (const json& c : first.at("single")) {
        INFO(c.at("name"));
        const json& e = c.at("views").at(0);
        const double rmse = e.at("rmse"), systematic = e.at("systematic"), deviation = e.at("deviation");
        CHECK(rmse > 0.01);
        CHECK(rmse * rmse == Approx(systematic * systematic + deviation * deviation).epsilon(1e-4));
        CHECK(deviation > 0.0);
        CHECK(e.at("sampling") > 0.0);
        CHECK(c.at("cost").at("fetches") >= c.at("taps"));
        std::size_t pixels = 0;
        double square = 0.0;
        for (const json& part : e.at("classes")) {
            pixels += part.at("pixels").get<std::size_t>();
            square += part.at("pixels").get<double>() * std::pow(part.at("rmse").get<double>(), 2.0);
        }
        CHECK(std::sqrt(square / static_cast<double>(pixels)) == Approx(rmse).epsilon(1e-4));
        CHECK((c.at("times").empty() || c.at("times").size() == 4));
        for (const json& t : c.at("times")) {
            CHECK(t.at("differing") == 0);
            CHECK(t.at("pixels") == 96 * 54);
            CHECK(t.at("ms_per_megapixel") > 0.0);
        }
    }
    for (const json& c : first.at("temporal")) {
        CHECK(c.at("motions").size() == 3);
        CHECK(c.at("moving_times").size() == 3);
        // What it says, it has measured: the view that stands is nearer to the truth after the frames than after the first.
        CHECK(c.at("motions").at(0).at("rmse") < c.at("motions").at(0).at("first_frame_rmse"));
    }
    // Costs are linear in the taps: eight cost as much more than four as sixteen ... of the plan, not of a clock.
    const auto cost = [&](const std::string& name, const char* of) {
        for (const json& c : first.at("single"))
            if (c.at("name") == name)
                return c.at("cost").at(of).get<double>();
        return -1.0;
    };
    const auto taps = [&](int n, const char* of) { return cost("hemisphere " + std::to_string(n) + " taps, no filter", of); };
    CHECK(taps(8, "fetches") - taps(4, "fetches") == 4.0);
    CHECK(taps(256, "operations") - taps(128, "operations") == 16 * (taps(16, "operations") - taps(8, "operations")));

    json second = small_chart(dir, in(dir, "b.json"), "cpu");
    json same = first;
    for (json* chart : { &same, &second }) {
        chart->erase("routes");
        chart->erase("temporal_routes");
        for (json& c : chart->at("single"))
            c.erase("times");
        for (json& c : chart->at("temporal")) {
            c.erase("still_times");
            c.erase("moving_times");
        }
    }
    CHECK(same == second);
}

TEST_CASE("the same numbers are drawn as the same bytes, and the page works in a browser", "[tools][chart]")
{
    if (!has_matplotlib()) {
        WARN("skipped: " << AO_PYTHON << " has no matplotlib (Debian: python3-matplotlib)");
        return;
    }
    const scratch_directory dir;
    json chart = small_chart(dir, in(dir, "chart.json"), "cpu");
    const auto first = drawn(in(dir, "chart.json"), dir.path / "first");
    CHECK(first.size() == 2 * 5 + 1);
    CHECK(drawn(in(dir, "chart.json"), dir.path / "second") == first);
    chart["single"][0]["error"]["rmse"] = 0.123;
    dir.file("other.json", chart.dump());
    CHECK(drawn(in(dir, "other.json"), dir.path / "other") != first);
    const std::string& page = first.at("chart.html");
    for (const char* outside : { "src=", "@import", "url(http", "fetch(" })
        CHECK(page.find(outside) == std::string::npos);

    const std::string browser = AO_BROWSER;
    if (browser.empty()) {
        WARN("the page is not looked at: no chromium");
        return;
    }
    // In a profile of its own; the first point's text is shown as if the mouse were over it.
    const int status =
        shell("HOME=" + dir.path.string() + " timeout 120 " + browser +
              " --headless --no-sandbox --disable-gpu --user-data-dir=" + in(dir, "profile") + " --dump-dom 'file://" +
              (dir.path / "first" / "chart.html").string() + "#time-0' > " + in(dir, "dom.html") + " 2> /dev/null");
    REQUIRE(status == 0);
    const std::string dom = read_all(dir.path / "dom.html");
    const std::size_t start = page.find("const texts = ") + 14;
    const json texts = json::parse(page.substr(start, page.find(";\n", start) - start));
    CHECK(texts.size() > 60);
    CHECK(dom.find("data-points=\"" + std::to_string(texts.size()) + "\"") != std::string::npos);
    const std::string shown = texts.at("time-0").at(0).get<std::string>();
    const std::size_t tip = dom.find("<div id=\"tip\"");
    REQUIRE(tip != std::string::npos);
    CHECK(dom.find(shown, tip) < dom.find("</div>", tip));
    CHECK(dom.find("display: block", tip) < dom.find("</div>", tip));
}

TEST_CASE("files of scenes are read in both forms, and what is wrong is said", "[tools][chart]")
{
    const scratch_directory dir;
    dir.file("floor.obj", "v -3 0 -3\nv 3 0 -3\nv 3 0 3\nv -3 0 3\nv -1 0 0\nv 1 0 0\nv 1 2 0\nf 4 3 2 1\nf 5 6 7\n");
    const std::string list =
        dir.file("list.json", R"([{"model": "floor.obj", "radius": 0.5, "cameras": [{"name": "here", "eye": [0, 1, 4]}]}])");
    const std::string object =
        dir.file("object.json", R"({"floor.obj": [{"name": "here", "eye": [0, 1, 4], "yaw": 0, "pitch": 0, "radius": 0.5}]})");
    const auto charted = [&](const std::string& file) {
        const int status = run(dir, { "chart",   "--no-bundled", "--scenes", file,     "--size",
                                      "48x32",   "--methods",    "box",      "--taps", "4",
                                      "--parts", "frames",       "--rounds", "1",      "--backends",
                                      "cpu",     "--reference",  "8",        "--json", in(dir, "chart.json") });
        INFO(read_all(dir.path / "err"));
        REQUIRE(status == 0);
        json chart = json::parse(read_all(dir.path / "chart.json"));
        for (json& c : chart.at("single"))
            c.erase("times");
        return chart;
    };
    const json from_list = charted(list);
    CHECK(from_list.at("views").at(0).at("name") == "here");
    CHECK(from_list.at("views").at(0).at("radius") == 0.5);
    CHECK(from_list == charted(object));

    check_failure(dir, { "chart", "--methods", "none" }, "--methods");
    check_failure(dir, { "chart", "--taps", "0" }, "--taps");
    check_failure(dir, { "chart", "--size", "1x1" }, "--size");
    check_failure(dir, { "chart", "--backends", "dx" }, "--backends");
    check_failure(dir, { "chart", "--no-bundled" }, "--no-bundled");
    check_failure(dir, { "chart", "--scenes", in(dir, "missing.json") }, "missing.json");
    check_failure(dir, { "chart", "--scenes", dir.file("twice.json", R"([{"model": "floor.obj"}, {"model": "floor.obj"}])") },
                  "two views");
}
