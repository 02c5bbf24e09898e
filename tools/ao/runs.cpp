#include "ao/runs.hpp"

#include "ao/half.hpp"
#include "ao/outcome.hpp"
#include "ao/result_text.hpp"
#include "host/runner.hpp"
#include "host/scene_runner.hpp"
#include "scene/metrics.hpp"

#include <algorithm>
#include <chrono>
#include <functional>

namespace ao::tools {
namespace {

void time_frames(run_outcome& out, host::runner& r, int frames)
{
    (void)take(out.backend, r.frame());
    out.first_frame_ms = r.first_frame_ms();
    stop_if_interrupted();
    std::vector<std::vector<double>> times;
    std::vector<double> totals;
    for (int frame = 0; frame < frames; ++frame) {
        const std::vector<host::pass_time> passes = take(out.backend, r.frame());
        if (frame == 0) {
            times.resize(passes.size());
            for (const host::pass_time& p : passes)
                out.passes.push_back({ pass_text(p.pass), 0.0 });
        }
        double total = 0;
        for (std::size_t i = 0; i < passes.size(); ++i) {
            times[i].push_back(passes[i].ms);
            total += passes[i].ms;
        }
        totals.push_back(total);
        stop_if_interrupted();
    }
    for (std::size_t i = 0; i < times.size(); ++i)
        out.passes[i].ms = median(times[i]);
    out.total_ms = median(totals);
}

using clock = std::chrono::steady_clock;

double ms_since(clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(clock::now() - start).count();
}

// One untimed frame, then the median of the others.
double median_of_frames(int frames, const std::string& where, const std::function<ao::result<double>()>& once)
{
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        times.push_back(take(where, once()));
        stop_if_interrupted();
    }
    return median(std::move(times));
}

run_outcome run(host::runner& r, const std::string& label, const run_inputs& in, const picture_set& pictures)
{
    run_outcome out;
    out.label = label;
    out.backend = r.backend();
    out.device = r.device();
    out.route = r.route();
    (void)take(out.backend, r.prepare(in.settings, in.facts, in.view.effect));
    const ao::picture& depth = in.facts.depth == depth_source::linear     ? in.linear_depth
                               : in.facts.depth == depth_source::position ? pictures[host::scene_picture::position]
                                                                          : pictures[host::scene_picture::depth];
    (void)take(out.backend, r.upload(depth, pictures[host::scene_picture::normal]));
    time_frames(out, r, in.frames);
    out.stored = take(out.backend, r.download());
    for (std::size_t i = 0; i < out.stored.pixels(); ++i) {
        if (!in.settings.bent_normal) {
            out.visibility.push_back(out.stored.texel<float>(i));
            continue;
        }
        const auto halves = out.stored.texel<std::array<std::uint16_t, 4>>(i);
        out.visibility.push_back(half_to_float(halves[0]));
        for (std::size_t c = 1; c < 4; ++c)
            out.bent_normal.push_back(half_to_float(halves[c]));
    }
    return out;
}

// Draws, or uploads what was given instead.
void fill_targets(scene_outcome& out, host::scene_runner& r, const run_inputs& in)
{
    if (in.pictures) {
        out.drawn = *in.pictures;
        (void)take(out.backend, r.make_targets(in.targets));
        for (std::size_t i = 0; i < host::scene_picture_count; ++i)
            if (!out.drawn.pictures[i].bytes.empty())
                (void)take(out.backend, r.upload(static_cast<host::scene_picture>(i), out.drawn.pictures[i]));
        return;
    }
    const auto start = clock::now();
    (void)take(out.backend, r.load(in.scene, in.targets));
    (void)take(out.backend, r.draw(in.view.drawing));
    out.first_draw_ms = ms_since(start);
    stop_if_interrupted();
    out.draw_ms = median_of_frames(in.frames, out.backend, [&] { return r.draw(in.view.drawing); });
    out.counts = r.counts();
    for (std::size_t i = 0; i < host::scene_picture_count; ++i)
        if (host::format_of(in.targets, static_cast<host::scene_picture>(i)))
            out.drawn.pictures[i] = take(out.backend, r.download(static_cast<host::scene_picture>(i)));
}

void shade(scene_outcome& out, host::scene_runner& r, const run_inputs& in, const ao::picture& visibility)
{
    const auto start = clock::now();
    (void)take(out.backend, r.prepare_shading(*in.shading, in.heap));
    (void)take(out.backend, r.shade());
    out.first_shade_ms = ms_since(start);
    out.clamped = take(out.backend, r.clamped_weights());
    out.plain = take(out.backend, r.download(host::scene_picture::color));
    stop_if_interrupted();
    (void)take(out.backend, r.upload(host::scene_picture::visibility, visibility));
    out.shade_ms = median_of_frames(in.frames, out.backend, [&] { return r.shade(); });
    out.color = take(out.backend, r.download(host::scene_picture::color));
}

} // namespace

all_outcomes run_all(const render_options& o, const run_inputs& in)
{
    all_outcomes all;
    struct route {
        std::string name;
        std::string label;
    };
    // Each with its device gone before the next begins: none shares the machine with another.
    const auto add = [&](const std::string& backend, const std::vector<route>& routes) {
        std::vector<host::scene_runner_ptr> scenes;
        if (!in.pictures || in.shading) {
            scenes = take(backend, host::make_scene_runners(backend, o.device));
            host::scene_runner& r = *scenes.front();
            scene_outcome out;
            out.label = out.backend = backend;
            out.device = r.device();
            out.route = r.route();
            fill_targets(out, r, in);
            all.scenes.push_back(std::move(out));
        }
        const std::size_t first = all.runs.size();
        for (const route& each : routes) {
            for (const host::runner_ptr& r : take(backend, host::make_runners(backend, o.device, each.name))) {
                all.runs.push_back(run(*r, each.label, in, scenes.empty() ? *in.pictures : all.scenes.back().drawn));
                all.runs.back().scene = scenes.empty() ? 0 : all.scenes.size() - 1;
            }
        }
        if (in.shading)
            shade(all.scenes.back(), *scenes.front(), in, all.runs[first].stored);
    };
    if (o.cpu)
        add("cpu", { { o.lanes == 0 ? "" : o.lanes == 1 ? "scalar" : "lanes" + std::to_string(o.lanes), "cpu" } });
    std::vector<route> gl;
    if (o.gl_compute)
        gl.push_back({ "compute", "gl" });
    if (o.gl_fragment)
        gl.push_back({ "fragment", "gl-fragment" });
    if (o.gl)
        add("gl", gl);
    if (o.vk)
        add("vk", { { "", "vk" } });
    return all;
}

} // namespace ao::tools
