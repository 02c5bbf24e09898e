// What a bake works in: the job's mesh with coordinates apart, and the memory of each thread.
#pragma once

#include "bake_kernels.hpp"

#include "ao/bake.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ao::cpu::detail {

struct bake_vector_arrays {
    std::vector<float> x;
    std::vector<float> y;
    std::vector<float> z;

    void push_back(const glm::vec3& v)
    {
        x.push_back(v.x);
        y.push_back(v.y);
        z.push_back(v.z);
    }
    void pad()
    {
        for (std::size_t i = 0; i < bake_padding; ++i) {
            push_back(glm::vec3(0.0F));
        }
    }
    bake_vectors view() const { return { x.data(), y.data(), z.data() }; }
};

// Receivers that share their occluders: all, or those of one object.
struct bake_group {
    std::vector<std::uint32_t> vertices; // of the job, that the receivers are
    bake_vector_arrays starts;
    bake_vector_arrays normals;
    bake_vector_arrays points;
    std::vector<std::int32_t> corners[3];
    // bake_closed.hpp: 1 for triangles of closed surfaces, and the receivers that must meet all triangles even so.
    std::vector<std::int32_t> closed;
    std::vector<std::uint32_t> apart;
    bake_vector_arrays places[3]; // of the corners
    bake_tree own_tree;           // of these triangles, where they are not the mesh's
    const bake_node* nodes = nullptr;
    bake_task task;
};

// Baked vertices first ... last - 1 of the job with this object, or with any; near ones near in memory.
// `tree`: it is needed.
bake_group make_bake_group(const bake_job& job, std::size_t first, std::size_t last, const std::uint32_t* object, bool tree);

// What the raster needs besides.
void add_corner_places(bake_group& group);

// The objects whose vertices must be baked apart; empty: none.
std::vector<std::uint32_t> separate_objects(const bake_job& job);

// Of a thread that takes lines.
class bake_line_memory {
public:
    bake_line_memory(const bake_task& task, bool raster);

    bake_raster_memory raster;
    bake_brute_memory brute;
    bake_view views[2];
    bake_totals totals;
    std::vector<bake_second> seconds;
    std::size_t second_count = 0;

private:
    float* floats(std::size_t count);
    std::int32_t* words(std::size_t count);
    std::vector<std::vector<float>> float_arrays_;
    std::vector<std::vector<std::int32_t>> word_arrays_;
    std::vector<std::uint64_t> hit_;
};

} // namespace ao::cpu::detail
