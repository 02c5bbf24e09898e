// What a compiled set of kernels for ambient occlusion per vertex offers: plain data and function pointers, as kernels.hpp.
#pragma once

#include "ao/bake.hpp"

#include <cstddef>
#include <cstdint>

namespace ao::cpu::detail {

// Everything below has room for this many more entries than it counts, which kernels may read and write.
inline constexpr std::size_t bake_padding = 16;

// Coordinates apart.
struct bake_vectors {
    const float* x = nullptr;
    const float* y = nullptr;
    const float* z = nullptr;
};

// As a line sees points.
struct bake_seen {
    float* u = nullptr;
    float* w = nullptr;
    float* d = nullptr;
};

// What rays may meet.
struct bake_occluder_arrays {
    bake_vectors points;
    std::size_t point_count = 0;
    const std::int32_t* corners[3] = {}; // points of each triangle
    bake_vectors places[3];              // of these points, where the raster needs them
    std::size_t triangle_count = 0;
    const std::int32_t* closed = nullptr; // 1: of a closed surface (bake_closed.hpp); null: none is
};

// What sends rays: the vertices that are baked.
struct bake_receiver_arrays {
    bake_vectors starts;
    bake_vectors normals;
    std::size_t count = 0;
};

struct bake_options {
    float reach = 0;
    bool limited = false; // some distance within the mesh is beyond reach
    int falloff = 0;
    bool front = false;
    bool by_cosine = false;
    bool bent = false;
    bool ground = false;
    float ground_plane[4] = {};
};

// Where every hit is as good as any other, however far.
inline bool is_plain(const bake_options& o)
{
    return !o.limited && !o.front && o.falloff == 0;
}

struct bake_task {
    bake_occluder_arrays occluders;
    bake_receiver_arrays receivers;
    bake_options options;
};

// Visibility of every receiver along a line, on the side of its normal. Receivers whose normal is across the line have a second
// direction, whose visibility is kept apart.
struct bake_view {
    float* open = nullptr;
    float* cosine = nullptr; // of the line's d to the normal
};

struct bake_second {
    std::uint32_t receiver;
    float open;
};

// Sums of all receivers, bake_sum with its parts apart.
struct bake_totals {
    std::int32_t* parts[7] = {}; // open, all, changes, count, x, y, z
};

// Samples whose verdict only all triangles can tell (bake_raster_memory::doubtful).
inline constexpr std::size_t bake_most_doubtful = 64;

// Memory of a thread for bake_kernel_table::raster.
struct bake_raster_memory {
    bake_seen starts;
    float* toward = nullptr;           // depth of the starts along the direction they look in
    bake_seen samples;                 // sorted by groups (bake_raster_grid.hpp), then by cells
    std::int32_t* receivers = nullptr; // of the samples; -1 - i: of seconds[i]
    std::int32_t* cells = nullptr;     // of the starts
    std::int32_t* tiles = nullptr;
    std::int32_t* first = nullptr; // sample of each cell, of all groups
    float* tile_depths = nullptr;
    std::int32_t doubtful[bake_most_doubtful] = {};
    std::size_t doubtful_count = 0; // may be greater than there is room for
    int lines = 0;                  // done, while only entered triangles were looked at
    int repeated = 0;               // of these, with all triangles
    std::uint64_t* hit = nullptr;   // a bit per sample
    float* distances = nullptr;     // of the samples, where there is a fall-off
    bake_second* seconds = nullptr;
    std::size_t second_count = 0;
    int rows = 0;
    int columns = 0;
    int tiles_across = 1; // and down
};

// Memory of a thread for bake_kernel_table::brute: the triangles as a line sees them, nine arrays.
struct bake_brute_memory {
    bake_seen points;
    float* corners[9] = {};
};

// What rays are traced through, and the lines they follow, the parts of bake_line apart. Padding has weight 0.
struct bake_ray_task {
    const bake_node* nodes = nullptr; // triangles are the task's
    const float* lines[11] = {};
    const float* turn = nullptr; // rows of the receiver's rotation; null: none
};

struct bake_kernel_table {
    // Fills the view, and memory.seconds.
    void (*raster)(const bake_task&, const bake_line&, bake_raster_memory&, const bake_view&);
    // The same by every triangle for every receiver first ... last - 1.
    void (*brute)(const bake_task&, const bake_line&, bake_brute_memory&, const bake_view&, std::size_t first, std::size_t last,
                  bake_second* seconds, std::size_t& second_count);
    // Adds a line, or two that are neighbours, to receivers first ... last - 1.
    void (*add)(const bake_task&, const bake_line* lines, const bake_view* views, int count, const bake_totals&,
                std::size_t first, std::size_t last);
    // Fills view and seconds (where a line's cosine is 0) with lines first ... last - 1 of one receiver.
    void (*trace)(const bake_task&, const bake_ray_task&, std::size_t receiver, std::size_t first, std::size_t last,
                  const bake_view&, float* seconds);
};

const bake_kernel_table& bake_scalar_kernels();
const bake_kernel_table& bake_lanes4_kernels();
const bake_kernel_table& bake_lanes8_kernels();
const bake_kernel_table& bake_lanes16_kernels();

} // namespace ao::cpu::detail
