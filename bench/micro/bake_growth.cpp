// How time and memory of bakes on the CPU grow with triangles, vertices and directions. Every row is a process of its own, so
// that its peak memory is its own as well.
//
//     bench_bake_growth [--largest]     with it, a knot of 10^7 triangles, too
#include "bake_meshes.hpp"

#include "ao/bake.hpp"
#include "ao/cpu/bake.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace ao::bench;

struct row {
    int around;       // points of the knot; 13 times as many along it
    int points;       // of Lebedev's rule
    std::size_t part; // of the vertices one in this many is baked
    ao::bake_route route;
};

double processor_seconds()
{
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

// Peak resident memory, MB.
double peak_memory()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word == "VmHWM:") {
            double kilobytes = 0;
            status >> kilobytes;
            return kilobytes / 1024;
        }
    }
    return 0;
}

void measure_row(const row& r)
{
    const plain_mesh mesh = knot(13 * r.around, r.around);
    const double of_mesh = peak_memory();
    const double start = processor_seconds();
    const ao::bake_job job = take(ao::prepare_bake(mesh.input(), take(ao::lebedev_rule(r.points)), {}));
    const double prepared = processor_seconds();
    auto baker = take(ao::cpu::baker::create({ .threads = 2 }));
    const std::size_t vertices = job.vertices() / r.part;
    const auto sums = take(baker.run(job, { .last_vertex = vertices, .route = r.route }));
    const double baked = processor_seconds();
    const double rays = static_cast<double>(vertices) * r.points / 2;
    std::printf("| %8zu | %8zu | %5d | %-9s | %8.2f | %8.2f | %7.0f | %6.0f | %6.0f |\n", job.mesh.triangles.size(), vertices,
                r.points, r.route == ao::bake_route::raster ? "raster" : "hierarchy", prepared - start, baked - prepared,
                (baked - prepared) / rays * 1e9, of_mesh, peak_memory());
    std::fflush(stdout);
}

} // namespace

int main(int count, char** words)
{
    using enum ao::bake_route;
    std::vector<row> rows;
    for (const ao::bake_route route : { raster, hierarchy }) {
        for (const int around : { 6, 20, 62, 196 }) {
            rows.push_back({ around, 50, 1, route });
        }
        rows.push_back({ 196, 50, 16, route });
        rows.push_back({ 62, 194, 1, route });
        rows.push_back({ 62, 770, 1, route });
    }
    if (count > 1 && std::strcmp(words[1], "--largest") == 0) {
        rows = { { 620, 6, 1, raster }, { 620, 6, 1, hierarchy } };
    }
    std::printf(
        "| triangles | vertices | directions | route | prepare, s | bake, s of processor | ns a ray | mesh, MB | peak, MB |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|\n");
    std::fflush(stdout);
    for (const row& r : rows) {
        const pid_t child = ::fork();
        if (child == 0) {
            measure_row(r);
            ::_exit(0);
        }
        int status = 0;
        if (child < 0 || ::waitpid(child, &status, 0) != child || status != 0) {
            stop("a row ended with status " + std::to_string(status));
        }
    }
    return 0;
}
