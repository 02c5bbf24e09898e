#include "ao/bake_results.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <sys/resource.h>

namespace ao::tools {
namespace {

using json = nlohmann::ordered_json;

// The routes of parts may differ.
std::string route_of(const bake_run_facts& f)
{
    std::vector<std::string> all;
    for (const bake_part& p : f.parts)
        for (const ao::bake_sums& s : p.done)
            all.emplace_back(name_of(s.route));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::string text;
    for (const std::string& each : all)
        text += (text.empty() ? "" : ", ") + each;
    return text.empty() ? "none" : text;
}

std::uint64_t rays_of(const bake_run_facts& f)
{
    std::uint64_t rays = 0;
    for (const bake_part& p : f.parts)
        for (const ao::bake_sums& s : p.done)
            for (const ao::bake_sum& sum : s.sums)
                rays += static_cast<std::uint64_t>(std::max(sum.count, 0));
    return rays;
}

double per_second(std::uint64_t rays, double seconds)
{
    return seconds > 0.0 ? static_cast<double>(rays) / seconds : 0.0;
}

std::string line(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string line(const char* format, ...)
{
    char text[1024];
    va_list list;
    va_start(list, format);
    std::vsnprintf(text, sizeof text, format, list);
    va_end(list);
    return std::string(text) + '\n';
}

} // namespace

std::string json_of(const bake_options& o, const bake_choice& c, const bake_work& work, const bake_run_facts& f,
                    const bake_results* r, double total_seconds)
{
    const ao::bake_job& job = work.job;
    const std::uint64_t rays = rays_of(f);
    json j;
    j["model"] = work.model.name;
    j["vertices"] = work.model.positions.size();
    j["baked_vertices"] = job.vertices();
    j["triangles"] = work.triangles;
    j["objects"] = job.mesh.object_count;
    j["settings"] = json::parse(to_text(c));
    j["settings"].erase("rule_text");
    if (!o.light.file.empty())
        j["light"] = { { "file", o.light.file },
                       { "shininess", o.light.exponent ? json(*o.light.exponent) : json(nullptr) },
                       { "eye", o.light.eye ? json{ o.light.eye->x, o.light.eye->y, o.light.eye->z } : json(nullptr) } };
    j["directions"] = work.directions;
    j["lines"] = job.lines.size();
    if (o.sharded)
        j["shard"] = { o.shard, o.shards };
    if (!o.merge.empty())
        j["merged"] = o.merge.size();
    j["backend"] = f.backend;
    j["device"] = f.device;
    j["route"] = route_of(f);
    j["reason"] = f.reason;
    j["rays"] = rays;
    j["rays_per_second"] = per_second(rays, f.seconds);
    j["kept_share"] = f.kept;
    j["read_seconds"] = work.read_seconds;
    j["build_seconds"] = work.build_seconds;
    j["bake_seconds"] = f.seconds;
    j["total_seconds"] = total_seconds;
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    j["peak_memory_bytes"] = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    if (r != nullptr) {
        const ao::bake_report& report = r->baked.report;
        j["coefficient"] = { { "min", report.least }, { "mean", report.mean }, { "max", report.greatest } };
        j["error"] = { { "typical", report.typical_error }, { "greatest", report.greatest_error } };
        j["unbaked"] = { { "isolated", report.isolated },
                         { "not_finite", report.not_finite },
                         { "no_normal", report.no_normal } };
        j["enclosed"] = report.enclosed;
        j["dropped_faces"] = { { "not_finite", report.dropped.not_finite }, { "no_area", report.dropped.no_area } };
    }
    // File names need not be UTF-8.
    return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string summary_of(const bake_work& work, const bake_run_facts& f, const bake_results* r)
{
    const std::uint64_t rays = rays_of(f);
    std::string out = line("%zu vertices, %zu triangles, %zu directions", work.job.vertices(), work.triangles, work.directions);
    out += line("%llu rays in %.3f s, %.3g/s; read in %.3f s, built in %.3f s", static_cast<unsigned long long>(rays), f.seconds,
                per_second(rays, f.seconds), work.read_seconds, work.build_seconds);
    out += "route " + route_of(f) + (f.device.empty() ? "" : " on " + f.backend + ", " + f.device) + "; " + f.reason + "\n";
    if (r == nullptr)
        return out;
    const ao::bake_report& report = r->baked.report;
    out += line("coefficient %.4f to %.4f, mean %.4f; estimated error %.2g typical, %.2g greatest",
                static_cast<double>(report.least), static_cast<double>(report.greatest), report.mean, report.typical_error,
                static_cast<double>(report.greatest_error));
    const auto count = [&](std::size_t n, const char* what) {
        if (n > 0)
            out += line("%zu %s", n, what);
    };
    count(report.isolated, "vertices of no face with an area: coefficient 1");
    count(report.not_finite, "vertices that are not finite: coefficient 1");
    count(report.no_normal, "vertices without a normal: coefficient 1");
    count(report.enclosed, "vertices enclosed by surfaces that meet there");
    count(report.dropped.not_finite, "faces that are not finite: left out");
    count(report.dropped.no_area, "faces without area: left out");
    return out;
}

} // namespace ao::tools
