#include "ao/result_files.hpp"

#include "scene/error.hpp"
#include "scene/files.hpp"
#include "scene/metrics.hpp"
#include "scene/signals.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace ao::tools {
namespace {

std::string text(double value)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string text(float value)
{
    return text(static_cast<double>(value));
}

std::string size_text(extent size)
{
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

const char* kernel_text(kernel_type k)
{
    return k == kernel_type::box ? "box" : k == kernel_type::hemisphere ? "hemisphere" : "halton";
}

const char* depth_text(const facts& f)
{
    switch (f.depth_format) {
    case pixel_format::d32f:
        return "d32f";
    case pixel_format::d24:
        return "d24";
    case pixel_format::rgba16f:
        return "position16";
    case pixel_format::rgba32f:
        return "position32";
    default:
        return "linear";
    }
}

const char* normals_text(const facts& f)
{
    switch (f.normals) {
    case normal_source::vector:
        return "rgba16f";
    case normal_source::unorm10:
        return "rgb10a2";
    case normal_source::octahedral:
        return "octahedral";
    case normal_source::from_depth:
        return "none";
    }
    return "none";
}

std::string projection_text(const projection_choice& p)
{
    std::string words = p.options.parallel ? "parallel" : "perspective";
    words += p.options.range == ao::depth_range::zero_to_one ? ",zero-to-one" : ",minus-one-to-one";
    words += p.options.reversed ? ",reversed" : "";
    words += p.infinite ? ",infinite" : "";
    words += p.options.y_down ? ",y-down" : "";
    return words;
}

report_error to_report(const picture_error& e)
{
    return { e.rmse, e.bias, e.p99 };
}

nlohmann::ordered_json number_or_null(double value)
{
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

// Red: too bright, blue: too dark, white: right; full colour at a difference of 0.5.
std::vector<std::uint8_t> difference_picture(const std::vector<float>& x, const std::vector<float>& reference)
{
    std::vector<float> rgb;
    rgb.reserve(3 * x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const float d = 2.0f * (x[i] - reference[i]);
        rgb.insert(rgb.end(), { 1.0f - std::max(-d, 0.0f), 1.0f - std::abs(d), 1.0f - std::max(d, 0.0f) });
    }
    return to_bytes(rgb);
}

// White where any bit differs.
std::vector<std::uint8_t> disagreement_picture(const std::vector<float>& x, const std::vector<float>& y)
{
    std::vector<std::uint8_t> gray;
    gray.reserve(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        gray.push_back(std::bit_cast<std::uint32_t>(x[i]) == std::bit_cast<std::uint32_t>(y[i]) ? 0 : 255);
    return gray;
}

// Near is bright.
std::vector<std::uint8_t> depth_picture(const gbuffer& g)
{
    const float far = *std::max_element(g.depth.begin(), g.depth.end());
    std::vector<float> gray;
    gray.reserve(g.size());
    for (const float d : g.depth)
        gray.push_back(d > 0.0f ? 1.0f - 0.9f * std::sqrt(d / far) : 0.0f);
    return to_bytes(gray);
}

std::vector<std::uint8_t> normal_picture(const gbuffer& g)
{
    std::vector<float> rgb;
    rgb.reserve(3 * g.size());
    for (std::size_t i = 0; i < g.size(); ++i)
        for (int c = 0; c < 3; ++c)
            rgb.push_back(g.hit[i] != 0 ? 0.5f + 0.5f * g.normal[i][c] : 0.0f);
    return to_bytes(rgb);
}

} // namespace

report_data tables_of(const render_result& r)
{
    const render_options& o = r.options;
    const tools::camera& c = r.camera;
    report_data data;
    data.title = "ao render " + o.scene;
    const auto seen = static_cast<std::size_t>(std::count(r.g.hit.begin(), r.g.hit.end(), 1));
    data.facts = {
        { "scene", o.scene + ", " + std::to_string(r.triangles) + " triangles" +
                       (r.degenerate > 0 ? ", " + std::to_string(r.degenerate) + " of them without area left out" : "") },
        { "size", size_text(o.size) + ", " + std::to_string(seen) + " pixels of surface" },
        { "camera", "eye " + text(c.eye.x) + ", " + text(c.eye.y) + ", " + text(c.eye.z) + "; yaw " + text(c.yaw) + "°, pitch " +
                        text(c.pitch) + "°, vertical field of view " + text(c.fov) + "°" },
        { "projection", projection_text(o.projection) + "; near " + text(r.frustum.near) + ", far " + text(r.frustum.far) },
        { "settings", std::string(kernel_text(o.settings.kernel)) + ", " + std::to_string(o.settings.taps) + " taps, radius " +
                          text(o.settings.radius) + ", bias " + text(o.settings.bias) + ", thickness " +
                          text(o.settings.thickness) + ", filter " + std::to_string(o.settings.filter) + ", seed " +
                          std::to_string(o.settings.seed) },
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
    for (const run_outcome& run : r.runs) {
        report_run row{ run.backend, run.device, run.route, {}, run.total_ms, run.first_frame_ms, {} };
        for (const timed_pass& p : run.passes)
            row.passes.push_back({ p.name, p.ms });
        if (r.truth)
            row.error = to_report(error_against(run.visibility, r.truth->a, r.truth->b, r.g.hit));
        data.runs.push_back(row);
    }
    if (r.truth)
        data.best_constant = to_report(error_of_best_constant(r.truth->a, r.truth->b, r.g.hit));
    for (std::size_t i = 0; i < r.runs.size(); ++i)
        for (std::size_t k = i + 1; k < r.runs.size(); ++k) {
            const agreement a = agreement_of(r.runs[i].visibility, r.runs[k].visibility);
            data.agreements.push_back({ r.runs[i].label, r.runs[k].label, a.pixels, a.differing, a.largest });
        }
    return data;
}

std::string json_of(const render_result& r)
{
    using json = nlohmann::ordered_json;
    const report_data data = tables_of(r);
    const render_options& o = r.options;
    const tools::camera& c = r.camera;
    json j;
    j["scene"] = o.scene;
    j["triangles"] = r.triangles;
    j["degenerate"] = r.degenerate;
    j["size"] = { o.size.width, o.size.height };
    j["camera"] = { { "eye", { c.eye.x, c.eye.y, c.eye.z } },
                    { "yaw", c.yaw },
                    { "pitch", c.pitch },
                    { "fov", c.fov },
                    { "near", r.frustum.near },
                    { "far", number_or_null(static_cast<double>(r.frustum.far)) },
                    { "projection", projection_text(o.projection) } };
    j["settings"] = { { "kernel", kernel_text(o.settings.kernel) },
                      { "taps", o.settings.taps },
                      { "radius", o.settings.radius },
                      { "bias", o.settings.bias },
                      { "thickness", number_or_null(static_cast<double>(o.settings.thickness)) },
                      { "filter", o.settings.filter },
                      { "seed", o.settings.seed },
                      { "depth", depth_text(o.inputs) },
                      { "normals", normals_text(o.inputs) },
                      { "reference", o.reference },
                      { "frames", o.frames } };
    j["runs"] = json::array();
    for (const report_run& run : data.runs) {
        json row = { { "backend", run.backend },  { "device", run.device },     { "route", run.route },
                     { "passes", json::array() }, { "total_ms", run.total_ms }, { "first_frame_ms", run.first_frame_ms } };
        for (const report_pass& p : run.passes)
            row["passes"].push_back({ { "name", p.name }, { "ms", p.ms } });
        row["rmse"] = run.error ? json(run.error->rmse) : json(nullptr);
        row["bias"] = run.error ? json(run.error->bias) : json(nullptr);
        row["p99"] = run.error ? json(run.error->p99) : json(nullptr);
        j["runs"].push_back(row);
    }
    j["best_constant_rmse"] = data.best_constant ? json(data.best_constant->rmse) : json(nullptr);
    j["agreement"] = json::array();
    for (const report_agreement& a : data.agreements)
        j["agreement"].push_back({ { "a", a.a },
                                   { "b", a.b },
                                   { "pixels", a.pixels },
                                   { "differing", a.differing },
                                   { "max", number_or_null(a.largest) } });
    // File names need not be UTF-8.
    return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

void write_pictures(const render_result& r, report_data data)
{
    const render_options& o = r.options;
    const auto write = [&](const std::string& name, const std::string& bytes) {
        if (interrupted())
            throw error("interrupted");
        write_file(o.out / name, bytes);
    };
    const auto show = [&](const std::string& name, int channels, const std::vector<std::uint8_t>& pixels, bool file) {
        data.pictures.push_back({ name, encode_png(o.size, channels, pixels) });
        if (file)
            write(name + ".png", data.pictures.back().png);
    };

    std::vector<float> view_z;
    view_z.reserve(r.g.size());
    for (const glm::vec3& p : r.g.position)
        view_z.push_back(p.z);
    write("depth.exr", encode_exr(o.size, view_z));
    write("normal.exr", encode_exr(o.size, r.g.normal, "XYZ"));

    const std::vector<float> truth = r.truth ? mean(*r.truth) : std::vector<float>();
    for (const run_outcome& run : r.runs) {
        show("visibility-" + run.label, 1, to_bytes(run.visibility), true);
        write("visibility-" + run.label + ".exr", encode_exr(o.size, run.visibility));
        if (&run == &r.runs.front() && r.truth) {
            show("reference", 1, to_bytes(truth), true);
            write("reference.exr", encode_exr(o.size, truth));
        }
    }
    for (const run_outcome& run : r.runs)
        if (r.truth)
            show("difference-" + run.label + "-reference", 3, difference_picture(run.visibility, truth), true);
    for (std::size_t i = 0; i < r.runs.size(); ++i)
        for (std::size_t k = i + 1; k < r.runs.size(); ++k)
            show("difference-" + r.runs[i].label + "-" + r.runs[k].label, 1,
                 disagreement_picture(r.runs[i].visibility, r.runs[k].visibility), true);
    show("depth", 1, depth_picture(r.g), false);
    show("normal", 3, normal_picture(r.g), false);
    write("report.html", make_report(data));
}

} // namespace ao::tools
