#include "ao/result_text.hpp"
#include "ao/temporal_render.hpp"

#include <algorithm>
#include <cstdio>

namespace ao::tools {
namespace {

std::string text(const char* format, double value)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

std::string or_dash(const char* format, const std::vector<double>& values)
{
    return values.empty() ? "–" : text(format, mean_of(values));
}

double share(std::size_t count, const frame_facts& of)
{
    return of.surface > 0 ? static_cast<double>(count) / static_cast<double>(of.surface) : 0.0;
}

report_error to_report(const picture_error& e)
{
    return { e.rmse, e.bias, e.p99 };
}

// Of the frames after the first, unless there is no other.
std::size_t first_counted(const temporal_run& run)
{
    return run.frames.size() > 1 ? 1 : 0;
}

// Medians over the frames in which a pass ran.
report_run times_of(const temporal_run& run)
{
    report_run row{ run.backend, run.device, run.route, {}, 0.0, run.first_frame_ms, {} };
    std::vector<std::pair<std::string, std::vector<double>>> passes;
    std::vector<double> totals;
    for (std::size_t f = first_counted(run); f < run.frames.size(); ++f) {
        totals.push_back(run.frames[f].total_ms);
        for (const timed_pass& p : run.frames[f].passes) {
            auto known = std::find_if(passes.begin(), passes.end(), [&](const auto& each) { return each.first == p.name; });
            if (known == passes.end())
                known = passes.insert(passes.end(), { p.name, {} });
            known->second.push_back(p.ms);
        }
    }
    for (const auto& [name, ms] : passes)
        row.passes.push_back({ name, median(ms) });
    row.total_ms = median(totals);
    if (const auto& error = run.frames.back().error)
        row.error = to_report(*error);
    return row;
}

std::vector<std::string> summary_of(const temporal_run& run, const std::vector<std::uint8_t>& cuts)
{
    std::vector<double> samples, invalidated, flicker, flicker_p99, rmse, bias;
    for (std::size_t f = 0; f < run.frames.size(); ++f) {
        const frame_facts& facts = run.frames[f].facts;
        samples.push_back(facts.surface > 0 ? static_cast<double>(facts.samples) / static_cast<double>(facts.surface) : 0.0);
        if (f > 0 && cuts[f] == 0)
            invalidated.push_back(share(facts.dropped + facts.cut, facts));
        if (facts.flicker) {
            flicker.push_back(*facts.flicker);
            flicker_p99.push_back(*facts.flicker_p99);
        }
        if (const auto& error = run.frames[f].error) {
            rmse.push_back(error->rmse);
            bias.push_back(error->bias);
        }
    }
    const frame_facts& last = run.frames.back().facts;
    return { run.backend,
             or_dash("%.2f", samples),
             text("%.4f", share(last.converged, last)),
             or_dash("%.4f", invalidated),
             or_dash("%.5f", flicker),
             flicker_p99.empty() ? "–" : text("%.4f", *std::max_element(flicker_p99.begin(), flicker_p99.end())),
             or_dash("%.4f", rmse),
             or_dash("%+.4f", bias) };
}

report_table summaries_of(const temporal_result& r)
{
    report_table t{ "Over the frames",
                    { { "backend", "samples a pixel", "converged at the end", "invalidated", "flicker", "worst flicker p99",
                        "mean RMSE", "mean bias" } } };
    for (const temporal_run& run : r.outcomes.runs)
        t.rows.push_back(summary_of(run, r.outcomes.cuts));
    if (r.outcomes.alone.empty())
        return t;
    std::vector<double> rmse, bias;
    for (const picture_error& e : r.outcomes.alone) {
        rmse.push_back(e.rmse);
        bias.push_back(e.bias);
    }
    const std::string taps = std::to_string(r.options.temporal->settings.later_samples);
    t.rows.push_back({ "one frame alone", taps, "–", "–", "–", "–", or_dash("%.4f", rmse), or_dash("%+.4f", bias) });
    return t;
}

template <class Value>
report_chart chart_of(const temporal_result& r, const std::string& title, Value value)
{
    report_chart chart{ title, {}, {} };
    for (const temporal_run& run : r.outcomes.runs) {
        chart_line& line = chart.lines.emplace_back();
        line.name = run.backend;
        for (const temporal_frame_outcome& f : run.frames)
            line.values.push_back(value(f));
    }
    for (std::size_t f = 0; f < r.outcomes.cuts.size(); ++f)
        if (r.outcomes.cuts[f] != 0)
            chart.marks.push_back(f);
    return chart;
}

void add_charts(report_data& data, const temporal_result& r)
{
    using number = std::optional<double>;
    using outcome = temporal_frame_outcome;
    if (r.outcomes.truth) {
        data.charts.push_back(chart_of(r, "RMSE against the truth of the frame",
                                       [](const outcome& f) { return f.error ? number(f.error->rmse) : number(); }));
        if (!r.outcomes.alone.empty()) {
            chart_line& line = data.charts.back().lines.emplace_back();
            line.name = "one frame alone, " + std::to_string(r.options.temporal->settings.later_samples) + " taps";
            for (const picture_error& e : r.outcomes.alone)
                line.values.push_back(e.rmse);
        }
    }
    data.charts.push_back(chart_of(r, "share of surface invalidated",
                                   [](const outcome& f) { return number(share(f.facts.dropped + f.facts.cut, f.facts)); }));
    // All of it where there is no history: that would hide the rest.
    for (chart_line& line : data.charts.back().lines)
        for (std::size_t f = 0; f < line.values.size(); ++f)
            line.values[f] = f == 0 || r.outcomes.cuts[f] != 0 ? number() : line.values[f];
    data.charts.push_back(
        chart_of(r, "share of surface converged", [](const outcome& f) { return number(share(f.facts.converged, f.facts)); }));
    data.charts.push_back(chart_of(r, "flicker, mean", [](const outcome& f) { return f.facts.flicker; }));
    data.charts.push_back(chart_of(r, "ms, all passes", [](const outcome& f) { return number(f.total_ms); }));
}

void add_agreements(report_data& data, const temporal_result& r)
{
    const std::vector<temporal_run>& runs = r.outcomes.runs;
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (std::size_t k = i + 1; k < runs.size(); ++k) {
            const agreement a = agreement_of(runs[i].visibility, runs[k].visibility);
            data.agreements.push_back({ "visibility", runs[i].label, runs[k].label, a.pixels, a.differing, a.largest });
        }
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (std::size_t k = i + 1; k < runs.size(); ++k) {
            const std::vector<std::uint32_t>&one = runs[i].history, &other = runs[k].history;
            const std::size_t pixels = runs[i].visibility.size(), words = one.size() / pixels;
            std::size_t differing = 0;
            for (std::size_t p = 0; p < pixels; ++p) {
                const auto at = static_cast<std::ptrdiff_t>(p * words), end = static_cast<std::ptrdiff_t>((p + 1) * words);
                differing += std::equal(one.begin() + at, one.begin() + end, other.begin() + at) ? 0u : 1u;
            }
            data.agreements.push_back({ "history", runs[i].label, runs[k].label, pixels, differing, {} });
        }
}

} // namespace

report_data tables_of(const temporal_result& r)
{
    const render_options& o = r.options;
    const ao::temporal_settings& s = o.temporal->settings;
    const tools::camera& c = r.camera;
    using tools::text;
    report_data data;
    data.title = "ao render " + o.scene + " --temporal";
    const auto cuts = std::count(r.outcomes.cuts.begin(), r.outcomes.cuts.end(), 1);
    data.facts = {
        { "scene", o.scene + ", " + std::to_string(r.triangles) + " triangles" +
                       (r.degenerate > 0 ? ", " + std::to_string(r.degenerate) + " of them without area left out" : "") },
        { "size", size_text(o.size) },
        { "frames", std::to_string(o.frames) + ", motion " + o.temporal->motion +
                        (r.objects_move ? ", objects move" : ", no object moves") +
                        (cuts > 0 ? ", cuts: " + std::to_string(cuts) : "") },
        { "first camera", "eye " + text(c.eye.x) + ", " + text(c.eye.y) + ", " + text(c.eye.z) + "; yaw " + text(c.yaw) +
                              "°, pitch " + text(c.pitch) + "°, vertical field of view " + text(c.fov) + "°" },
        { "projection", projection_text(o.projection) + "; near " + text(r.frustum.near) + ", far " + text(r.frustum.far) },
        { "settings", std::string(contribution_text(s.contribution)) + ", samples " + std::to_string(s.first_samples) + " and " +
                          std::to_string(s.later_samples) + ", weight at most " + std::to_string(s.most_weight) + ", history " +
                          history_text(s.format) + ", invalidation " + invalidation_text(s.invalidation) + ", smoothness " +
                          text(s.smoothness) + ", radius " + text(s.radius) + ", bias " + text(s.bias) + ", thickness " +
                          text(s.thickness) + ", filter " + std::to_string(s.filter) + ", seed " + std::to_string(s.seed) },
        { "G-buffer", o.rays ? "by rays, the same for all" : "drawn by each backend" },
        { "inputs", std::string("depth ") + depth_text(o.inputs) + ", normals " + normals_text(o.inputs) },
        { "times", "medians over the frames after the first in which a pass ran; the first frame's covers preparing" },
        { "invalidated", "pixels of surface that began anew or weigh less than what was known of them and the new samples; of "
                         "frames that are neither the first nor after a cut" },
        { "flicker", "mean of |v - v of the frame before, where the surface was|, over the other pixels of surface" },
    };
    if (r.outcomes.truth)
        data.facts.push_back({ "truth", std::to_string(o.reference) +
                                            " rays per pixel in every frame; errors over pixels of surface, against two "
                                            "independent halves (RMSE and bias without the truth's own noise); the runs' of the "
                                            "last frame" });
    std::string missing;
    for (const std::string& name : r.missing_textures)
        missing += (missing.empty() ? "" : ", ") + name;
    if (!missing.empty())
        data.facts.push_back({ "missing textures", missing });
    for (const temporal_run& run : r.outcomes.runs)
        data.runs.push_back(times_of(run));
    if (r.outcomes.best_constant)
        data.best_constant = to_report(*r.outcomes.best_constant);
    data.tables.push_back(summaries_of(r));
    add_charts(data, r);
    add_agreements(data, r);
    return data;
}

} // namespace ao::tools
