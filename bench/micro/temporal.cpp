// What a temporal frame costs beside 32 fresh samples by the same passes and beside the ao effect: interleaved medians of one
// run, as Markdown. Backends draw the same pictures, or there are no times.
//     bench_temporal [--processor-time]     of cpu alone, with one thread: what a busy machine disturbs less
#include "host/runner.hpp"
#include "host/temporal_runner.hpp"
#include "micro/measure.hpp"
#include "unit/temporal_scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace ao;
using namespace ao::bench;

constexpr int width = 640;
constexpr int height = 360;
constexpr int rounds = 15;

bool processor_time = false;

// Milliseconds of the processor's, where they were asked for, else those that `what` returns.
template <class What>
double milliseconds(What&& what)
{
    const std::clock_t start = std::clock();
    const double told = what();
    const double spent = 1e3 * static_cast<double>(std::clock() - start) / static_cast<double>(CLOCKS_PER_SEC);
    return processor_time ? spent : told;
}

host::temporal_runner_ptr make_temporal_runner(std::string_view backend)
{
    return processor_time ? take(host::make_cpu_temporal_runner({ .threads = 1 }))
                          : std::move(take(host::make_temporal_runners(backend)).front());
}

host::runner_ptr make_runner(std::string_view backend)
{
    return processor_time ? take(host::make_cpu_runner({ .threads = 1 })) : std::move(take(host::make_runners(backend)).front());
}

enum class movement { none, camera, camera_and_ball };

// Frames before the clock starts: histories weigh what they will from then on, and what has converged is filtered no more.
constexpr int run_in = 24;

// The camera goes 1.6 pixels a frame on the ball, the ball 2.7 in the other direction.
temporal_test::stage stage_at(movement m, int frame)
{
    temporal_test::stage s{ .width = width, .height = height };
    if (m != movement::none) {
        s.eye = { 0.03 * frame - 0.6, 0, 0 };
    }
    s.ball = m == movement::camera_and_ball ? 1.0 - 0.05 * frame : 0;
    return s;
}

const temporal_test::scene_frame& frame_at(movement m, int frame)
{
    // A still view has one frame.
    static std::vector<temporal_test::scene_frame> made[3];
    std::vector<temporal_test::scene_frame>& all = made[static_cast<int>(m)];
    const int index = m == movement::none ? 0 : frame;
    while (static_cast<int>(all.size()) <= index) {
        const int next = static_cast<int>(all.size());
        all.push_back(temporal_test::make_frame(stage_at(m, next), stage_at(m, next == 0 ? 0 : next - 1)));
    }
    return all[static_cast<std::size_t>(index)];
}

struct row {
    const char* name;
    movement moves;
    bool motion; // objects may move
    bool cut;    // in every frame
    temporal_settings settings;
};

std::vector<row> rows()
{
    temporal_settings fresh;
    fresh.first_samples = fresh.later_samples = 32;
    temporal_settings kept;
    kept.invalidation = invalidation_type::none;
    temporal_settings packed;
    packed.format = history_format::packed;
    temporal_settings bilinear;
    bilinear.cubic = false;
    temporal_settings eight;
    eight.first_samples = 8;
    return { { "32 fresh samples", movement::camera, false, true, fresh },
             { "still, k = 8", movement::none, false, false, {} },
             { "camera moves, k = 8", movement::camera, false, false, eight },
             { "camera moves, k = 32 and 8", movement::camera, false, false, {} },
             { "the same, bilinear", movement::camera, false, false, bilinear },
             { "the same, packed history", movement::camera, false, false, packed },
             { "camera and object move, k = 8", movement::camera_and_ball, true, false, eight },
             { "camera and object move, k = 32 and 8", movement::camera_and_ball, true, false, {} },
             { "the same, no invalidation", movement::camera_and_ball, true, false, kept },
             { "the same, packed history", movement::camera_and_ball, true, false, packed } };
}

// A row's frames on one backend, one after the other.
class subject {
public:
    subject(std::string_view backend, const row& r) : row_(r), runner_(make_temporal_runner(backend))
    {
        take(runner_->prepare(r.settings, temporal_test::facts_of(stage_at(r.moves, 0), r.motion)));
        for (int i = 0; i < run_in; ++i) {
            run();
        }
    }

    // Milliseconds of all passes.
    double run()
    {
        const temporal_test::scene_frame& f = frame_at(row_.moves, frame_++);
        take(runner_->upload(f.inputs.depth, f.inputs.normal, f.inputs.motion));
        return milliseconds([&] {
            double sum = 0;
            double after = 0;
            for (const host::temporal_pass_time& each : take(runner_->frame(f.camera, row_.cut))) {
                sum += each.ms;
                if (each.pass == temporal_pass_type::accumulate) {
                    accumulate.times.push_back(each.ms);
                }
                else if (each.pass != temporal_pass_type::linearize) {
                    after += each.ms;
                }
            }
            filter.times.push_back(after);
            return sum;
        });
    }

