// The cutting of a bake on a GPU into launches that are short enough for a watchdog, a progress bar and a user who changes his
// mind.
#pragma once

#include "ao/bake_gpu.hpp"

#include <glm/vec3.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ao::detail {

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

// Cuts a part of a bake into launches. Execute: std::optional<error>(bake_shader, const bake_launch&, groups in x, groups in y),
// which returns when it is done.
template <class Execute>
class bake_gpu_driver {
public:
    bake_gpu_driver(const bake_job& job, const bake_request& part, bake_route route, const bake_gpu_options& options,
                    const bake_room& room, std::uint32_t group, Execute& execute)
        : part_(part),
          route_(route),
          room_(room),
          group_(group),
          execute_(execute),
          pace_(options.launch_seconds),
          look_up_pace_(options.launch_seconds),
          triangles_(job.mesh.triangles.size()),
          tests_of_ray_(route == bake_route::hierarchy ? tests_in_tree : static_cast<double>(triangles_))
    {
        const bake_node& root = job.mesh.tree.nodes.front();
        launch_.base_vertex = static_cast<std::uint32_t>(part.first_vertex);
        launch_.last_triangle = static_cast<std::uint32_t>(triangles_);
        launch_.points = static_cast<std::uint32_t>(job.mesh.points.size());
        launch_.ground = job.ground;
        launch_.reach = job.reach;
        launch_.pitch = static_cast<std::uint32_t>(room.pitch);
        launch_.box = glm::vec4(glm::max(glm::abs(root.low), glm::abs(root.high)), 0.0F);
        launch_.columns = room.columns;
        launch_.rows = room.rows;
    }

    struct done {
        std::size_t last_vertex;
        std::size_t last_line;
    };

    // What is done from the part's first vertex and line on: all, unless progress said no.
    result<done> run()
    {
        const auto failed = route_ == bake_route::raster ? run_raster() : route_ == bake_route::cube ? run_cubes() : run_blocks();
        if (failed) {
            return *failed;
        }
        return done_;
    }

private:
    static constexpr std::size_t least_vertices = 256;
    static constexpr std::size_t most_vertices = 65536;
    static constexpr std::size_t most_rows = 32768; // of groups; every driver takes 65535
    static constexpr double tests_in_tree = 64;     // of a ray, or about
    static constexpr double starts_in_box = 8;      // of a triangle, or about

    // Block of vertices after block of vertices, each along all lines.
    std::optional<error> run_blocks()
    {
        std::size_t first = part_.first_vertex;
        while (first < part_.last_vertex && !ended_) {
            const std::size_t last = std::min(first + block_size(), part_.last_vertex);
            set_vertices(first, last);
            if (auto failed = route_ == bake_route::packed ? run_packed() : run_lines()) {
                return failed;
            }
            if (whole_) {
                first = last;
            }
        }
        done_ = { first, part_.last_line };
        return std::nullopt;
    }

    // So many that a launch does a few lines of all.
    std::size_t block_size() const
    {
        const std::size_t most = route_ == bake_route::hierarchy ? most_rows
                                 : route_ == bake_route::packed  ? std::max(room_.vertices, least_vertices)
                                                                 : most_vertices;
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
        launch_.words = static_cast<std::uint32_t>((last - first + bake_lines_in_word - 1) / bake_lines_in_word);
    }
    std::size_t lines() const { return launch_.last_line - launch_.first_line; }
    std::uint32_t groups(std::size_t invocations) const
    {
        return static_cast<std::uint32_t>((invocations + group_ - 1) / group_);
    }

    // As many lines as the pace allows, a multiple of `step`.
    std::size_t lines_of_pace(std::size_t step) const
    {
        const double fitting = pace_.tests() / (static_cast<double>(vertices()) * tests_of_ray_);
        const double steps = std::clamp(fitting / static_cast<double>(step), 1.0, static_cast<double>(most_rows));
        return static_cast<std::size_t>(steps) * step;
    }

