#include "ao/result_files.hpp"
#include "ao/result_text.hpp"
#include "scene/metrics.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace ao::tools {
namespace {

using host::scene_picture;

report_error to_report(const picture_error& e)
{
    return { e.rmse, e.bias, e.p99 };
}

std::string plural(std::size_t n, const char* one, const char* many)
{
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string gbuffer_text(const render_result& r)
{
    if (r.options.rays)
        return "by rays, the same for all";
    std::string text = "drawn by each backend; shaders in use: " + std::to_string(r.variants.size());
    for (std::size_t i = 0; i < r.variants.size(); ++i)
        text += (i == 0 ? " (" : "; ") + variant_text(r.variants[i]);
    return text + (r.variants.empty() ? "" : ")");
}

void add_shading(report_data& data, const render_result& r)
{
    std::string missing;
    for (const std::string& name : r.missing_textures)
        missing += (missing.empty() ? "" : ", ") + name;
    if (!missing.empty())
        data.facts.push_back({ "missing textures", missing });
    if (!r.shading)
        return;
    std::string plan = explain(*r.shading);
    plan.erase(plan.find_last_not_of('\n') + 1);
    data.facts.push_back({ "shading", plan });
    data.facts.push_back({ "light", "--lights " + r.options.lights +
                                        (r.options.blend.empty() ? "" : ", --blend " + r.options.blend) +
                                        "; pictures at exposure 1, above 1 is white, sRGB; plain: without ambient occlusion" });
}

// Floats that belong to the pixels of a mask.
std::vector<float> masked(const std::vector<float>& values, const std::vector<std::uint8_t>& mask)
{
    std::vector<float> kept;
    for (std::size_t i = 0; i < mask.size(); ++i)
        if (mask[i] != 0)
            kept.push_back(values[i]);
    return kept;
}

void add_bent_pair(report_data& data, const run_outcome& one, const run_outcome& other)
{
    const std::size_t pixels = one.visibility.size();
    std::size_t differing = 0;
    double largest = 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const agreement directions =
            agreement_of(std::span(one.bent_normal).subspan(3 * pixel, 3), std::span(other.bent_normal).subspan(3 * pixel, 3));
        differing += directions.differing != 0 ? 1u : 0u;
        largest = std::max(largest, directions.largest);
    }
    data.agreements.push_back({ "bent normal", one.label, other.label, pixels, differing, largest });
}

void add_pair(report_data& data, const render_result& r, std::size_t i, std::size_t k)
{
    const scene_outcome& one = r.outcomes.scenes[i];
    const scene_outcome& other = r.outcomes.scenes[k];
    if (!r.options.rays) {
        const ao::picture& a = one.drawn[scene_picture::ids];
        const ao::picture& b = other.drawn[scene_picture::ids];
        std::vector<std::uint8_t> same(a.pixels());
        for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel)
            same[pixel] = a.texel<glm::uvec2>(pixel) == b.texel<glm::uvec2>(pixel) ? 1 : 0;
        const auto differing = static_cast<std::size_t>(std::count(same.begin(), same.end(), 0));
        data.agreements.push_back({ "object and material", one.label, other.label, a.pixels(), differing, {} });
        const agreement depth = agreement_of(masked(r.surfaces[i].depth, same), masked(r.surfaces[k].depth, same));
        data.agreements.push_back(
            { "depth where both see one object", one.label, other.label, depth.pixels, depth.differing, depth.largest });
    }
    if (r.shading) {
        const std::size_t pixels = one.color.pixels();
        std::size_t differing = 0;
        double largest = 0;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            const auto a = one.color.texel<std::array<float, 4>>(pixel);
            const auto b = other.color.texel<std::array<float, 4>>(pixel);
            const agreement colors = agreement_of(a, b);
            differing += colors.differing != 0 ? 1u : 0u;
            largest = std::max(largest, colors.largest);
        }
        data.agreements.push_back({ "shaded color", one.label, other.label, pixels, differing, largest });
    }
}

void add_scenes(report_data& data, const render_result& r)
{
    for (const scene_outcome& s : r.outcomes.scenes) {
        report_scene row{ s.backend, s.device, s.route, {}, "", {}, "" };
        if (!r.options.rays) {
            row.draw_ms = s.draw_ms;
            row.draws = plural(s.counts.draws, "object", "objects") + ", " + plural(s.counts.variants, "variant", "variants");
            if (s.counts.calls > 0)
                row.draws +=
                    ", " + plural(s.counts.programs, "program", "programs") + ", " + plural(s.counts.calls, "call", "calls");
        }
        if (r.shading) {
            row.shade_ms = s.shade_ms;
            row.shading = plural(r.shading->passes.size(), "pass", "passes") + ", " +
                          plural(static_cast<std::size_t>(r.shading->targets), "target", "targets") +
                          (s.clamped > 0 ? ", " + plural(s.clamped, "weight", "weights") + " clamped" : "");
        }
        data.scenes.push_back(row);
    }
    for (std::size_t i = 0; i < r.outcomes.scenes.size(); ++i)
        for (std::size_t k = i + 1; k < r.outcomes.scenes.size(); ++k)
            add_pair(data, r, i, k);
}

} // namespace

