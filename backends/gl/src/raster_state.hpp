// What models and targets of the rasterizer hold.
#pragma once

#include "ao/drawing.hpp"
#include "ao/gl/options.hpp"
#include "object.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ao::gl {

// Vertex attributes by location: those of mesh_arrays, and the slot of the instance.
inline constexpr unsigned slot_attribute = vertex_attribute_count;
inline constexpr std::size_t attribute_count = vertex_attribute_count + 1;

inline constexpr std::size_t target_count = 6; // color attachments by location: position, normal, motion, ids, surface, frame

struct raster_pipeline {
    draw_variant variant;
    std::size_t program = 0;
    object vertex_array;
};

struct raster_model_state {
    gbuffer_facts facts;
    std::vector<object> programs;
    std::vector<raster_pipeline> pipelines; // by variant
    std::vector<draw_batch> batches;
    std::vector<std::array<GLuint, 2>> maps; // by batch, with the driver's sampler: alpha and normal map, each 0 if not read
    std::vector<drawn_object> objects;       // by slot
    std::size_t scene_objects = 0;
    std::array<object, attribute_count> attributes;
    object indices;
    object instances;
    object previous; // for motion
    object materials;
    object heap;
    object draws;
    object camera;
    std::vector<object> textures; // with the driver's sampler
    bool samples = false;         // some variant reads maps
};

struct raster_targets_state {
    object framebuffer;
};

// Fills programs and pipelines, whose vertex arrays have no buffers yet.
std::optional<error> make_pipelines(const functions& gl, const raster_options& chosen, const draw_plan& p,
                                    raster_model_state& into);

} // namespace ao::gl
