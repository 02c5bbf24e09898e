// Every pass on every backend and route in pixels/s, over the courtyard. Before the clock starts the picture must be the scalar
// CPU's, bit for bit. Times are the device's own, or the host's around one pass where it has no clock (tools/host/runner.hpp).
#include "host/runner.hpp"
#include "micro/courtyard_input.hpp"
#ifdef AO_HAS_VK
#include "micro/fetch_probe.hpp"
#endif

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>
#include <tuple>

namespace {

using namespace ao;

struct workload {
    int width = 1280;
    int height = 720;
    settings chosen;
};

const bench::input& input_of(int width, int height)
{
    static std::map<std::pair<int, int>, bench::input> made;
    const auto [at, fresh] = made.try_emplace({ width, height });
    if (fresh) {
        at->second = bench::courtyard_input(width, height);
    }
    return at->second;
}

// Depth as a depth buffer, so that every pass runs.
bench::input hardware_depth(const bench::input& from)
{
    bench::input in = from;
    in.facts.depth = depth_source::hardware;
    in.facts.depth_format = pixel_format::d32f;
    std::vector<float> eye(from.depth.pixels());
    for (std::size_t i = 0; i < eye.size(); ++i) {
        eye[i] = from.depth.texel<float>(i);
    }
    in.depth = pack_depth(eye, from.depth.width, from.depth.height, in.facts.depth, in.facts.depth_format, in.camera.projection);
    return in;
}

// The scalar CPU's picture.
const picture& reference(const workload& w, const bench::input& in)
{
    static std::map<std::tuple<int, int, int, float, int>, picture> made;
    const auto key = std::tuple(w.width, w.height, w.chosen.taps, w.chosen.radius, w.chosen.filter);
    const auto [at, fresh] = made.try_emplace(key);
    if (fresh) {
        auto scalar = host::make_runners("cpu", {}, "scalar");
        if (scalar) {
            auto drawn = scalar->front()->run(w.chosen, in.facts, in.camera, in.depth, in.normal);
            if (drawn) {
                at->second = *drawn;
            }
        }
    }
    return at->second;
}

void run_pass(benchmark::State& state, host::runner& subject, const workload& w, pass_type type)
{
    const bench::input& linear = input_of(w.width, w.height);
    const bench::input in = type == pass_type::linearize ? hardware_depth(linear) : linear;
    const auto drawn = subject.run(w.chosen, in.facts, in.camera, in.depth, in.normal);
    if (!drawn) {
        state.SkipWithError(std::string(drawn.error().reason()).c_str());
        return;
    }
    if (type == pass_type::linearize) {
        auto scalar = host::make_runners("cpu", {}, "scalar");
        const auto expected = scalar ? scalar->front()->run(w.chosen, in.facts, in.camera, in.depth, in.normal) : drawn;
        if (!scalar || !expected || (subject.exact() && expected->bytes != drawn->bytes)) {
            state.SkipWithError("the picture is not the scalar CPU's");
            return;
        }
    }
    else if (subject.exact() && reference(w, in).bytes != drawn->bytes) {
        state.SkipWithError("the picture is not the scalar CPU's");
        return;
    }
    for (auto _ : state) {
        const auto times = subject.frame();
        if (!times) {
            state.SkipWithError(std::string(times.error().reason()).c_str());
            break;
        }
        for (const host::pass_time& each : *times) {
            if (each.pass == type) {
                state.SetIterationTime(each.ms / 1000);
            }
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * w.width * w.height);
}

void add(const std::string& name, host::runner& subject, const workload& w, pass_type type)
{
    benchmark::RegisterBenchmark((name + "/" + subject.name()).c_str(),
                                 [&subject, w, type](benchmark::State& state) { run_pass(state, subject, w, type); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->MinTime(0.5);
}

void add_all(host::runner& subject)
{
    workload base;
    base.chosen.filter = 5;
    add("linearize", subject, base, pass_type::linearize);
    add("filter_rows", subject, base, pass_type::filter_rows);
    add("filter_columns", subject, base, pass_type::filter_columns);
    for (const int taps : { 8, 16, 32, 64, 128 }) {
        workload w = base;
        w.chosen.taps = taps;
        add("occlusion/taps:" + std::to_string(taps), subject, w, pass_type::occlusion);
    }
    for (const float radius : { 0.1F, 10.0F }) {
        workload w = base;
        w.chosen.radius = radius;
        char name[32];
        std::snprintf(name, sizeof name, "occlusion/radius:%g", static_cast<double>(radius));
        add(name, subject, w, pass_type::occlusion);
    }
    for (const auto& [width, height] : { std::pair{ 320, 180 }, { 640, 360 }, { 1920, 1080 } }) {
        workload w = base;
        w.width = width;
        w.height = height;
        add("occlusion/size:" + std::to_string(width) + "x" + std::to_string(height), subject, w, pass_type::occlusion);
    }
    for (const int size : { 3, 9, 31 }) {
        workload w = base;
        w.chosen.filter = size;
        add("filter_rows/filter:" + std::to_string(size), subject, w, pass_type::filter_rows);
    }
}

#ifdef AO_HAS_VK
void run_fetches(benchmark::State& state)
{
    const int fetches = static_cast<int>(state.range(0));
    const bench::input& in = input_of(1280, 720);
    auto device = host::vulkan_device::create();
    if (!device) {
        state.SkipWithError(device.reason().c_str());
        return;
    }
    auto probe = bench::fetch_probe::create(**device, in.depth, fetches);
    if (!probe) {
        state.SkipWithError(probe.reason().c_str());
        return;
    }
    const auto first = (*probe)->run();
    const auto sums = (*probe)->download();
    if (!first || !sums || sums->bytes != bench::expected_sums(in.depth, fetches).bytes) {
        state.SkipWithError("the sums are not those of C++");
        return;
    }
    for (auto _ : state) {
        const auto ms = (*probe)->run();
        state.SetIterationTime(ms ? *ms / 1000 : 0);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * 1280 * 720);
}
#endif

} // namespace

int main(int count, char** arguments)
{
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments)) {
        return 1;
    }
    auto subjects = host::make_runners("all");
    if (!subjects) {
        std::fprintf(stderr, "ao: %.*s\n", static_cast<int>(subjects.error().reason().size()), subjects.error().reason().data());
        return 1;
    }
    for (const host::runner_ptr& each : *subjects) {
        add_all(*each);
    }
#ifdef AO_HAS_VK
    benchmark::RegisterBenchmark("texelFetch of R32F/vk", run_fetches)
        ->ArgName("fetches")
        ->Arg(8)
        ->Arg(16)
        ->Arg(32)
        ->Arg(64)
        ->Arg(128)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->MinTime(0.5);
#endif
    benchmark::RunSpecifiedBenchmarks();
}
