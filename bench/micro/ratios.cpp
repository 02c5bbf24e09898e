// Backends against each other, a tap against a bare fetch, and how cost grows with taps, pixels and radius: interleaved medians
// of one run, as Markdown. Every picture is compared with the scalar CPU's before its clock starts.
#include "host/runner.hpp"
#include "micro/courtyard_input.hpp"
#include "micro/measure.hpp"
#ifdef AO_HAS_VK
#include "micro/fetch_probe.hpp"
#endif

#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace ao;
using namespace ao::bench;

const bench::input& input_of(int width, int height)
{
    static std::map<std::pair<int, int>, bench::input> made;
    const auto [at, fresh] = made.try_emplace({ width, height });
    if (fresh) {
        at->second = bench::courtyard_input(width, height);
    }
    return at->second;
}

struct workload {
    int width = 1280;
    int height = 720;
    int taps = 32;
    float radius = 1;
};

// The occlusion pass alone, checked against the scalar CPU.
contestant occlusion(std::shared_ptr<host::runner> subject, const workload& w)
{
    const bench::input& in = input_of(w.width, w.height);
    settings chosen;
    chosen.taps = w.taps;
    chosen.radius = w.radius;
    chosen.filter = 1;
    const picture drawn = take(subject->run(chosen, in.facts, in.camera, in.depth, in.normal));
    if (subject->exact()) {
        auto scalar = take(host::make_runners("cpu", {}, "scalar"));
        if (take(scalar.front()->run(chosen, in.facts, in.camera, in.depth, in.normal)).bytes != drawn.bytes) {
            stop(subject->name() + " draws another picture than the scalar CPU");
        }
    }
    return { subject->name(), [subject] { return take(subject->frame()).front().ms; }, {} };
}

std::shared_ptr<host::runner> one(std::string_view backend)
{
    return std::move(take(host::make_runners(backend)).front());
}

void compare_backends()
{
    std::vector<contestant> field;
    for (host::runner_ptr& each : take(host::make_runners("all"))) {
        field.push_back(occlusion(std::move(each), {}));
    }
    field.push_back(occlusion(one("cpu"), {}));
    field.back().name = "cpu, as it chooses";
    measure(field);
    std::printf("## 32 taps at 1280x720, occlusion pass\n\n| backend | ms | Mpixel/s | times cpu |\n|---|---|---|---|\n");
    for (const contestant& each : field) {
        std::printf("| %s | %.2f | %.1f | %.2f |\n", each.name.c_str(), each.median(), 0.9216 / each.median() * 1000,
                    each.median() / field.back().median());
    }
    std::printf("\n");
}

void compare_taps(std::string_view backend)
{
    const std::vector<int> counts{ 8, 16, 32, 64, 128 };
    std::vector<double> x(counts.begin(), counts.end());
    std::vector<contestant> field;
    for (const int taps : counts) {
        field.push_back(occlusion(one(backend), { 1280, 720, taps, 1 }));
    }
    const bool fetches = backend == "vk";
#ifdef AO_HAS_VK
    std::unique_ptr<host::vulkan_device> device;
    std::vector<std::unique_ptr<bench::fetch_probe>> probes;
    if (fetches) {
        device = take(host::vulkan_device::create());
        for (const int count : counts) {
            const picture& depth = input_of(1280, 720).depth;
            probes.push_back(take(bench::fetch_probe::create(*device, depth, count)));
            bench::fetch_probe* probe = probes.back().get();
            take(probe->run());
            if (take(probe->download()).bytes != bench::expected_sums(depth, count).bytes) {
                stop("the fetch probe's sums are not those of C++");
            }
            field.push_back({ "fetch", [probe] { return take(probe->run()); }, {} });
        }
    }
#endif
    measure(field);
    std::vector<double> pass;
    std::vector<double> bare;
    std::printf("## Taps, %s at 1280x720\n\n| taps | pass, ms | ns per tap and pixel |%s\n|---|---|---|%s\n",
                std::string(backend).c_str(), fetches ? " texelFetch, ms | ns per fetch and pixel | ratio |" : "",
                fetches ? "---|---|---|" : "");
    for (std::size_t i = 0; i < counts.size(); ++i) {
        pass.push_back(field[i].median());
        const auto ns = [&](double ms) { return ms * 1e6 / 921600 / counts[i]; };
        std::printf("| %d | %.2f | %.2f |", counts[i], pass[i], ns(pass[i]));
        if (fetches) {
            bare.push_back(field[counts.size() + i].median());
            std::printf(" %.2f | %.2f | %.2f |", bare[i], ns(bare[i]), pass[i] / bare[i]);
        }
        std::printf("\n");
    }
    const line of_pass = fit(x, pass);
    std::printf("\nA tap costs %.2f ns a pixel, everything else %.2f ms; the times leave a straight line by %.1f %% at most.\n",
                of_pass.slope * 1e6 / 921600, of_pass.start, of_pass.bend * 100);
    if (fetches) {
        const line of_fetch = fit(x, bare);
        std::printf("A bare texelFetch costs %.2f ns a pixel: **a tap costs %.2f fetches** (slopes of both).\n",
                    of_fetch.slope * 1e6 / 921600, of_pass.slope / of_fetch.slope);
    }
    std::printf("\n");
}

void compare_sizes(std::string_view backend)
{
    const std::vector<std::pair<int, int>> sizes{ { 640, 360 }, { 960, 540 }, { 1280, 720 }, { 1920, 1080 } };
    std::vector<contestant> field;
    std::vector<double> x;
    for (const auto& [width, height] : sizes) {
        field.push_back(occlusion(one(backend), { width, height, 32, 1 }));
        x.push_back(static_cast<double>(width) * height);
    }
    measure(field);
    std::vector<double> y;
    std::printf("## Pixels, %s, 32 taps\n\n| size | ms | ns per pixel |\n|---|---|---|\n", std::string(backend).c_str());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        y.push_back(field[i].median());
        std::printf("| %dx%d | %.2f | %.1f |\n", sizes[i].first, sizes[i].second, y[i], y[i] * 1e6 / x[i]);
    }
    std::printf("\nThe times leave a straight line by %.1f %% at most.\n\n", fit(x, y).bend * 100);
}

void compare_radii(std::string_view backend)
{
    const std::vector<float> radii{ 0.1F, 1.0F, 10.0F };
    std::vector<contestant> field;
    for (const float radius : radii) {
        field.push_back(occlusion(one(backend), { 1280, 720, 32, radius }));
    }
    measure(field);
    std::printf("## Radius, %s, 32 taps at 1280x720\n\n| radius | ms | times radius 1 |\n|---|---|---|\n",
                std::string(backend).c_str());
    for (std::size_t i = 0; i < radii.size(); ++i) {
        std::printf("| %g | %.2f | %.2f |\n", static_cast<double>(radii[i]), field[i].median(),
                    field[i].median() / field[1].median());
    }
    std::printf("\n");
}

} // namespace

// Takes and ignores Google Benchmark's options, which ./run bench gives to every program.
int main()
{
    compare_backends();
    for (const std::string_view backend : { "vk", "gl", "cpu" }) {
        compare_taps(backend);
        compare_sizes(backend);
        compare_radii(backend);
        std::fflush(stdout);
    }
}