    std::optional<error> timed(bake_shader shader, bake_pace& pace, std::uint32_t x, std::uint32_t y, double tests)
    {
        const auto start = std::chrono::steady_clock::now();
        auto failed = execute_(shader, launch_, x, y);
        pace.took(tests, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        return failed;
    }

    double rays(std::size_t of_lines) const { return static_cast<double>(vertices()) * static_cast<double>(of_lines); }

    void report(double share)
    {
        if (part_.progress && !ended_) {
            ended_ = !part_.progress(std::min(share, 1.0));
        }
    }

    // The lines of the block up to `line` are done, after a share of its work that was done before all lines.
    void report_block(double line, double share_before = 0)
    {
        const double lines_done = line - static_cast<double>(part_.first_line);
        const double share = lines_done / static_cast<double>(part_.last_line - part_.first_line);
        report_vertices(share_before + (1 - share_before) * share);
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
            if (auto failed =
                    timed(shader, pace_, groups(by_vertex ? pairs : vertices()),
                          static_cast<std::uint32_t>(by_vertex ? vertices() : pairs), rays(next - line) * tests_of_ray_)) {
                return failed;
            }
            line = next;
            report_block(static_cast<double>(line));
        }
        whole_ = line == part_.last_line;
        return std::nullopt;
    }

    // So many lines from `line` on whose points, and what is found, there is room for.
    std::size_t lines_from(std::size_t line, std::size_t wanted) const
    {
        return std::min({ wanted, room_.lines, most_rows, part_.last_line - line });
    }

    std::optional<error> project()
    {
        return execute_(bake_shader::project, launch_, groups(launch_.points), static_cast<std::uint32_t>(lines()));
    }

    std::optional<error> count() { return execute_(bake_shader::count_packed, launch_, groups(vertices()), launch_.words); }

    // Lines by batches: all points along them, then triangles, then the sums.
    std::optional<error> run_packed()
    {
        std::size_t line = part_.first_line;
        whole_ = false;
        while (line < part_.last_line && !ended_) {
            const std::size_t next = line + lines_from(line, lines_of_pace(bake_lines_in_word));
            set_lines(line, next);
            if (auto failed = project()) {
                return failed;
            }
            if (auto failed = run_triangles()) {
                return failed;
            }
            if (ended_) {
                return std::nullopt;
            }
            if (auto failed = count()) {
                return failed;
            }
            line = next;
            report_block(static_cast<double>(line));
        }
        whole_ = line == part_.last_line;
        return std::nullopt;
    }

    std::optional<error> run_triangles()
    {
        for (std::size_t t = 0; t < triangles_ && !ended_;) {
            const std::size_t end = triangles_from(t, pace_.tests() / rays(lines()));
            if (auto failed = timed(bake_shader::packed, pace_, groups(vertices()), launch_.words,
                                    rays(lines()) * static_cast<double>(end - t))) {
                return failed;
            }
            t = end;
            if (t < triangles_) {
                report_block(static_cast<double>(launch_.first_line) + static_cast<double>(lines()) * share_of(t));
            }
        }
        return std::nullopt;
    }

    double share_of(std::size_t triangles) const { return static_cast<double>(triangles) / static_cast<double>(triangles_); }

    // Makes a launch's triangles those from `first` on, about so many as are fitting.
    std::size_t triangles_from(std::size_t first, double fitting)
    {
        const auto count = static_cast<std::size_t>(std::clamp(fitting, 1024.0, static_cast<double>(triangles_ - first) + 1024));
        const std::size_t end = std::min(first + count, triangles_);
        launch_.first_triangle = static_cast<std::uint32_t>(first);
        launch_.last_triangle = static_cast<std::uint32_t>(end);
        return end;
    }

    // Lines by batches, each for all vertices. Ends where all have the same lines: before a batch, or after it once the sums of
    // some have it.
    std::optional<error> run_raster()
    {
        std::size_t line = part_.first_line;
        while (line < part_.last_line && !ended_) {
            const double of_line = starts_in_box * static_cast<double>(triangles_);
            const double words =
                std::clamp(8 * pace_.tests() / of_line / bake_lines_in_word, 1.0, static_cast<double>(most_rows));
            const std::size_t count = lines_from(line, static_cast<std::size_t>(words) * bake_lines_in_word);
            set_lines(line, line + count);
            if (auto failed = project()) {
                return failed;
            }
            for (std::size_t first = part_.first_vertex; first < part_.last_vertex; first += room_.vertices) {
                set_vertices(first, std::min(first + room_.vertices, part_.last_vertex));
                if (auto failed = raster_block()) {
                    return failed;
                }
                if (ended_ && first == part_.first_vertex) {
                    done_ = { part_.last_vertex, line };
                    return std::nullopt;
                }
                if (auto failed = this->count()) {
                    return failed;
                }
            }
            line += count;
            report(static_cast<double>(line - part_.first_line) / static_cast<double>(part_.last_line - part_.first_line));
        }
        done_ = { part_.last_vertex, line };
        return std::nullopt;
    }

