// What the GPU backends' bakers have in common: tables for their shaders, and the cutting of a bake into launches that are short
// enough for a watchdog, a progress bar and a user who changes his mind.
#pragma once

#include "ao/bake.hpp"
#include "ao/result.hpp"

#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ao {

struct bake_gpu_options {
    // What a launch should take at most. It is cut by what the launch before took, so that single ones may take twice as long.
    double launch_seconds = 0.1;
    // Of what the packed route keeps on the device beside the mesh, bytes; at least what 16 lines take.
    std::size_t scratch = std::size_t{ 64 } << 20U;
};

namespace detail {

// ao_bake_launch of ao/shared/bake_gpu.glsl.
struct bake_launch {
    std::uint32_t first_vertex = 0;
    std::uint32_t last_vertex = 0;
    std::uint32_t first_line = 0;
    std::uint32_t last_line = 0;
    std::uint32_t first_triangle = 0;
    std::uint32_t last_triangle = 0;
    std::uint32_t base_vertex = 0;
    std::uint32_t points = 0;
    glm::vec4 ground{ 0.0F };
    float reach = 0;
    std::uint32_t words = 0;
    std::array<std::uint32_t, 2> reserved{};
};
static_assert(sizeof(bake_launch) == 64);

enum class bake_shader { brute, tiled, hierarchy, project, packed, count_packed };

inline std::span<const bake_shader> bake_shaders_of(bake_route route)
{
    static constexpr std::array all{ bake_shader::brute,   bake_shader::tiled,  bake_shader::hierarchy,
                                     bake_shader::project, bake_shader::packed, bake_shader::count_packed };
    const std::span<const bake_shader> list(all);
    switch (route) {
    case bake_route::brute:
        return list.first(1);
    case bake_route::tiled:
        return list.subspan(1, 1);
    case bake_route::hierarchy:
        return list.subspan(2, 1);
    default:
        return list.subspan(3);
    }
}

inline constexpr std::size_t bake_gpu_constants = 8;

// Invocations of a group. Rays through the tree share nothing, and llvmpipe takes 3 times as long for their stacks in groups of
// 256 as in small ones.
inline std::uint32_t bake_group_of(bake_route route, std::uint32_t group)
{
    return route == bake_route::hierarchy ? std::min(group, 32U) : group;
}

// By constant_id of ao/shared/bake_gpu.glsl.
inline std::array<std::uint32_t, bake_gpu_constants> bake_gpu_constants_of(const bake_job& job, std::uint32_t group)
{
    const bake_settings& s = job.settings;
    return { static_cast<std::uint32_t>(s.falloff),   job.by_cosine, s.bent_normals, s.sides == bake_sides::front,
             static_cast<std::uint32_t>(s.occluders), s.ground,      job.turned(),   group };
}

// Texels as the shaders load them.
struct bake_gpu_tables {
    std::vector<std::array<std::uint32_t, 4>> vertices;
    std::vector<std::array<std::uint32_t, 4>> triangles;
    std::vector<glm::vec4> points;
    std::vector<bake_line> lines;
    std::vector<bake_pass<float>::ao_rotation> rotations; // of the part's vertices, at least one
    std::span<const bake_node> nodes;                     // the job's
};

inline bake_gpu_tables make_bake_gpu_tables(const bake_job& job, const bake_request& part)
{
    static_assert(sizeof(bake_node) == 32 && sizeof(bake_line) == 48 && sizeof(bake_pass<float>::ao_rotation) == 48);
    const bake_mesh& m = job.mesh;
    bake_gpu_tables t;
    const auto word = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    t.vertices.reserve(2 * m.vertices.size());
    for (std::size_t i = 0; i < m.vertices.size(); ++i) {
        const bake_vertex& v = m.vertices[i];
        const bool baked = (m.flags[i] & bake_unbaked) == 0;
        t.vertices.push_back({ word(v.start.x), word(v.start.y), word(v.start.z), m.vertex_objects[i] });
        t.vertices.push_back({ word(v.normal.x), word(v.normal.y), word(v.normal.z), baked ? 1U : 0U });
    }
    t.triangles.reserve(m.triangles.size());
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
        t.triangles.push_back({ m.triangles[i][0], m.triangles[i][1], m.triangles[i][2], m.objects[i] });
    }
    t.points.reserve(m.points.size());
    for (const glm::vec3& p : m.points) {
        t.points.emplace_back(p, 0.0F);
    }
    t.lines = job.lines;
    t.nodes = m.tree.nodes;
    t.rotations.resize(1);
    if (job.turned()) {
        t.rotations.resize(part.last_vertex - part.first_vertex);
        for (std::size_t i = part.first_vertex; i < part.last_vertex; ++i) {
            t.rotations[i - part.first_vertex] = vertex_rotation(job, i);
        }
    }
    return t;
}

