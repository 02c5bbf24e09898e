// What models and targets of the rasterizer hold.
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/gl/options.hpp"
#include "ao/math.hpp"
#include "object.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ao::gl {

using raster_math = math<float>;

// Vertex attributes by location; bit i of a mask is attribute i.
enum attribute : unsigned {
    position_attribute,
    normal_attribute,
    tangent_attribute,
    uv_attribute,
    previous_attribute,
    slot_attribute
};
inline constexpr std::size_t attribute_count = 6;

inline constexpr std::size_t target_count = 6; // color attachments by location: position, normal, motion, ids, surface, frame

// Buffers of shaders/geometry.*
struct instance {
    raster_math::ao_affine_map model;
    std::uint32_t object;
    std::uint32_t code;
    std::uint32_t leaf;
    float handed;
};
static_assert(sizeof(instance) == 64);

struct geometry_material {
    glm::vec2 scale;
    float footprint;
    float cutoff;
    std::uint32_t alpha_map;
    std::uint32_t alpha_from_red;
    std::uint32_t normal_map;
    float green;
};
static_assert(sizeof(geometry_material) == 32);

struct camera_block {
    raster_math::ao_affine_map view;
    raster_math::ao_affine_map clip;
    glm::vec4 clip_w;
    raster_math::ao_affine_map previous_view;
    raster_math::ao_projection previous_projection;
    std::uint32_t previous_parallel;
    std::array<std::uint32_t, 3> reserved;
};
static_assert(sizeof(camera_block) == 208);

struct indirect_draw {
    GLuint count;
    GLuint instances;
    GLuint first_index;
    GLint base_vertex;
    GLuint first_slot;
};
static_assert(sizeof(indirect_draw) == 20);

// What an object's instance is made of, beside its matrices.
struct drawn_object {
    int object = 0; // of the scene
    int leaf = 0;   // the material that gives the geometry its maps
    bool mirrored = false;
};

// Draws alike in program and state.
struct draw_batch {
    std::size_t variant = 0;
    std::size_t first = 0; // of the indirect draws
    std::size_t count = 0;
    GLuint alpha_map = 0; // textures, with the driver's sampler
    GLuint normal_map = 0;
};

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
    std::vector<drawn_object> objects; // by slot
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

inline raster_math::ao_affine_map affine_map(const matrix4& m)
{
    const auto row = [&](int i) { return glm::vec4(m[0][i], m[1][i], m[2][i], m[3][i]); };
    return { row(0), row(1), row(2) };
}

// Whether any material map is read.
inline bool samples(const draw_variant& v)
{
    return v.alpha_map || v.normal_map;
}

// Fills programs and pipelines, whose vertex arrays have no buffers yet.
std::optional<error> make_pipelines(const functions& gl, const raster_options& chosen, const draw_plan& p,
                                    raster_model_state& into);

} // namespace ao::gl
