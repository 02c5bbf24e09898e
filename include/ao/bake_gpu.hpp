// What the GPU backends' bakers have in common: their routes, and tables for their shaders.
#pragma once

#include "ao/bake.hpp"
#include "ao/bake_route.hpp"
#include "ao/result.hpp"

#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ao {

struct bake_gpu_options {
    // What a launch should take at most. It is cut by what the launch before took, so that single ones may take twice as long.
    double launch_seconds = 0.1;
    // Of what the routes packed, raster and cube keep on the device beside the mesh, bytes; at least what 16 lines or 16 cube
    // maps take.
    std::size_t scratch = std::size_t{ 64 } << 20U;
    // Texels across each of the six faces of the route cube, 1 to 1024.
    std::uint32_t cube_texels = 64;
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
    std::uint32_t first_row = 0;
    std::uint32_t pitch = 0;
    glm::vec4 box{ 0.0F };
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::array<std::uint32_t, 2> reserved{};
};
static_assert(sizeof(bake_launch) == 96);

enum class bake_shader {
    brute,
    tiled,
    hierarchy,
    project,
    packed,
    count_packed,
    raster_sort,
    raster_cover,
    cube_clear,
    cube_depth,
    cube_count
};

inline std::span<const bake_shader> bake_shaders_of(bake_route route)
{
    using enum bake_shader;
    static constexpr std::array by_brute{ brute };
    static constexpr std::array by_tiles{ tiled };
    static constexpr std::array by_tree{ hierarchy };
    static constexpr std::array by_bits{ project, packed, count_packed };
    static constexpr std::array by_raster{ project, raster_sort, raster_cover, count_packed };
    static constexpr std::array by_cube{ cube_clear, cube_depth, cube_count };
    switch (route) {
    case bake_route::brute:
        return by_brute;
    case bake_route::tiled:
        return by_tiles;
    case bake_route::hierarchy:
        return by_tree;
    case bake_route::raster:
        return by_raster;
    case bake_route::cube:
        return by_cube;
    default:
        return by_bits;
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
           route == bake_route::packed || route == bake_route::hierarchy || route == bake_route::raster ||
           route == bake_route::cube;
}

// errc::unsupported_format where the one asked for cannot do the job.
inline result<bake_choice> choose_bake_gpu_route(const bake_job& job, const bake_request& part)
{
    const bake_choice chosen{ part.route, reason("as asked for") };
    const bool packable = job.settings.falloff == bake_falloff::none && !job.turned();
    switch (part.route) {
    case bake_route::automatic:
        return choose_bake_route(job, part.last_vertex - part.first_vertex, gpu_bake_costs);
    case bake_route::brute:
    case bake_route::tiled:
    case bake_route::hierarchy:
    case bake_route::cube:
        return chosen;
    case bake_route::packed:
        if (!packable) {
            return error(errc::unsupported_format, "the packed route keeps a bit per direction, of one rule for all vertices: no "
                                                   "fall-off, no rotation per vertex, no rule about the normal");
        }
        return chosen;
    case bake_route::raster:
        if (job.turned()) {
            return error(errc::unsupported_format, "the raster route takes one rule for all vertices: no rotation per vertex, no "
                                                   "rule about the normal");
        }
        return chosen;
    default:
        return error(errc::unsupported_format,
                     "this backend has the bake routes brute, tiled, packed, hierarchy, raster and cube");
    }
}

inline std::size_t rounded_up(std::size_t n, std::size_t to)
{
    return (n + to - 1) / to * to;
}

// Two bits a line: what the routes packed and raster find.
inline constexpr std::size_t bake_lines_in_word = 16;

// What the routes packed and raster keep of some lines at once, and cube of all, for a block of vertices.
struct bake_room {
    std::size_t lines = 0;     // a multiple of bake_lines_in_word
    std::size_t vertices = 0;  // at most
    std::size_t pitch = 0;     // texels of a line
    std::uint32_t columns = 0; // of the raster's grid; texels across a face of a cube map
    std::uint32_t rows = 0;
    std::size_t words = 0; // of all

    std::size_t texels() const { return lines * pitch; }
};

// The cells of the raster's grid. Rows about as high as triangles are, columns finer: measured.
inline void set_cells(bake_room& room)
{
    const double side = std::sqrt(static_cast<double>(room.vertices));
    room.rows = static_cast<std::uint32_t>(std::clamp(side * 0.3, 1.0, 4096.0));
    room.columns = static_cast<std::uint32_t>(std::clamp(side * 2.0, 1.0, 8192.0));
}

// Empty for routes that keep nothing.
inline bake_room bake_room_of(const bake_job& job, const bake_request& part, bake_route route, const bake_gpu_options& options)
{
    constexpr std::size_t most_block_vertices = 65536;
    constexpr std::size_t least_block_vertices = 256;
    const std::size_t scratch = options.scratch;
    bake_room room;
    if (route == bake_route::cube) {
        room.columns = std::clamp(options.cube_texels, 1U, 1024U);
        const std::size_t cube = std::size_t{ 6 } * room.columns * room.columns;
        room.vertices = std::clamp<std::size_t>(scratch / sizeof(std::uint32_t) / cube, 16, 32768); // rows of groups
        room.vertices = std::min(room.vertices, part.last_vertex - part.first_vertex);
        room.words = room.vertices * cube;
        return room;
    }
    if (route != bake_route::packed && route != bake_route::raster) {
        return room;
    }
    const std::size_t points = std::max<std::size_t>(job.mesh.points.size(), 1);
    const bool raster = route == bake_route::raster;
    // A start, and its part of the words.
    constexpr std::size_t sample = sizeof(glm::vec4) + 4;
    room.vertices =
        std::min(part.last_vertex - part.first_vertex,
                 raster ? std::max(scratch / bake_lines_in_word / sample, least_block_vertices) : most_block_vertices);
    room.pitch = points + (raster ? room.vertices : 0);
    const std::size_t fitting = std::max<std::size_t>(scratch / (sizeof(glm::vec4) * room.pitch) / bake_lines_in_word, 1);
    room.lines = std::min(fitting * bake_lines_in_word, rounded_up(part.last_line - part.first_line, bake_lines_in_word));
    room.words = room.vertices * (room.lines / bake_lines_in_word);
    if (raster) {
        set_cells(room);
        const std::size_t cells = static_cast<std::size_t>(room.rows) * room.columns + 1;
        const std::size_t distances = 2 * room.vertices * room.lines;
        room.words = (job.settings.falloff == bake_falloff::none ? room.words : distances) + room.lines * cells;
    }
    return room;
}

// Of this part, all 0.
inline bake_sums empty_bake_sums(const bake_request& part, const bake_choice& choice)
{
    bake_sums sums{ part.first_vertex,
                    part.last_vertex,
                    part.first_line,
                    part.last_line,
                    {},
                    choice.route,
                    std::string(std::string_view(choice.why)) };
    sums.sums.resize(part.last_vertex - part.first_vertex);
    return sums;
}

// Without triangles no vertex has a normal: all sums are 0.
inline bool nothing_to_bake(const bake_job& job, const bake_request& part)
{
    return part.first_vertex == part.last_vertex || part.first_line == part.last_line || job.mesh.triangles.empty();
}

} // namespace detail

} // namespace ao