    // Of the latest frame, new ones per pixel: how far each sequence has gone on from the pixel where its surface was, as far as
    // its motion tells that pixel; the others are left out. Precondition: precise histories.
    double samples(const std::vector<std::uint32_t>& before)
    {
        const std::vector<std::uint32_t> now = words();
        const picture& motion = frame_at(row_.moves, frame_ - 1).inputs.motion;
        const auto index_of = [](const std::vector<std::uint32_t>& all, int x, int y) {
            return static_cast<double>(std::bit_cast<float>(all[4 * static_cast<std::size_t>(y * width + x) + 2]));
        };
        double sum = 0;
        int told = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto moved = motion.texel<glm::vec4>(static_cast<std::size_t>(y * width + x));
                const float column = static_cast<float>(x) + 0.5F + moved.x;
                const float row = static_cast<float>(y) + 0.5F + moved.y;
                const bool known = !row_.cut && column >= 0 && row >= 0 && column < width && row < height;
                const double from = known ? index_of(before, static_cast<int>(column), static_cast<int>(row)) : 0;
                const double taken = std::fmod(index_of(now, x, y) - from + row_.settings.period, row_.settings.period);
                if (taken <= std::max(row_.settings.first_samples, row_.settings.later_samples)) {
                    sum += taken;
                    ++told;
                }
            }
        }
        return sum / told;
    }

    std::vector<std::uint32_t> words() { return take(runner_->history()); }
    bool precise() const { return row_.settings.format == history_format::precise; }
    picture seen() { return take(runner_->download()); }
    bool exact() const { return runner_->exact(); }

    contestant accumulate;
    contestant filter; // and resolve

private:
    row row_;
    host::temporal_runner_ptr runner_;
    int frame_ = 0;
};

// The ao effect with as many taps as fresh samples, its occlusion pass apart.
struct effect {
    explicit effect(std::string_view backend) : runner(make_runner(backend))
    {
        const temporal_test::scene_frame& f = frame_at(movement::none, 0);
        take(runner->prepare({ .taps = 32 }, temporal_test::facts_of(stage_at(movement::none, 0), false).frame,
                             { .projection = f.camera.projection }));
        take(runner->upload(f.inputs.depth, f.inputs.normal));
    }

    double run()
    {
        return milliseconds([&] {
            double sum = 0;
            for (const host::pass_time& each : take(runner->frame())) {
                sum += each.ms;
                if (each.pass == pass_type::occlusion) {
                    occlusion.times.push_back(each.ms);
                }
            }
            return sum;
        });
    }

    host::runner_ptr runner;
    contestant occlusion;
};

void compare(std::string_view backend)
{
    static std::vector<picture> expected;
    const std::vector<row> all = rows();
    effect plain(backend);
    std::vector<std::unique_ptr<subject>> subjects;
    std::vector<contestant> field{ { "the ao effect, 32 taps", [&] { return plain.run(); }, {} } };
    for (const row& each : all) {
        subjects.push_back(std::make_unique<subject>(backend, each));
        subjects.back()->accumulate.times.clear();
        subjects.back()->filter.times.clear();
        field.push_back({ each.name, [s = subjects.back().get()] { return s->run(); }, {} });
    }
    measure(field, rounds);
    const auto median_of = [](contestant pass) {
        pass.times.erase(pass.times.begin()); // measure's round for warming up
        pass.times.resize(rounds);
        return pass.median();
    };
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        const picture drawn = subjects[i]->seen();
        if (expected.size() < subjects.size()) {
            expected.push_back(drawn);
        }
        else if (subjects[i]->exact() && drawn.bytes != expected[i].bytes) {
            stop(std::string(backend) + " draws another picture than the first backend: " + all[i].name);
        }
    }

    std::vector<std::string> samples{ "32" };
    for (const auto& each : subjects) {
        const std::vector<std::uint32_t> before = each->words();
        each->run();
        char text[16] = "";
        if (each->precise()) {
            std::snprintf(text, sizeof text, "%.1f", each->samples(before));
        }
        samples.emplace_back(text);
    }

    const double fresh = field[1].median();
    const double fresh_pass = median_of(subjects[0]->accumulate);
    const double fresh_filter = median_of(subjects[0]->filter);
    std::printf(
        "## %s, %dx%d\n\n| | samples a pixel | their pass, ms | of 32 fresh | resolve and filter, ms | of 32 fresh | frame, ms | "
        "of 32 fresh | of the ao effect |\n"
        "|---|---|---|---|---|---|---|---|---|\n",
        std::string(backend).c_str(), width, height);
    for (std::size_t i = 0; i < field.size(); ++i) {
        const double pass = median_of(i == 0 ? plain.occlusion : subjects[i - 1]->accumulate);
        const double ms = field[i].median();
        const double after = i == 0 ? ms - pass : median_of(subjects[i - 1]->filter);
        std::printf("| %s | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", field[i].name.c_str(), samples[i].c_str(),
                    pass, pass / fresh_pass, after, after / fresh_filter, ms, ms / fresh, ms / field[0].median());
    }
    std::printf("\n");
    std::fflush(stdout);
}

} // namespace

// Ignores Google Benchmark's options, which ./run bench gives to every program.
int main(int count, char** words)
{
    for (int i = 1; i < count; ++i) {
        processor_time = processor_time || std::strcmp(words[i], "--processor-time") == 0;
    }
    if (processor_time) {
        std::printf("Frames in milliseconds of the processor's, passes by the wall's clock.\n\n");
        compare("cpu");
        return 0;
    }
    for (const auto& each : take(host::make_temporal_runners("all"))) {
        compare(each->backend());
    }
}
