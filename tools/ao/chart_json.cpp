#include "ao/chart_results.hpp"
#include "ao/result_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace ao::tools {
namespace {

using json = nlohmann::ordered_json;

// Six digits: more are noise, and the file is kept.
json number(double x)
{
    if (!std::isfinite(x))
        return nullptr;
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    return std::strtod(text, nullptr);
}

json median_of(const std::vector<double>& values, double share)
{
    return values.empty() ? json(nullptr) : number(percentile(values, share));
}

json cost_json(const std::optional<pixel_cost>& c)
{
    if (!c)
        return nullptr;
    return { { "passes", c->passes },
             { "fetches", number(c->fetches) },
             { "operations", number(c->operations) },
             { "bytes", number(c->bytes) } };
}

json classes_json(const std::array<paired_error, pixel_class_count>& classes)
{
    json all = json::object();
    for (std::size_t i = 1; i < classes.size(); ++i)
        if (classes[i].pixels > 0)
            all[name_of(static_cast<pixel_class>(i))] = { { "pixels", classes[i].pixels },
                                                          { "rmse", number(classes[i].rmse) },
                                                          { "bias", number(classes[i].bias) } };
    return all;
}

// Of several pictures together.
json pooled(const std::vector<const std::array<paired_error, pixel_class_count>*>& views)
{
    json all = json::object();
    for (std::size_t i = 1; i < pixel_class_count; ++i) {
        double square = 0.0, count = 0.0;
        for (const auto* v : views) {
            const auto n = static_cast<double>((*v)[i].pixels);
            square += n * (*v)[i].rmse * (*v)[i].rmse;
            count += n;
        }
        if (count > 0.0)
            all[name_of(static_cast<pixel_class>(i))] = number(std::sqrt(square / count));
    }
    return all;
}

json error_json(const view_error& e, const std::string& view)
{
    return { { "view", view },
             { "rmse", number(e.truth.rmse) },
             { "bias", number(e.truth.bias) },
             { "systematic", number(e.truth.systematic) },
             { "deviation", number(e.truth.deviation) },
             { "sampling", number(e.sampling.rmse) },
             { "p99", number(e.p99) },
             { "over_tenth", number(e.over_tenth) },
             { "classes", classes_json(e.classes) } };
}

template <class Get>
std::vector<double> each_view(const std::vector<view_error>& errors, Get&& get)
{
    std::vector<double> values;
    for (const view_error& e : errors)
        values.push_back(get(e));
    return values;
}

json summary(const single_result& r, const std::vector<view_facts>& views)
{
    const auto rmse = each_view(r.errors, [](const view_error& e) { return e.truth.rmse; });
    const auto mean = [&](auto get) { return number(mean_of(each_view(r.errors, get))); };
    const auto worst = static_cast<std::size_t>(std::max_element(rmse.begin(), rmse.end()) - rmse.begin());
    std::vector<const std::array<paired_error, pixel_class_count>*> classes;
    for (const view_error& e : r.errors)
        classes.push_back(&e.classes);
    return { { "rmse", number(mean_of(rmse)) },
             { "rmse_low", median_of(rmse, 0.1) },
             { "rmse_high", median_of(rmse, 0.9) },
             { "worst", { { "view", views[worst].place.name }, { "rmse", number(rmse[worst]) } } },
             { "bias", mean([](const view_error& e) { return e.truth.bias; }) },
             { "systematic", mean([](const view_error& e) { return e.truth.systematic; }) },
             { "deviation", mean([](const view_error& e) { return e.truth.deviation; }) },
             { "sampling", mean([](const view_error& e) { return e.sampling.rmse; }) },
             { "p99", mean([](const view_error& e) { return e.p99; }) },
             { "over_tenth", mean([](const view_error& e) { return e.over_tenth; }) },
             { "classes", pooled(classes) } };
}

json times_json(const std::vector<route_time>& times, const std::vector<chart_route>& routes)
{
    json all = json::array();
    for (const route_time& t : times)
        all.push_back({ { "route", routes[t.route].name },
                        { "ms_per_megapixel", median_of(t.ms, 0.5) },
                        { "low", median_of(t.ms, 0.1) },
                        { "high", median_of(t.ms, 0.9) },
                        { "processor_ms_per_megapixel", median_of(t.processor_ms, 0.5) },
                        { "processor_low", median_of(t.processor_ms, 0.1) },
                        { "processor_high", median_of(t.processor_ms, 0.9) },
                        { "samples", t.ms.size() },
                        { "first_frame_ms", number(t.first_frame_ms) },
                        { "pixels", t.same.pixels },
                        { "differing", t.same.differing } });
    return all;
}

json single_json(const single_result& r, const chart_results& all)
{
    const chart_configuration& c = r.configuration;
    json j = { { "name", c.name },
               { "method", c.method },
               { "varies", c.varies },
               { "taps", c.settings.taps },
               { "slices", c.settings.slices },
               { "resolution", c.settings.resolution == resolution::half ? "half" : "full" },
               { "filter", c.settings.filter },
               { "thickness", number(static_cast<double>(c.settings.thickness)) },
               { "bias_setting", number(static_cast<double>(c.settings.bias)) },
               { "depth", depth_text(c.facts) },
               { "normals", normals_text(c.facts) },
               { "output", c.facts.output_format == pixel_format::r8 ? "r8" : "r32f" },
               { "cost", cost_json(r.cost) },
               { "error", summary(r, all.views) },
               { "views", json::array() },
               { "times", times_json(r.times, all.routes) },
               { "flicker", r.flicker.empty() ? json(nullptr) : number(mean_of(r.flicker)) } };
    for (std::size_t i = 0; i < r.errors.size(); ++i)
        j["views"].push_back(error_json(r.errors[i], all.views[i].place.name));
    return j;
}

json routes_json(const std::vector<chart_route>& routes)
{
    json all = json::array();
    for (const chart_route& each : routes)
        all.push_back({ { "name", each.name }, { "device", each.device }, { "how", each.how } });
    return all;
}

json views_json(const std::vector<view_facts>& views)
{
    json all = json::array();
    for (const view_facts& v : views) {
        json classes = json::object();
        for (std::size_t i = 0; i < v.classes.size(); ++i)
            if (v.classes[i] > 0)
                classes[name_of(static_cast<pixel_class>(i))] = v.classes[i];
        all.push_back({ { "name", v.place.name },
                        { "model", std::filesystem::path(v.place.model).filename().string() },
                        { "eye",
                          { number(static_cast<double>(v.camera.eye.x)), number(static_cast<double>(v.camera.eye.y)),
                            number(static_cast<double>(v.camera.eye.z)) } },
                        { "yaw", number(static_cast<double>(v.camera.yaw)) },
                        { "pitch", number(static_cast<double>(v.camera.pitch)) },
                        { "fov", number(static_cast<double>(v.camera.fov)) },
                        { "radius", number(static_cast<double>(v.place.radius)) },
                        { "triangles", v.triangles },
                        { "classes", classes },
                        { "best_constant_rmse", number(v.best_constant) } });
    }
    return all;
}

json temporal_json(const chart_temporal& r, const chart_results& all)
{
    const ao::temporal_settings& s = r.configuration.settings;
    json j = { { "name", r.configuration.name },
               { "method", r.configuration.method },
               { "contribution", contribution_text(s.contribution) },
               { "samples", { s.first_samples, s.later_samples } },
               { "history", history_text(s.format) },
               { "cubic", s.cubic },
               { "cost", { { "still", cost_json(r.still) }, { "moving", cost_json(r.moving) } } },
               { "motions", json::array() },
               { "still_times", times_json(r.still_times, all.temporal_routes) },
               { "moving_times", times_json(r.moving_times, all.temporal_routes) } };
    for (const motion_error& e : r.errors)
        j["motions"].push_back({ { "view", e.view },
                                 { "motion", e.motion },
                                 { "first_frame_rmse", number(e.first) },
                                 { "rmse", number(e.truth.rmse) },
                                 { "bias", number(e.truth.bias) },
                                 { "p99", number(e.truth.p99) },
                                 { "flicker", number(e.flicker) },
                                 { "flicker_p99", number(e.flicker_p99) },
                                 { "classes", classes_json(e.classes) } });
    return j;
}

json vertices_json(const vertex_results& v)
{
    json j = { { "model", v.model },
               { "vertices", v.vertices },
               { "triangles", v.triangles },
               { "truth_directions", v.truth_directions },
               { "points", json::array() } };
    for (const vertex_point& p : v.points) {
        json times = json::array();
        for (const vertex_point::time& t : p.times)
            times.push_back(
                { { "route", t.route }, { "ms", number(t.ms) }, { "low", number(t.low) }, { "high", number(t.high) } });
        j["points"].push_back({ { "rule", p.rule },
                                { "directions", p.directions },
                                { "rmse", number(p.rmse) },
                                { "estimated", number(p.estimated) },
                                { "times", times } });
    }
    return j;
}

void add_line(std::string& to, const char* pattern, const std::string& name, double a, double b, double c, double d,
              const std::string& rest)
{
    char text[160];
    std::snprintf(text, sizeof text, pattern, name.c_str(), a, b, c, d);
    to += text + rest + "\n";
}

std::string times_text(const std::vector<route_time>& times)
{
    std::string all;
    for (const route_time& t : times) {
        char text[32];
        std::snprintf(text, sizeof text, " %12.1f", t.ms.empty() ? 0.0 : percentile(t.ms, 0.5));
        all += text;
    }
    return all;
}

std::string heading(const std::string& name, const char* errors, const std::vector<chart_route>& routes)
{
    char text[160];
    std::snprintf(text, sizeof text, "%-42s %s", name.c_str(), errors);
    std::string line = text;
    for (const chart_route& each : routes) {
        std::snprintf(text, sizeof text, " %12s", each.name.c_str());
        line += text;
    }
    return line + "\n";
}

} // namespace

