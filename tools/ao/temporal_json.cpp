#include "ao/result_text.hpp"
#include "ao/temporal_render.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ao::tools {
namespace {

using json = nlohmann::ordered_json;

json number_or_null(double value)
{
    return std::isfinite(value) ? json(value) : json(nullptr);
}

json or_null(const std::optional<double>& value)
{
    return value ? json(*value) : json(nullptr);
}

json share(std::size_t count, const frame_facts& of)
{
    return of.surface > 0 ? json(static_cast<double>(count) / static_cast<double>(of.surface)) : json(nullptr);
}

json frame_of(const std::string& backend, const temporal_frame_outcome& f)
{
    json j = { { "backend", backend }, { "passes", json::array() }, { "total_ms", f.total_ms } };
    for (const timed_pass& p : f.passes)
        j["passes"].push_back({ { "name", p.name }, { "ms", p.ms } });
    if (f.draw_ms)
        j["draw_ms"] = *f.draw_ms;
    const frame_facts& facts = f.facts;
    j["surface_pixels"] = facts.surface;
    j["samples"] = facts.samples;
    j["share_converged"] = share(facts.converged, facts);
    j["share_invalidated"] = share(facts.dropped + facts.cut, facts);
    j["share_dropped"] = share(facts.dropped, facts);
    j["share_cut"] = share(facts.cut, facts);
    j["flicker"] = or_null(facts.flicker);
    j["flicker_p99"] = or_null(facts.flicker_p99);
    j["rmse"] = f.error ? json(f.error->rmse) : json(nullptr);
    j["bias"] = f.error ? json(f.error->bias) : json(nullptr);
    j["p99"] = f.error ? json(f.error->p99) : json(nullptr);
    return j;
}

json settings_of(const temporal_result& r)
{
    const render_options& o = r.options;
    const ao::temporal_settings& s = o.temporal->settings;
    return { { "contribution", contribution_text(s.contribution) },
             { "density", density_text(s.density) },
             { "samples", { s.first_samples, s.later_samples } },
             { "period", s.period },
             { "most_weight", s.most_weight },
             { "moving_weight", s.moving_weight },
             { "history", history_text(s.format) },
             { "invalidation", invalidation_text(s.invalidation) },
             { "smoothness", s.smoothness },
             { "radius", s.radius },
             { "bias", s.bias },
             { "thickness", number_or_null(static_cast<double>(s.thickness)) },
             { "filter", s.filter },
             { "seed", s.seed },
             { "depth", depth_text(o.inputs) },
             { "normals", normals_text(o.inputs) },
             { "gbuffer", o.rays ? "rays" : "raster" },
             { "reference", o.reference },
             { "frames", o.frames },
             { "motion", o.temporal->motion },
             { "objects_move", r.objects_move } };
}

} // namespace

std::string json_of(const temporal_result& r)
{
    const render_options& o = r.options;
    const tools::camera& c = r.camera;
    const report_data data = tables_of(r);
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
    j["settings"] = settings_of(r);
    j["runs"] = json::array();
    for (const temporal_run& run : r.outcomes.runs)
        j["runs"].push_back({ { "backend", run.backend },
                              { "device", run.device },
                              { "route", run.route },
                              { "first_frame_ms", run.first_frame_ms } });
    j["frames"] = json::array();
    for (std::size_t f = 0; f < r.outcomes.cuts.size(); ++f) {
        json frame = { { "frame", f }, { "cut", r.outcomes.cuts[f] != 0 }, { "backends", json::array() } };
        for (const temporal_run& run : r.outcomes.runs)
            frame["backends"].push_back(frame_of(run.backend, run.frames[f]));
        const bool alone = f < r.outcomes.alone.size();
        frame["alone_rmse"] = alone ? json(r.outcomes.alone[f].rmse) : json(nullptr);
        frame["alone_bias"] = alone ? json(r.outcomes.alone[f].bias) : json(nullptr);
        j["frames"].push_back(frame);
    }
    j["best_constant_rmse"] = data.best_constant ? json(data.best_constant->rmse) : json(nullptr);
    j["agreement"] = json::array();
    j["history_agreement"] = json::array();
    for (const report_agreement& a : data.agreements) {
        json row = { { "a", a.a }, { "b", a.b }, { "pixels", a.pixels }, { "differing", a.differing } };
        if (a.largest)
            row["max"] = number_or_null(*a.largest);
        j[a.what == "visibility" ? "agreement" : "history_agreement"].push_back(row);
    }
    j["missing_textures"] = r.missing_textures;
    j["warnings"] = r.warnings;
    // File names need not be UTF-8.
    return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

} // namespace ao::tools
