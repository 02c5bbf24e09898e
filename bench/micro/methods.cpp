// The presets of `bitmask` beside `box` with 32 taps, each with its filter, on every backend: interleaved medians of one run, as
// Markdown; and how their cost grows with taps and radius. Every picture is compared with the scalar CPU's first.
#include "host/runner.hpp"
#include "micro/courtyard_input.hpp"
#include "micro/measure.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace ao;
using namespace ao::bench;

const bench::input& courtyard()
{
    static const bench::input made = bench::courtyard_input(1280, 720);
    return made;
}

// All passes of a frame.
contestant frame_of(std::string_view backend, const std::string& name, const settings& chosen)
{
    std::shared_ptr<host::runner> subject = std::move(take(host::make_runners(backend)).front());
    const bench::input& in = courtyard();
    const picture drawn = take(subject->run(chosen, in.facts, in.camera, in.depth, in.normal));
    if (subject->exact()) {
        auto scalar = take(host::make_runners("cpu", {}, "scalar"));
        if (take(scalar.front()->run(chosen, in.facts, in.camera, in.depth, in.normal)).bytes != drawn.bytes) {
            stop(subject->name() + " draws another picture than the scalar CPU: " + name);
        }
    }
    return { name,
             [subject] {
                 double ms = 0;
                 for (const host::pass_time& pass : take(subject->frame())) {
                     ms += pass.ms;
                 }
                 return ms;
             },
             {} };
}

settings printed()
{
    settings s;
    s.method = method::box;
    return s;
}

void compare_presets(std::string_view backend)
{
    std::vector<contestant> field;
    field.push_back(frame_of(backend, "box, 32 taps, filter 5", printed()));
    field.push_back(frame_of(backend, "bitmask low, 4 taps", settings_of(preset::low)));
    field.push_back(frame_of(backend, "bitmask medium, 8 taps", settings_of(preset::medium)));
    field.push_back(frame_of(backend, "bitmask high, 18 taps", settings_of(preset::high)));
    field.push_back(frame_of(backend, "bitmask ultra, 36 taps", settings_of(preset::ultra)));
    measure(field);
    std::printf("## %s, 1280x720, all passes\n\n| method | ms | times box |\n|---|---|---|\n", std::string(backend).c_str());
    for (const contestant& each : field) {
        std::printf("| %s | %.2f | %.2f |\n", each.name.c_str(), each.median(), each.median() / field.front().median());
    }
    std::printf("\n");
}

// Nothing but the taps differs.
void compare_taps(std::string_view backend)
{
    std::vector<contestant> field;
    const std::vector<double> taps{ 4, 8, 16, 32 };
    for (const double count : taps) {
        settings s = settings_of(preset::high);
        s.taps = static_cast<int>(count);
        field.push_back(frame_of(backend, std::to_string(s.taps), s));
    }
    measure(field);
    std::vector<double> ms;
    for (const contestant& each : field) {
        ms.push_back(each.median());
    }
    const line of_taps = fit(taps, ms);
    std::printf(
        "high with 4, 8, 16 and 32 taps: a tap costs %.2f ms, everything else %.2f ms; the times leave a straight line by "
        "%.1f %% at most\n\n",
        of_taps.slope, of_taps.start, of_taps.bend * 100);
}

void compare_radii(std::string_view backend)
{
    std::vector<contestant> field;
    for (const float radius : { 0.1F, 1.0F, 10.0F }) {
        field.push_back(frame_of(backend, std::to_string(radius), settings_of(preset::high, radius)));
    }
    measure(field);
    std::printf("high at radius 0.1, 1 and 10: %.2f, 1, %.2f times\n\n", field[0].median() / field[1].median(),
                field[2].median() / field[1].median());
}

} // namespace

// Takes and ignores Google Benchmark's options, which ./run bench gives to every program.
int main()
{
    for (const std::string_view backend : { "cpu", "vk", "gl" }) {
        compare_presets(backend);
        compare_taps(backend);
        compare_radii(backend);
        std::fflush(stdout);
    }
}
