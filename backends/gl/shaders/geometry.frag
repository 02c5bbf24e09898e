#version 450
#extension GL_GOOGLE_include_directive : require
#include "geometry.glsl"

layout(std140, binding = 0) uniform ao_camera_block { ao_geometry_camera ao_camera; };
layout(std430, binding = 2) readonly buffer ao_materials_block { ao_geometry_material ao_materials[]; };
layout(std430, binding = 3) readonly buffer ao_heap_block { uint ao_heap[]; };
layout(binding = 0) uniform sampler2D ao_alpha_picture;
layout(binding = 1) uniform sampler2D ao_normal_picture;

layout(location = 0) in vec3 ao_position;
layout(location = 1) in vec3 ao_normal;
layout(location = 2) in vec4 ao_tangent;
layout(location = 3) in vec2 ao_uv;
layout(location = 4) in vec3 ao_previous;
layout(location = 5) flat in uvec3 ao_ids;

layout(location = 0) out vec4 ao_out_position;
layout(location = 1) out vec4 ao_out_normal;
layout(location = 2) out vec4 ao_out_motion;
layout(location = 3) out uvec2 ao_out_ids;
layout(location = 4) out vec4 ao_out_surface;
layout(location = 5) out vec4 ao_out_frame;

uint ao_load_texel(uint index)
{
    return ao_heap[index];
}

ao_geometry_material ao_load_material(uint index)
{
    return ao_materials[index];
}

#include "ao/shared/texture.h"

vec4 ao_load_alpha_map(ao_geometry_material m, ao_map_place p)
{
    return ao_hardware_sampling ? textureGrad(ao_alpha_picture, p.uv, p.along_x, p.along_y)
                                : ao_sample(m.alpha_map, p.uv, p.footprint);
}

vec4 ao_load_normal_map(ao_geometry_material m, ao_map_place p)
{
    return ao_hardware_sampling ? textureGrad(ao_normal_picture, p.uv, p.along_x, p.along_y)
                                : ao_sample(m.normal_map, p.uv, p.footprint);
}

#include "ao/shared/geometry_pass.h"

void main()
{
    // Derivatives come before anything is discarded.
    ao_map_place place = ao_place_of(vec2(0.0), vec2(0.0), vec2(0.0));
    if (ao_use_uvs) {
        place = ao_place_of(ao_uv, dFdx(ao_uv), dFdy(ao_uv));
    }
    if (ao_geometry_cut(ao_ids.z, place)) {
        discard;
    }
    real side = gl_FrontFacing ? 1.0 : -1.0;
    if (ao_write_position) {
        ao_out_position = vec4(ao_position, 1.0);
    }
    if (ao_write_normal) {
        ao_out_normal = ao_geometry_normal(ao_ids.z, place, ao_normal, ao_tangent, side);
    }
    if (ao_write_motion) {
        ao_out_motion = ao_geometry_motion(ao_camera, ao_previous, vec2(gl_FragCoord));
    }
    if (ao_write_ids) {
        ao_out_ids = uvec2(ao_ids);
    }
    if (ao_write_surface) {
        ao_out_surface = ao_geometry_surface(place, side);
    }
    if (ao_write_frame) {
        ao_out_frame = ao_fill_frame ? ao_geometry_frame(ao_normal, ao_tangent) : vec4(0.0);
    }
}