    // What the block's vertices meet along the batch's lines.
    std::optional<error> raster_block()
    {
        launch_.first_row = 0;
        if (auto failed = execute_(bake_shader::raster_sort, launch_, 1, static_cast<std::uint32_t>(lines()))) {
            return failed;
        }
        const bool first_block = launch_.first_vertex == part_.first_vertex;
        for (std::size_t row = 0; row < lines();) {
            const double of_line = starts_in_box * static_cast<double>(triangles_);
            const double fitting = std::clamp(pace_.tests() / of_line, 1.0, static_cast<double>(lines() - row));
            const auto rows = static_cast<std::size_t>(fitting);
            launch_.first_row = static_cast<std::uint32_t>(row);
            for (std::size_t t = 0; t < triangles_;) {
                const double left = static_cast<double>(rows) * starts_in_box;
                const std::size_t end = triangles_from(t, pace_.tests() / left);
                if (auto failed = timed(bake_shader::raster_cover, pace_, groups(end - t), static_cast<std::uint32_t>(rows),
                                        left * static_cast<double>(end - t))) {
                    return failed;
                }
                t = end;
                const double lines_done = static_cast<double>(row) + static_cast<double>(rows) * share_of(t);
                report_raster(lines_done);
                if (ended_ && first_block) {
                    return std::nullopt;
                }
            }
            row += rows;
        }
        return std::nullopt;
    }

    // Block of vertices after block of vertices: their cube maps, then the directions of all lines in these.
    std::optional<error> run_cubes()
    {
        const std::size_t texels = std::size_t{ 6 } * room_.columns * room_.columns;
        std::size_t first = part_.first_vertex;
        while (first < part_.last_vertex && !ended_) {
            const std::size_t last = std::min(first + room_.vertices, part_.last_vertex);
            set_vertices(first, last);
            const auto rows = static_cast<std::uint32_t>(vertices());
            if (auto failed = execute_(bake_shader::cube_clear, launch_, groups(texels), rows)) {
                return failed;
            }
            for (std::size_t t = 0; t < triangles_ && !ended_;) {
                const std::size_t end = triangles_from(t, pace_.tests() / static_cast<double>(rows));
                if (auto failed =
                        timed(bake_shader::cube_depth, pace_, groups(end - t), rows, rows * static_cast<double>(end - t))) {
                    return failed;
                }
                t = end;
                report_vertices(0.9 * share_of(t));
            }
            std::size_t line = part_.first_line;
            while (line < part_.last_line && !ended_) {
                const double fitting = look_up_pace_.tests() / static_cast<double>(rows) / 2;
                const std::size_t next =
                    std::min(line + 2 * static_cast<std::size_t>(std::clamp(fitting, 64.0, 1e6)), part_.last_line);
                set_lines(line, next);
                if (auto failed =
                        timed(bake_shader::cube_count, look_up_pace_, groups((next - line + 1) / 2), rows, rays(next - line))) {
                    return failed;
                }
                line = next;
                report_block(static_cast<double>(line), 0.9);
            }
            if (line == part_.last_line) {
                first = last;
            }
        }
        done_ = { first, part_.last_line };
        return std::nullopt;
    }

    // A share of the block is done.
    void report_vertices(double share)
    {
        const double before = static_cast<double>(launch_.first_vertex - part_.first_vertex);
        report((before + share * static_cast<double>(vertices())) / static_cast<double>(part_.last_vertex - part_.first_vertex));
    }

    // So many of the batch's lines are done for the block.
    void report_raster(double batch_lines)
    {
        const auto vertices_all = static_cast<double>(part_.last_vertex - part_.first_vertex);
        const auto before = static_cast<double>(launch_.first_vertex - part_.first_vertex);
        const double of_batch =
            (before * static_cast<double>(lines()) + static_cast<double>(vertices()) * batch_lines) / vertices_all;
        const double done_lines = static_cast<double>(launch_.first_line - part_.first_line) + of_batch;
        const double share = done_lines / static_cast<double>(part_.last_line - part_.first_line);
        if (share < 1) {
            report(share);
        }
    }

    const bake_request& part_;
    bake_route route_;
    bake_room room_;
    std::uint32_t group_;
    Execute& execute_;
    bake_pace pace_;
    bake_pace look_up_pace_; // in cube maps
    std::size_t triangles_;
    double tests_of_ray_;
    bake_launch launch_;
    done done_{};
    bool ended_ = false; // by progress
    bool whole_ = false; // the block of vertices is done
};

} // namespace ao::detail