std::vector<std::uint8_t> compared_pixels(const render_result& r, const run_outcome& run)
{
    std::vector<std::uint8_t> both = r.rays->hit;
    const std::vector<std::uint8_t>& seen = r.surfaces[run.scene].hit;
    for (std::size_t i = 0; i < both.size(); ++i)
        both[i] = both[i] != 0 && seen[i] != 0 ? 1 : 0;
    return both;
}

report_data tables_of(const render_result& r)
{
    const render_options& o = r.options;
    const tools::camera& c = r.camera;
    report_data data;
    data.title = "ao render " + o.scene;
    const std::vector<std::uint8_t>& hit = r.surfaces.front().hit;
    const auto seen = static_cast<std::size_t>(std::count(hit.begin(), hit.end(), 1));
    data.facts = {
        { "scene", o.scene + ", " + std::to_string(r.triangles) + " triangles" +
                       (r.degenerate > 0 ? ", " + std::to_string(r.degenerate) + " of them without area left out" : "") },
        { "size", size_text(o.size) + ", " + std::to_string(seen) + " pixels of surface" },
        { "camera", "eye " + text(c.eye.x) + ", " + text(c.eye.y) + ", " + text(c.eye.z) + "; yaw " + text(c.yaw) + "°, pitch " +
                        text(c.pitch) + "°, vertical field of view " + text(c.fov) + "°" },
        { "projection", projection_text(o.projection) + "; near " + text(r.frustum.near) + ", far " + text(r.frustum.far) },
        { "settings", std::string(method_text(o.settings.method)) + ", " + std::to_string(o.settings.taps) + " taps, radius " +
                          text(o.settings.radius) + ", bias " + text(o.settings.bias) + ", thickness " +
                          text(o.settings.thickness) + ", filter " + std::to_string(o.settings.filter) + ", seed " +
                          std::to_string(o.settings.seed) },
        { "G-buffer", gbuffer_text(r) },
        { "inputs", std::string("depth ") + depth_text(o.inputs) + ", normals " + normals_text(o.inputs) },
        { "times",
          "medians of " + std::to_string(o.frames) + " frames after warm-up; the first frame's covers preparing the passes" },
    };
    if (r.truth)
        data.facts.push_back({ "truth", std::to_string(o.reference) +
                                            " rays per pixel; errors over pixels of surface, against two "
                                            "independent halves (RMSE and bias without the truth's own noise)" });
    data.facts.push_back(
        { "pictures", r.truth ? "visibility, white is open; differences from the reference: red too bright, blue too dark, full "
                                "colour at 0.5; between backends: white where any bit differs"
                              : "visibility, white is open; differences between backends: white where any bit differs" });
    add_shading(data, r);
    for (const run_outcome& run : r.outcomes.runs) {
        report_run row{ run.backend, run.device, run.route, {}, run.total_ms, run.first_frame_ms, {} };
        for (const timed_pass& p : run.passes)
            row.passes.push_back({ p.name, p.ms });
        if (r.truth)
            row.error = to_report(error_against(run.visibility, r.truth->a, r.truth->b, compared_pixels(r, run)));
        data.runs.push_back(row);
    }
    if (r.truth)
        data.best_constant = to_report(error_of_best_constant(r.truth->a, r.truth->b, r.rays->hit));
    for (std::size_t i = 0; i < r.outcomes.runs.size(); ++i)
        for (std::size_t k = i + 1; k < r.outcomes.runs.size(); ++k) {
            const agreement a = agreement_of(r.outcomes.runs[i].visibility, r.outcomes.runs[k].visibility);
            data.agreements.push_back(
                { "visibility", r.outcomes.runs[i].label, r.outcomes.runs[k].label, a.pixels, a.differing, a.largest });
            if (o.settings.bent_normal)
                add_bent_pair(data, r.outcomes.runs[i], r.outcomes.runs[k]);
        }
    add_scenes(data, r);
    // All pairs of one kind together, kinds in the order in which they came.
    std::vector<std::string> kinds;
    for (const report_agreement& a : data.agreements)
        if (std::find(kinds.begin(), kinds.end(), a.what) == kinds.end())
            kinds.push_back(a.what);
    const auto rank = [&](const report_agreement& a) { return std::find(kinds.begin(), kinds.end(), a.what); };
    std::stable_sort(data.agreements.begin(), data.agreements.end(),
                     [&](const report_agreement& a, const report_agreement& b) { return rank(a) < rank(b); });
    return data;
}

} // namespace ao::tools
