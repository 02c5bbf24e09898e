// What a model and its targets hold.
#pragma once

#include "ao/cpu/rasterizer.hpp"
#include "ao/drawing.hpp"
#include "ao/mesh_arrays.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ao::cpu {

// Triangles of a mesh in a row, with vertices that are transformed once for all of them.
struct triangle_cluster {
    static constexpr int most_triangles = 256;
    static constexpr int most_vertices = 3 * most_triangles;

    std::uint32_t first_index = 0; // of mesh_arrays::indices, and of raster_model_state::local_indices
    std::uint32_t index_count = 0;
    std::uint32_t first_vertex = 0; // of raster_model_state::cluster_vertices
    std::uint32_t vertex_count = 0;
    glm::vec3 low{ 0.0F }; // of the vertices, object space
    glm::vec3 high{ 0.0F };
};

struct cluster_range {
    std::uint32_t first = 0;
    std::uint32_t last = 0; // not included
};

// A draw of the plan, by slot.
struct raster_object {
    geometry_instance instance;
    std::uint32_t mesh = 0;
    std::uint32_t variant = 0;
};

// The clusters of all draws in the plan's order are cut into batches, which are worked on side by side.
struct batch_start {
    std::uint32_t slot = 0;
    std::uint32_t cluster = 0; // of the slot's mesh, counted from its first
};

struct raster_model_state {
    gbuffer_facts facts;
    std::vector<draw_variant> variants;
    std::vector<drawn_object> drawn;
    std::size_t scene_objects = 0;
    std::vector<raster_object> objects;
    std::vector<affine_map> previous_models; // for motion
    std::vector<drawn_material> materials;
    std::vector<std::uint32_t> heap;
    mesh_arrays arrays;
    std::vector<std::uint16_t> local_indices;    // vertices counted from their cluster's first
    std::vector<std::uint32_t> cluster_vertices; // of mesh_arrays, base vertex included
    std::vector<triangle_cluster> clusters;
    std::vector<cluster_range> mesh_clusters;
    std::vector<batch_start> batches; // one more than there are

    // Vertex `corner` of the triangle whose first index is `index`.
    std::uint32_t vertex(const raster_object& o, std::uint32_t index, std::uint32_t corner) const
    {
        return arrays.indices[index + corner] + static_cast<std::uint32_t>(arrays.meshes[o.mesh].base_vertex);
    }
    template <class Vector>
    Vector attribute(vertex_attribute which, std::uint32_t vertex) const
    {
        Vector v;
        const float* first = arrays.streams[which].data() + static_cast<std::size_t>(vertex) * Vector::length();
        for (int i = 0; i < Vector::length(); ++i) {
            v[i] = first[i];
        }
        return v;
    }
};

// A triangle, or a piece of a clipped one, that covers a pixel at least.
struct raster_triangle {
    // 1/256 pixel, multiples of 256 at pixel centres; clockwise where rows run downwards: the area is positive.
    std::array<std::int32_t, 3> x;
    std::array<std::int32_t, 3> y;
    // The depth key at pixel (x, y) is depth_x * x + (depth_y * y + depth_0), but within the limits. Keys are depths, negative
    // where greater depths are closer, so that less is closer.
    double depth_x;
    double depth_y;
    double depth_0;
    float least;
    float greatest;
    std::uint32_t slot;
    std::uint32_t first_index;
    bool front;
    bool clipped;
};

// A batch's triangles and which of them each tile shows, in order.
struct triangle_bins {
    std::vector<raster_triangle> triangles;
    std::vector<std::uint32_t> tiles; // with a triangle each, in `owners`
    std::vector<std::uint32_t> owners;
    std::vector<std::uint32_t> starts; // by tile, and one more: into `sorted`
    std::vector<std::uint32_t> sorted; // triangles
};

struct tile_grid {
    int width = 0; // of a tile, pixels
    int height = 0;
    int columns = 0;
    int rows = 0;

    int count() const { return columns * rows; }
};

// What is nearest so far at the pixels of a tile.
struct tile_memory {
    std::vector<float> keys;
    std::vector<const raster_triangle*> triangles;
};

struct raster_targets_state {
    gbuffer_images<image_view> images;
    tile_grid grid;
    std::vector<triangle_bins> bins;  // by batch
    std::vector<tile_memory> scratch; // by thread
};

} // namespace ao::cpu