inline bool has_bake_gpu_route(bake_route route)
{
    return route == bake_route::automatic || route == bake_route::brute || route == bake_route::tiled ||
           route == bake_route::packed || route == bake_route::hierarchy;
}

// errc::unsupported_format where the one asked for cannot do the job.
inline result<std::pair<bake_route, const char*>> choose_bake_gpu_route(const bake_job& job, bake_route asked)
{
    using chosen = std::pair<bake_route, const char*>;
    const bool packable = job.settings.falloff == bake_falloff::none && !job.turned();
    switch (asked) {
    case bake_route::automatic:
        return chosen{ bake_route::hierarchy, "work grows with the logarithm of the triangles" };
    case bake_route::brute:
    case bake_route::tiled:
    case bake_route::hierarchy:
        return chosen{ asked, "as asked for" };
    case bake_route::packed:
        if (!packable) {
            return error(errc::unsupported_format, "the packed route keeps a bit per direction, of one rule for all vertices: no "
                                                   "fall-off, no rotation per vertex, no rule about the normal");
        }
        return chosen{ asked, "as asked for" };
    default:
        return error(errc::unsupported_format, "this backend has the bake routes brute, tiled, packed and hierarchy");
    }
}

// How much a launch may do, from what the last ones took.
class bake_pace {
public:
    explicit bake_pace(double seconds) : seconds_(seconds) {}

    // Tests of a ray against a triangle, at least 1.
    double tests() const { return std::max(1.0, tests_); }
    // A launch of so many took so long. Growth is held back: the next rays may not meet anything as soon.
    void took(double tests, double seconds)
    {
        const double fitting = seconds > 0 ? tests * seconds_ / seconds : 4 * tests_;
        tests_ = std::min({ fitting, 4 * std::max(tests, 1e6), 1e15 });
    }

private:
    double seconds_;
    double tests_ = 1e5; // fits anything
};

inline std::size_t rounded_up(std::size_t n, std::size_t to)
{
    return (n + to - 1) / to * to;
}

// Of the packed route: two bits a line.
inline constexpr std::size_t bake_lines_in_word = 16;

// So many lines along which the packed route keeps all points, a multiple of bake_lines_in_word.
inline std::size_t packed_lines_at_once(const bake_job& job, const bake_request& part, std::size_t scratch)
{
    const std::size_t line = sizeof(glm::vec4) * std::max<std::size_t>(job.mesh.points.size(), 1);
    const std::size_t fitting = std::max<std::size_t>(scratch / line / bake_lines_in_word, 1) * bake_lines_in_word;
    return std::min(fitting, rounded_up(part.last_line - part.first_line, bake_lines_in_word));
}

// Of the block of vertices with the most.
inline constexpr std::size_t most_block_vertices = 65536;

inline std::size_t packed_words(std::size_t vertices, std::size_t lines_at_once)
{
    return std::min(vertices, most_block_vertices) * (lines_at_once / bake_lines_in_word);
}

