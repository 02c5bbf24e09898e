#include "ao/temporal_runs.hpp"

#include "ao/outcome.hpp"
#include "host/runner.hpp"
#include "host/scene_runner.hpp"
#include "host/temporal_runner.hpp"
#include "scene/signals.hpp"

#include <chrono>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

namespace ao::tools {
namespace {

using host::scene_picture;

constexpr int frames_per_second = 12;

std::vector<float> floats_of(const ao::picture& p)
{
    std::vector<float> values(p.pixels());
    std::memcpy(values.data(), p.bytes.data(), p.bytes.size());
    return values;
}

// One backend through all frames.
class backend_run {
public:
    backend_run(const std::string& backend, host::temporal_runner_ptr runner, host::scene_runner_ptr raster)
        : runner_(std::move(runner)),
          raster_(std::move(raster))
    {
        run_.label = run_.backend = backend;
        run_.device = runner_->device();
        run_.route = runner_->route();
    }

    void frame(const render_options& o, const temporal_frames& all);
    // What the last frame was made from.
    [[nodiscard]] const temporal_pictures& pictures() const { return *pictures_; }
    [[nodiscard]] const std::vector<std::uint8_t>& surface() const { return watch_->surface(); }
    [[nodiscard]] temporal_run take_run()
    {
        run_.history = watch_->history();
        return std::move(run_);
    }

private:
    double draw(const temporal_frames& all);
    void measure(temporal_frame_outcome& out, const temporal_frames& all) const;

    host::temporal_runner_ptr runner_;
    host::scene_runner_ptr raster_; // none for rays
    std::optional<history_watch> watch_;
    temporal_pictures drawn_;
    const temporal_pictures* pictures_ = nullptr;
    temporal_run run_;
};

double backend_run::draw(const temporal_frames& all)
{
    const std::string& where = run_.backend;
    if (all.frame() == 0)
        (void)take(where, raster_->load(all.scene(), all.targets()));
    if (all.objects_move())
        (void)take(where, raster_->move(all.scene()));
    const double ms = take(where, raster_->draw(all.drawing()));
    const auto target = [&](bool wanted, scene_picture which) {
        return wanted ? take(where, raster_->download(which)) : ao::picture();
    };
    const ao::gbuffer_facts& f = all.targets();
    drawn_.depth = target(true, f.position ? scene_picture::position : scene_picture::depth);
    drawn_.normal = target(f.normal, scene_picture::normal);
    drawn_.motion = target(f.motion, scene_picture::motion);
    return ms;
}

void backend_run::frame(const render_options& o, const temporal_frames& all)
{
    const std::string& where = run_.backend;
    temporal_frame_outcome out;
    if (raster_)
        out.draw_ms = draw(all);
    pictures_ = raster_ ? &drawn_ : &all.pictures();
    const temporal_pictures& in = *pictures_;

    const auto start = std::chrono::steady_clock::now();
    if (all.frame() == 0) {
        (void)take(where, runner_->prepare(o.temporal->settings, all.facts()));
        watch_.emplace(runner_->plan());
    }
    (void)take(where, runner_->upload(in.depth, in.normal, in.motion));
    const temporal_camera camera = all.effect();
    for (const host::temporal_pass_time& p : take(where, runner_->frame(camera, all.cut()))) {
        out.passes.push_back({ host::name(p.pass), p.ms });
        out.total_ms += p.ms;
    }
    if (all.frame() == 0)
        run_.first_frame_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

    run_.visibility = floats_of(take(where, runner_->download()));
    out.facts =
        watch_->look({ in.depth, in.normal, in.motion, camera, all.cut(), take(where, runner_->history()), run_.visibility });
    measure(out, all);
    run_.frames.push_back(std::move(out));
    if (o.out.empty())
        return;
    if (!run_.shown)
        run_.shown.emplace(o.size, frames_per_second);
    run_.shown->add(to_bytes(run_.visibility));
}

// Pixels that both the backend and the rays saw a surface in.
std::vector<std::uint8_t> compared(const std::vector<std::uint8_t>& surface, const gbuffer& rays)
{
    std::vector<std::uint8_t> both = rays.hit;
    for (std::size_t i = 0; i < both.size(); ++i)
        both[i] = both[i] != 0 && surface[i] != 0 ? 1 : 0;
    return both;
}

void backend_run::measure(temporal_frame_outcome& out, const temporal_frames& all) const
{
    if (all.truth())
        out.error = error_against(run_.visibility, all.truth()->a, all.truth()->b, compared(watch_->surface(), all.rays()));
}

// The ordinary effect with as many taps as a pixel that is known gets new samples; of bitmask with its denoiser.
class single_frames {
public:
    single_frames(const render_options& o, const std::string& backend)
        : backend_(backend),
          runner_(std::move(take(backend, host::make_runners(backend, o.device)).front()))
    {
        const temporal_settings& s = o.temporal->settings;
        settings_ = o.settings;
        if (s.contribution == contribution_type::ritschel) {
            settings_.method = method::halton; // the density of temporal samples
            settings_.taps = std::min(s.later_samples, max_taps);
            settings_.filter = 1;
        }
        facts_ = o.inputs;
    }