std::string json_of(const chart_results& r)
{
    json j;
    j["format"] = "ao chart 1";
    j["size"] = { r.options.size.width, r.options.size.height };
    j["truth_rays"] = r.options.rays;
    j["rounds"] = r.options.rounds;
    j["frames"] = r.options.frames;
    j["routes"] = routes_json(r.routes);
    j["views"] = views_json(r.views);
    j["single"] = json::array();
    for (const single_result& each : r.single)
        j["single"].push_back(single_json(each, r));
    j["temporal_routes"] = routes_json(r.temporal_routes);
    j["temporal"] = json::array();
    for (const chart_temporal& each : r.temporal)
        j["temporal"].push_back(temporal_json(each, r));
    j["vertices"] = r.vertices ? vertices_json(*r.vertices) : json(nullptr);
    // File names need not be UTF-8.
    return j.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string table_of(const chart_results& r)
{
    std::string text;
    if (!r.single.empty()) {
        text += "Mean over the views of RMSE, its worst, bias and p99; milliseconds per megapixel, medians\n";
        text += heading("single frames", "   rmse   worst    bias     p99", r.routes);
        for (const single_result& each : r.single) {
            const auto rmse = each_view(each.errors, [](const view_error& e) { return e.truth.rmse; });
            add_line(text, "%-42s %7.4f %7.4f %+7.4f %7.4f", each.configuration.name, mean_of(rmse),
                     *std::max_element(rmse.begin(), rmse.end()),
                     mean_of(each_view(each.errors, [](const view_error& e) { return e.truth.bias; })),
                     mean_of(each_view(each.errors, [](const view_error& e) { return e.p99; })), times_text(each.times));
        }
        std::vector<double> constants;
        for (const view_facts& v : r.views)
            constants.push_back(v.best_constant);
        add_line(text, "%-42s %7.4f %7.4f %+7.4f %7.4f", "best constant picture", mean_of(constants),
                 *std::max_element(constants.begin(), constants.end()), 0.0, 0.0, "");
    }
    for (const char* motion : { "static", "pan", "orbit" }) {
        std::string rows;
        for (const chart_temporal& each : r.temporal) {
            std::vector<double> rmse, bias, flicker;
            for (const motion_error& e : each.errors)
                if (e.motion == motion) {
                    rmse.push_back(e.truth.rmse);
                    bias.push_back(e.truth.bias);
                    flicker.push_back(e.flicker);
                }
            if (!rmse.empty())
                add_line(rows, "%-42s %7.4f %7.4f %+7.4f %7.5f", each.configuration.name, mean_of(rmse),
                         *std::max_element(rmse.begin(), rmse.end()), mean_of(bias), mean_of(flicker),
                         times_text(motion == std::string("static") ? each.still_times : each.moving_times));
        }
        if (!rows.empty()) {
            text += '\n';
            text += heading(std::string("over time, ") + motion, "   rmse   worst    bias flicker", r.temporal_routes);
            text += rows;
        }
    }
    if (r.vertices) {
        text += "\nper vertex, ";
        text += r.vertices->model;
        text += '\n';
        for (const vertex_point& p : r.vertices->points) {
            std::string times;
            for (const vertex_point::time& t : p.times) {
                char each[64];
                std::snprintf(each, sizeof each, "  %s %.1f ms", t.route.c_str(), t.ms);
                times += each;
            }
            char line[96];
            std::snprintf(line, sizeof line, "%-24s %6d directions  rmse %.5f", p.rule.c_str(), p.directions, p.rmse);
            text += line + times + "\n";
        }
    }
    return text;
}

} // namespace ao::tools
