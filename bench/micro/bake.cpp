// Complete bakes of ambient occlusion per vertex: the CPU's routes beside the best bare loop over Embree that is known (any-hit
// packets of 16, directions sorted; shared/design/vertex-ao.md, 1). Interleaved medians in one run.
//
//     bench_bake [--rounds N] [--threads N] [--points N] [--processor-time] [MODEL.ply …]     ASCII, besides meshes made here
#include "bake_meshes.hpp"
#include "embree_loop.hpp"
#include "micro/measure.hpp"

#include "ao/bake.hpp"
#include "ao/cpu/bake.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

namespace {

using namespace ao::bench;

struct choices {
    int rounds = 5;
    int threads = 2;
    int points = 5810;
    bool processor_time = false;
    std::vector<std::string> files;
};

choices read(int count, char** words)
{
    choices c;
    for (int i = 1; i < count; ++i) {
        const auto number = [&](const char* name, int& value) {
            if (std::strcmp(words[i], name) != 0 || i + 1 == count) {
                return false;
            }
            value = std::atoi(words[++i]);
            return true;
        };
        if (std::strcmp(words[i], "--processor-time") == 0) {
            c.processor_time = true;
            continue;
        }
        if (!number("--rounds", c.rounds) && !number("--threads", c.threads) && !number("--points", c.points)) {
            c.files.emplace_back(words[i]);
        }
    }
    return c;
}

// Of all threads together, divided by their number: on a machine with other work to do, wall time measures that work.
double processor_milliseconds(const std::function<void()>& what, int threads)
{
    const std::clock_t start = std::clock();
    what();
    return static_cast<double>(std::clock() - start) * 1e3 / static_cast<double>(CLOCKS_PER_SEC) / threads;
}

double milliseconds(const std::function<void()>& what)
{
    const auto start = std::chrono::steady_clock::now();
    what();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void compare(const std::string& name, const plain_mesh& mesh, const choices& c)
{
    const auto rule = take(ao::lebedev_rule(c.points));
    ao::bake_job job;
    const double preparing = milliseconds([&] { job = take(ao::prepare_bake(mesh.input(), rule, {})); });
    auto baker = take(ao::cpu::baker::create({ .threads = c.threads }));
    embree_loop embree(job, c.threads);

    // The same coefficients but for grazing rays, or times mean nothing.
    const auto sums = take(baker.run(job, { .route = ao::bake_route::raster }));
    const ao::bake_result baked = ao::finish_bake(job, sums);
    const std::vector<float> traced = embree.bake();
    double squares = 0;
    float greatest = 0;
    for (std::size_t i = 0; i < traced.size(); ++i) {
        const float difference = std::abs(traced[i] - baked.coefficients[i]);
        squares += static_cast<double>(difference) * static_cast<double>(difference);
        greatest = std::max(greatest, difference);
    }
    std::printf("%s: %zu vertices, %zu triangles, mean %.4f, prepared in %.0f ms; Embree differs by %.1e rms, %.1e at most\n",
                name.c_str(), job.vertices(), job.mesh.triangles.size(), baked.report.mean, preparing,
                std::sqrt(squares / static_cast<double>(traced.size())), static_cast<double>(greatest));

    const auto timed = [&](const std::function<void()>& what) {
        return c.processor_time ? processor_milliseconds(what, c.threads) : milliseconds(what);
    };
    std::vector<contestant> field;
    for (const ao::bake_route route : { ao::bake_route::raster, ao::bake_route::hierarchy, ao::bake_route::embree }) {
        if (ao::cpu::baker::has(route)) {
            const char* names[] = { "automatic", "brute", "tiled", "packed", "hierarchy", "raster", "embree", "cube maps" };
            field.push_back({ names[static_cast<int>(route)],
                              [&, route] { return timed([&] { take(baker.run(job, { .route = route })); }); },
                              {} });
        }
    }
    field.push_back({ "bare Embree loop", [&] { return timed([&] { embree.bake(); }); }, {} });
    measure(field, c.rounds);
    const double rays = static_cast<double>(job.vertices()) * static_cast<double>(rule.size()) / 2;
    for (const contestant& x : field) {
        std::printf("  %-18s %9.1f ms %7.2f Mrays/s  bare Embree / this %.2f\n", x.name.c_str(), x.median(),
                    rays / x.median() * 1e-3, field.back().median() / x.median());
    }
    std::fflush(stdout);
}

} // namespace

int main(int count, char** words)
{
    const choices c = read(count, words);
    compare("knot", knot(260, 20), c);
    compare("rough ball", rough_ball(5), c);
    for (const std::string& file : c.files) {
        compare(file, read_ply(file), c);
    }
    return 0;
}