    picture_error frame(const temporal_frames& all, const backend_run& like)
    {
        const ao::camera camera{ .projection = all.effect().projection };
        (void)(all.frame() == 0 ? take(backend_, runner_->prepare(settings_, facts_, camera))
                                : take(backend_, runner_->set_camera(camera)));
        (void)take(backend_, runner_->upload(like.pictures().depth, like.pictures().normal));
        (void)take(backend_, runner_->frame());
        const std::vector<float> seen = floats_of(take(backend_, runner_->download()));
        return error_against(seen, all.truth()->a, all.truth()->b, compared(like.surface(), all.rays()));
    }

private:
    std::string backend_;
    host::runner_ptr runner_;
    ao::settings settings_;
    ao::facts facts_;
};

host::temporal_runner_ptr make_runner(const render_options& o, const std::string& backend)
{
#ifdef AO_HAS_CPU
    if (backend == "cpu" && o.lanes != 0) {
        const cpu::width lanes = o.lanes == 1   ? cpu::width::scalar
                                 : o.lanes == 4 ? cpu::width::lanes4
                                 : o.lanes == 8 ? cpu::width::lanes8
                                                : cpu::width::lanes16;
        return take(backend, host::make_cpu_temporal_runner({ .lanes = lanes }));
    }
#endif
    return std::move(take(backend, host::make_temporal_runners(backend, o.device)).front());
}

backend_run make_run(const render_options& o, const std::string& backend)
{
    host::scene_runner_ptr raster;
    if (!o.rays)
        raster = std::move(take(backend, host::make_scene_runners(backend, o.device)).front());
    return { backend, make_runner(o, backend), std::move(raster) };
}

} // namespace

temporal_outcomes run_temporal(const render_options& o, temporal_frames& frames)
{
    std::vector<backend_run> runs;
    for (const auto& [wanted, backend] : { std::pair(o.cpu, "cpu"), std::pair(o.gl, "gl"), std::pair(o.vk, "vk") })
        if (wanted)
            runs.push_back(make_run(o, backend));
    std::optional<single_frames> alone;
    if (o.reference > 0 && o.temporal->settings.contribution != contribution_type::fox_compton)
        alone.emplace(o, o.cpu ? "cpu" : o.gl ? "gl" : "vk");

    temporal_outcomes all;
    progress_line progress("frames", o.progress);
    for (int f = 0; f < o.frames; ++f) {
        frames.advance();
        all.cuts.push_back(frames.cut() ? 1 : 0);
        for (backend_run& each : runs) {
            each.frame(o, frames);
            stop_if_interrupted();
        }
        if (alone)
            all.alone.push_back(alone->frame(frames, runs.front()));
        if (frames.truth() && !o.out.empty()) {
            if (!all.truth_shown)
                all.truth_shown.emplace(o.size, frames_per_second);
            all.truth_shown->add(to_bytes(mean(*frames.truth())));
        }
        progress.update(static_cast<double>(f + 1) / static_cast<double>(o.frames));
    }
    for (backend_run& each : runs)
        all.runs.push_back(each.take_run());
    all.truth = frames.truth();
    if (all.truth)
        all.best_constant = error_of_best_constant(all.truth->a, all.truth->b, frames.rays().hit);
    return all;
}

} // namespace ao::tools
