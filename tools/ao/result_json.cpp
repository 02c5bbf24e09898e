#include "ao/result_files.hpp"
#include "ao/result_text.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ao::tools {
namespace {

using json = nlohmann::ordered_json;

json number_or_null(double value)
{
    return std::isfinite(value) ? json(value) : json(nullptr);
}

json agreement_of(const report_agreement& a)
{
    return { { "a", a.a },
             { "b", a.b },
             { "pixels", a.pixels },
             { "differing", a.differing },
             { "max", a.largest ? number_or_null(*a.largest) : json(nullptr) } };
}

json plan_of(const ao::shade_plan& p)
{
    json j = { { "explain", explain(p) },
               { "passes", p.passes.size() },
               { "targets", p.targets },
               { "target_bytes", p.target_bytes() },
               { "table_bytes", p.words.size() * 4 },
               { "blends", json::array() } };
    for (const ao::blend_program& b : p.blends)
        j["blends"].push_back({ { "blend", b.root },
                                { "leaves", b.leaves },
                                { "mixes", b.mixes },
                                { "fused", b.fused() },
                                { "passes", b.passes() },
                                { "targets", b.pictures },
                                { "registers", b.registers },
                                { "paper_passes", b.paper_passes() },
                                { "paper_targets", b.label } });
    return j;
}

void add_scenes(json& j, const render_result& r, const report_data& data)
{
    j["variants"] = json::array();
    for (const ao::draw_variant& v : r.variants)
        j["variants"].push_back(variant_text(v));
    j["scenes"] = json::array();
    for (const scene_outcome& s : r.outcomes.scenes) {
        json row = { { "backend", s.backend }, { "device", s.device }, { "route", s.route } };
        if (!r.options.rays) {
            row["draw_ms"] = s.draw_ms;
            row["first_draw_ms"] = s.first_draw_ms;
            row["objects"] = s.counts.draws;
            row["variants"] = s.counts.variants;
            row["programs"] = s.counts.programs;
            row["draw_calls"] = s.counts.calls;
            row["skipped_triangles"] = s.counts.skipped_triangles;
        }
        if (r.shading) {
            row["shade_ms"] = s.shade_ms;
            row["first_shade_ms"] = s.first_shade_ms;
            row["clamped_weights"] = s.clamped;
        }
        j["scenes"].push_back(row);
    }
    j["gbuffer_agreement"] = json::array();
    j["shaded_agreement"] = json::array();
    for (const report_agreement& a : data.agreements) {
        json row = agreement_of(a);
        row["of"] = a.what;
        if (a.what == "shaded color")
            j["shaded_agreement"].push_back(row);
        else if (a.what != "visibility")
            j["gbuffer_agreement"].push_back(row);
    }
    if (r.shading) {
        j["shading"] = plan_of(*r.shading);
        j["shading"]["lights"] = r.options.lights;
        j["shading"]["blend"] = r.options.blend.empty() ? json(nullptr) : json(r.options.blend);
    }
}

} // namespace

std::string json_of(const render_result& r)
{
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
    j["settings"] = { { "method", method_text(o.settings.method) },
                      { "taps", o.settings.taps },
                      { "slices", o.settings.slices },
                      { "resolution", o.settings.resolution == resolution::half ? "half" : "full" },
                      { "radius", o.settings.radius },
                      { "bias", o.settings.bias },
                      { "thickness", number_or_null(static_cast<double>(o.settings.thickness)) },
                      { "filter", o.settings.filter },
                      { "seed", o.settings.seed },
                      { "depth", depth_text(o.inputs) },
                      { "normals", normals_text(o.inputs) },
                      { "gbuffer", o.rays ? "rays" : "raster" },
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
    // Visibility under the name that it always had.
    j["agreement"] = json::array();
    for (const report_agreement& a : data.agreements)
        if (a.what == "visibility")
            j["agreement"].push_back(agreement_of(a));
    if (!data.scenes.empty())
        add_scenes(j, r, data);
    j["missing_textures"] = r.missing_textures;
    j["warnings"] = r.warnings;
    // File names need not be UTF-8.
    return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

} // namespace ao::tools