// Of this part, all 0.
inline bake_sums empty_bake_sums(const bake_request& part, bake_route route, const char* why)
{
    bake_sums sums{ part.first_vertex, part.last_vertex, part.first_line, part.last_line, {}, route, why };
    sums.sums.resize(part.last_vertex - part.first_vertex);
    return sums;
}

// Without triangles no vertex has a normal: all sums are 0.
inline bool nothing_to_bake(const bake_job& job, const bake_request& part)
{
    return part.first_vertex == part.last_vertex || part.first_line == part.last_line || job.mesh.triangles.empty();
}

// Cuts a part of a bake into launches, block of vertices after block of vertices. Execute: std::optional<error>(bake_shader,
// const bake_launch&, groups in x, groups in y), which returns when it is done.
template <class Execute>
class bake_gpu_driver {
public:
    bake_gpu_driver(const bake_job& job, const bake_request& part, bake_route route, const bake_gpu_options& options,
                    std::uint32_t group, Execute& execute)
        : part_(part),
          route_(route),
          group_(group),
          execute_(execute),
          pace_(options.launch_seconds),
          triangles_(job.mesh.triangles.size()),
          tests_of_ray_(route == bake_route::hierarchy ? tests_in_tree : static_cast<double>(triangles_))
    {
        launch_.base_vertex = static_cast<std::uint32_t>(part.first_vertex);
        launch_.last_triangle = static_cast<std::uint32_t>(triangles_);
        launch_.points = static_cast<std::uint32_t>(job.mesh.points.size());
        launch_.ground = job.ground;
        launch_.reach = job.reach;
    }

    // The end of the vertices that are done; the part's, unless progress said no.
    result<std::size_t> run(std::size_t lines_at_once)
    {
        std::size_t first = part_.first_vertex;
        while (first < part_.last_vertex && !ended_) {
            const std::size_t last = std::min(first + block_size(), part_.last_vertex);
            set_vertices(first, last);
            const auto failed = route_ == bake_route::packed ? run_packed(lines_at_once) : run_lines();
            if (failed) {
                return *failed;
            }
            if (whole_) {
                first = last;
            }
        }
        return first;
    }

private:
    static constexpr std::size_t least_vertices = 256;
    static constexpr std::size_t most_rows = 32768; // of groups; every driver takes 65535
    static constexpr double tests_in_tree = 64;     // of a ray, or about

    // So many that a launch does a few lines of all.
    std::size_t block_size() const
    {
        const std::size_t most = route_ == bake_route::hierarchy ? most_rows : most_block_vertices;
        const double fitting = pace_.tests() / (8 * tests_of_ray_);
        return static_cast<std::size_t>(std::clamp(fitting, static_cast<double>(least_vertices), static_cast<double>(most)));
    }

    void set_vertices(std::size_t first, std::size_t last)
    {
        launch_.first_vertex = static_cast<std::uint32_t>(first);
        launch_.last_vertex = static_cast<std::uint32_t>(last);
    }
    std::size_t vertices() const { return launch_.last_vertex - launch_.first_vertex; }
    void set_lines(std::size_t first, std::size_t last)
    {
        launch_.first_line = static_cast<std::uint32_t>(first);
        launch_.last_line = static_cast<std::uint32_t>(last);
    }
    std::uint32_t groups(std::size_t invocations) const
    {
        return static_cast<std::uint32_t>((invocations + group_ - 1) / group_);
    }

    // As many lines as the pace allows, a multiple of `step`.
    std::size_t lines_of_pace(std::size_t step) const
    {
        const double lines = pace_.tests() / (static_cast<double>(vertices()) * tests_of_ray_);
        const double steps = std::clamp(lines / static_cast<double>(step), 1.0, static_cast<double>(most_rows));
        return static_cast<std::size_t>(steps) * step;
    }

