#version 450
#extension GL_GOOGLE_include_directive : require
#include "geometry.glsl"

// What the geometry pass reads of a material. Maps are indices into the heap.
struct ao_geometry_material {
    vec2 scale;     // uv is multiplied by it,
    real footprint; // and the footprint by this
    real cutoff;
    uint alpha_map;
    uint alpha_from_red;
    uint normal_map;
    real green;
};

layout(std430, binding = 2) readonly buffer ao_materials_block { ao_geometry_material ao_materials[]; };
layout(std430, binding = 3) readonly buffer ao_heap_block { uint ao_heap[]; };
layout(binding = 0) uniform sampler2D ao_alpha_picture;
layout(binding = 1) uniform sampler2D ao_normal_picture;

uint ao_load_texel(uint index)
{
    return ao_heap[index];
}

#include "ao/shared/texture.h"

layout(location = 0) in vec3 ao_position;
layout(location = 1) in vec3 ao_normal;
layout(location = 2) in vec4 ao_tangent;
layout(location = 3) in vec2 ao_uv;
layout(location = 4) in vec3 ao_previous;
layout(location = 5) flat in uvec3 ao_ids;

layout(location = 0) out vec4 ao_out_position;
layout(location = 1) out vec4 ao_out_normal;
layout(location = 2) out vec2 ao_out_motion;
layout(location = 3) out uvec2 ao_out_ids;
layout(location = 4) out vec4 ao_out_surface;
layout(location = 5) out vec4 ao_out_frame;

struct ao_map_place {
    vec2 uv;
    vec2 along_x;
    vec2 along_y;
    real footprint;
};

ao_map_place ao_placed(ao_map_place p, ao_geometry_material m)
{
    AO_PRECISE vec2 uv = p.uv * m.scale;
    AO_PRECISE vec2 along_x = p.along_x * m.scale;
    AO_PRECISE vec2 along_y = p.along_y * m.scale;
    AO_PRECISE real footprint = p.footprint * m.footprint;
    ao_map_place scaled = { uv, along_x, along_y, footprint };
    return scaled;
}

bool ao_cut(ao_geometry_material m, ao_map_place p)
{
    vec4 texel = ao_hardware_sampling ? textureGrad(ao_alpha_picture, p.uv, p.along_x, p.along_y)
                                      : ao_sample(m.alpha_map, p.uv, p.footprint);
    real alpha = m.alpha_from_red != 0u ? texel.x : texel.w;
    return alpha < m.cutoff;
}

vec3 ao_normal_from_map(ao_geometry_material m, ao_map_place p, real handedness)
{
    vec4 texel = ao_hardware_sampling ? textureGrad(ao_normal_picture, p.uv, p.along_x, p.along_y)
                                      : ao_sample(m.normal_map, p.uv, p.footprint);
    return ao_mapped_normal(ao_normal, vec3(ao_tangent), handedness, vec3(texel), m.green);
}

vec4 ao_encoded_normal(vec3 n)
{
    if (ao_normal_encoding == ao_normal_unorm10) {
        AO_PRECISE vec3 code = n * 0.5 + 0.5;
        return vec4(code, 1.0);
    }
    if (ao_normal_encoding == ao_normal_octahedral) {
        AO_PRECISE vec2 code = ao_octahedral_coordinates(n) * 0.5 + 0.5;
        return vec4(code, 0.0, 0.0);
    }
    return vec4(n, 0.0);
}

void main()
{
    // Derivatives come before anything is discarded.
    ao_map_place place = { vec2(0.0), vec2(0.0), vec2(0.0), 0.0 };
    if (ao_use_uvs) {
        place.uv = ao_uv;
        place.along_x = dFdx(ao_uv);
        place.along_y = dFdy(ao_uv);
        place.footprint = ao_footprint(place.along_x, place.along_y);
    }
    if (ao_use_alpha_map && ao_cut(ao_materials[ao_ids.z], ao_placed(place, ao_materials[ao_ids.z]))) {
        discard;
    }
    real side = gl_FrontFacing ? 1.0 : -1.0;
    real handedness = ao_tangent.w < 0.0 ? -1.0 : 1.0;
    if (ao_write_position) {
        ao_out_position = vec4(ao_position, 1.0);
    }
    if (ao_write_normal) {
        vec3 normal = ao_use_normal_map
                          ? ao_normal_from_map(ao_materials[ao_ids.z], ao_placed(place, ao_materials[ao_ids.z]), handedness)
                          : ao_normalize_or(ao_normal, vec3(0.0, 0.0, 1.0));
        ao_out_normal = ao_encoded_normal(ao_facing_normal(normal, side));
    }
    if (ao_write_motion) {
        vec2 before = ao_to_pixel(ao_previous_projection, ao_previous, ao_previous_parallel != 0u);
        ao_out_motion = before - vec2(gl_FragCoord);
    }
    if (ao_write_ids) {
        ao_out_ids = uvec2(ao_ids);
    }
    if (ao_write_surface) {
        ao_out_surface = vec4(place.uv, place.footprint, side);
    }
    if (ao_write_frame) {
        ao_out_frame = ao_fill_frame ? ao_packed_frame(ao_normal, vec3(ao_tangent), handedness) : vec4(0.0);
    }
}
