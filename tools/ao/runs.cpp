#include "ao/runs.hpp"

#include "host/runner.hpp"
#include "scene/error.hpp"
#include "scene/signals.hpp"

#include <algorithm>
#include <cstring>

namespace ao::tools {
namespace {

// The value, or `error` with where it was missing and why.
template <class T>
T take(const std::string& where, ao::result<T> result)
{
    if (!result)
        throw error(where + ": " + one_line(std::string(result.error().reason())));
    return std::move(*result);
}

void stop_if_interrupted()
{
    if (interrupted())
        throw error("interrupted");
}

const char* name_of(pass_type type)
{
    switch (type) {
    case pass_type::linearize:
        return "linearize";
    case pass_type::occlusion:
        return "occlusion";
    case pass_type::filter_rows:
        return "filter rows";
    case pass_type::filter_columns:
        return "filter columns";
    }
    return "unknown";
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

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
                out.passes.push_back({ name_of(p.pass), 0.0 });
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

run_outcome run(host::runner& r, const std::string& label, const run_inputs& in)
{
    run_outcome out;
    out.label = label;
    out.backend = r.backend();
    out.device = r.device();
    out.route = r.route();
    (void)take(out.backend, r.prepare(in.settings, in.facts, in.camera));
    (void)take(out.backend, r.upload(in.depth, in.normal));
    time_frames(out, r, in.frames);
    const picture visibility = take(out.backend, r.download());
    out.visibility.resize(visibility.pixels());
    std::memcpy(out.visibility.data(), visibility.bytes.data(), visibility.bytes.size());
    return out;
}

} // namespace

std::vector<run_outcome> run_all(const render_options& o, const run_inputs& in)
{
    std::vector<run_outcome> runs;
    // Each with its device gone before the next begins: none shares the machine with another.
    const auto add = [&](const std::string& backend, const std::string& route, const std::string& label) {
        for (const host::runner_ptr& r : take(backend, host::make_runners(backend, o.device, route)))
            runs.push_back(run(*r, label, in));
    };
    if (o.cpu)
        add("cpu", o.lanes == 0 ? "" : o.lanes == 1 ? "scalar" : "lanes" + std::to_string(o.lanes), "cpu");
    if (o.gl && o.gl_compute)
        add("gl", "compute", "gl");
    if (o.gl && o.gl_fragment)
        add("gl", "fragment", "gl-fragment");
    if (o.vk)
        add("vk", "", "vk");
    return runs;
}

} // namespace ao::tools