    std::optional<error> timed(bake_shader shader, std::uint32_t x, std::uint32_t y, double tests)
    {
        const auto start = std::chrono::steady_clock::now();
        auto failed = execute_(shader, launch_, x, y);
        pace_.took(tests, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        return failed;
    }

    double rays(std::size_t lines) const { return static_cast<double>(vertices()) * static_cast<double>(lines); }

    // The lines of the block up to `line` are done.
    void report(double line)
    {
        if (!part_.progress) {
            return;
        }
        const auto lines = static_cast<double>(part_.last_line - part_.first_line);
        const double block = static_cast<double>(vertices()) * (line - static_cast<double>(part_.first_line)) / lines;
        const double done = static_cast<double>(launch_.first_vertex - part_.first_vertex) + block;
        ended_ = !part_.progress(done / static_cast<double>(part_.last_vertex - part_.first_vertex));
    }

    std::optional<error> run_lines()
    {
        const bake_shader shader = bake_shaders_of(route_).front();
        std::size_t line = part_.first_line;
        while (line < part_.last_line && !ended_) {
            const std::size_t next = std::min(line + lines_of_pace(2), part_.last_line);
            set_lines(line, next);
            const std::size_t pairs = (next - line + 1) / 2;
            const bool by_vertex = shader == bake_shader::hierarchy;
            if (const auto failed =
                    timed(shader, groups(by_vertex ? pairs : vertices()),
                          static_cast<std::uint32_t>(by_vertex ? vertices() : pairs), rays(next - line) * tests_of_ray_)) {
                return failed;
            }
            line = next;
            report(static_cast<double>(line));
        }
        whole_ = line == part_.last_line;
        return std::nullopt;
    }

    // Lines by blocks: all points along them, then triangles, then the sums.
    std::optional<error> run_packed(std::size_t lines_at_once)
    {
        constexpr std::size_t bits = bake_lines_in_word;
        const std::size_t most = std::min(lines_at_once, most_rows);
        std::size_t line = part_.first_line;
        whole_ = false;
        while (line < part_.last_line && !ended_) {
            const std::size_t next = std::min({ line + lines_of_pace(bits), line + most, part_.last_line });
            set_lines(line, next);
            launch_.words = static_cast<std::uint32_t>((next - line + bits - 1) / bits);
            if (auto failed =
                    execute_(bake_shader::project, launch_, groups(launch_.points), static_cast<std::uint32_t>(next - line))) {
                return failed;
            }
            if (auto failed = run_triangles(next - line)) {
                return failed;
            }
            if (ended_) {
                return std::nullopt;
            }
            if (auto failed = execute_(bake_shader::count_packed, launch_, groups(vertices()), 1)) {
                return failed;
            }
            line = next;
            report(static_cast<double>(line));
        }
        whole_ = line == part_.last_line;
        return std::nullopt;
    }

    std::optional<error> run_triangles(std::size_t lines)
    {
        for (std::size_t t = 0; t < triangles_ && !ended_;) {
            const double fitting = pace_.tests() / rays(lines);
            const auto count = static_cast<std::size_t>(std::clamp(fitting, 1024.0, static_cast<double>(triangles_ - t) + 1024));
            const std::size_t end = std::min(t + count, triangles_);
            launch_.first_triangle = static_cast<std::uint32_t>(t);
            launch_.last_triangle = static_cast<std::uint32_t>(end);
            if (auto failed =
                    timed(bake_shader::packed, groups(vertices()), launch_.words, rays(lines) * static_cast<double>(end - t))) {
                return failed;
            }
            t = end;
            if (t < triangles_) {
                report(static_cast<double>(launch_.first_line) +
                       static_cast<double>(lines) * static_cast<double>(t) / static_cast<double>(triangles_));
            }
        }
        return std::nullopt;
    }

    const bake_request& part_;
    bake_route route_;
    std::uint32_t group_;
    Execute& execute_;
    bake_pace pace_;
    std::size_t triangles_;
    double tests_of_ray_;
    bake_launch launch_;
    bool ended_ = false; // by progress
    bool whole_ = false; // the block of vertices is done
};

} // namespace detail

} // namespace ao
