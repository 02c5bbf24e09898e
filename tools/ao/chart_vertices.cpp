#include "ao/bake.hpp"
#include "ao/chart_results.hpp"
#include "ao/lebedev.hpp"
#include "ao/outcome.hpp"
#include "ao/rule_text.hpp"
#include "host/bake_runner.hpp"
#include "scene/courtyard.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

namespace ao::tools {
namespace {

constexpr std::size_t looked_at = 1024;
constexpr int truth_directions = 40009;
constexpr int repeats = 3;
// Of a radius as the screen-space methods have it: farther occluders do not count.
constexpr double reach = 1.0;

// The bundled scene with the vertices that are looked at first, evenly picked.
struct vertex_mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices;
    double diagonal = 0.0;

    explicit vertex_mesh(const tools::scene& s)
    {
        const std::size_t count = std::min(looked_at, s.positions.size());
        std::vector<std::uint32_t> order;
        std::vector<bool> picked(s.positions.size(), false);
        for (std::size_t i = 0; i < count; ++i) {
            order.push_back(static_cast<std::uint32_t>((2 * i + 1) * s.positions.size() / (2 * count)));
            picked[order.back()] = true;
        }
        for (std::uint32_t v = 0; v < s.positions.size(); ++v)
            if (!picked[v])
                order.push_back(v);
        std::vector<std::uint32_t> place(order.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            place[order[i]] = i;
            positions.emplace_back(s.positions[order[i]]);
            normals.push_back(s.normals[order[i]]);
        }
        for (const glm::uvec3& t : s.triangles)
            for (int corner = 0; corner < 3; ++corner)
                indices.push_back(place[t[corner]]);
        const bounds b = bounds_of(s);
        diagonal = static_cast<double>(glm::length(b.high - b.low));
    }
};

ao::sphere_rule rule_of(const std::string& words)
{
    return take("--rule " + words, named_rule(words));
}

ao::bake_job job_of(const vertex_mesh& m, const ao::sphere_rule& rule)
{
    ao::bake_settings s;
    s.coefficient = bake_coefficient::cosine;
    s.distance = reach / m.diagonal;
    return take("bake", prepare_bake({ m.positions, m.normals, m.indices, {} }, rule, s));
}

struct run_result {
    ao::bake_result baked;
    double ms = 0.0;
};

run_result run(host::bake_runner& runner, const ao::bake_job& job, bake_route route)
{
    ao::bake_request request;
    request.last_vertex = std::min(looked_at, job.vertices());
    request.route = route;
    const auto start = std::chrono::steady_clock::now();
    ao::bake_sums sums = take(std::string(runner.backend()), runner.run(job, request));
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    // The others have no directions, and finish_bake leaves them out.
    sums.last_vertex = job.vertices();
    sums.sums.resize(job.vertices());
    stop_if_interrupted();
    return { finish_bake(job, sums), taken.count() };
}

struct timed_route {
    const char* name;
    const char* backend;
    bake_route route;
    int most; // directions; beyond it would take too long on software drivers
};

constexpr timed_route all_routes[] = {
    { "cpu raster", "cpu", bake_route::raster, 1202 },     { "cpu hierarchy", "cpu", bake_route::hierarchy, 5810 },
    { "cpu embree", "cpu", bake_route::embree, 5810 },     { "gl hierarchy", "gl", bake_route::hierarchy, 1202 },
    { "vk hierarchy", "vk", bake_route::hierarchy, 1202 },
};

double rmse_of(const ao::bake_result& baked, const std::vector<float>& truth)
{
    double square = 0.0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < truth.size(); ++v) {
        if ((baked.flags[v] & bake_unbaked) != 0)
            continue;
        const double error = static_cast<double>(baked.coefficients[v]) - static_cast<double>(truth[v]);
        square += error * error;
        ++count;
    }
    return count == 0 ? 0.0 : std::sqrt(square / static_cast<double>(count));
}

} // namespace

void chart_vertices(chart_results& r)
{
    const vertex_mesh mesh(courtyard());
    vertex_results all;
    all.model = "courtyard";
    all.vertices = std::min(looked_at, mesh.positions.size());
    all.triangles = mesh.indices.size() / 3;
    all.truth_directions = truth_directions;
    std::map<std::string, host::bake_runner_ptr> runners;
    for (const std::string backend : { "cpu", "gl", "vk" })
        if (backend == "cpu" ||
            std::find(r.options.backends.begin(), r.options.backends.end(), backend) != r.options.backends.end())
            runners[backend] = take(backend, host::make_bake_runner(backend, { .device = r.options.device }));
    host::bake_runner& cpu = *runners.at("cpu");
    progress_line progress("vertices", r.options.progress);
    ao::bake_result truth =
        run(cpu, job_of(mesh, rule_of("fibonacci:" + std::to_string(truth_directions))), bake_route::automatic).baked;
    truth.coefficients.resize(all.vertices);

    const std::vector<std::pair<std::string, std::vector<int>>> rules{
        { "lebedev", { 110, 302, 770, 1202, 2354, 5810 } },
        { "fibonacci", { 110, 302, 770, 1202, 2354, 5810 } },
        { "marsaglia", { 110, 302, 770, 1202, 2354, 5810 } },
    };
    double done = 0.0;
    for (const auto& [name, counts] : rules)
        for (const int count : counts) {
            const ao::bake_job job = job_of(mesh, rule_of(name + ":" + std::to_string(count)));
            vertex_point point;
            point.rule = name;
            point.directions = count;
            const ao::bake_result baked = run(cpu, job, bake_route::automatic).baked;
            point.rmse = rmse_of(baked, truth.coefficients);
            point.estimated = baked.report.typical_error;
            for (const timed_route& each : all_routes) {
                if (name != "lebedev" || count > each.most || !runners.contains(each.backend))
                    continue;
                std::vector<double> ms;
                for (int i = 0; i < repeats + 1; ++i) {
                    const run_result timed = run(*runners.at(each.backend), job, each.route);
                    if (i > 0)
                        ms.push_back(timed.ms);
                    if (each.route != bake_route::embree && timed.baked.coefficients != baked.coefficients)
                        throw error(std::string(each.name) + ", " + name + ":" + std::to_string(count) +
                                    ": other coefficients than the cpu's");
                }
                point.times.push_back(
                    { each.name, median(ms), *std::min_element(ms.begin(), ms.end()), *std::max_element(ms.begin(), ms.end()) });
            }
            all.points.push_back(std::move(point));
            progress.update((done += 1) / 18.0);
        }
    r.vertices = std::move(all);
}

} // namespace ao::tools
