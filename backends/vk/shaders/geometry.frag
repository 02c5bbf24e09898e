#version 450
#extension GL_GOOGLE_include_directive : require
#include "geometry.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec3 previous;
layout(location = 5) flat in uvec3 ids;

layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_motion;
layout(location = 3) out uvec2 out_ids;
layout(location = 4) out vec4 out_surface;
layout(location = 5) out vec4 out_frame;

layout(binding = 3, std430) readonly buffer materials_block { ao_geometry_material materials[]; };

ao_geometry_material ao_load_material(uint index) { return materials[index]; }

#ifdef AO_HARDWARE
layout(set = 1, binding = 0) uniform sampler2D alpha_picture;
layout(set = 1, binding = 1) uniform sampler2D normal_picture;

vec4 ao_load_alpha_map(ao_geometry_material m, ao_map_place p)
{
    return textureGrad(alpha_picture, p.uv, p.along_x, p.along_y);
}
vec4 ao_load_normal_map(ao_geometry_material m, ao_map_place p)
{
    return textureGrad(normal_picture, p.uv, p.along_x, p.along_y);
}
#else
layout(binding = 4, std430) readonly buffer heap_block { uint heap[]; };

uint ao_load_texel(uint index) { return heap[index]; }

#include "ao/shared/texture.h"

vec4 ao_load_alpha_map(ao_geometry_material m, ao_map_place p) { return ao_sample(m.alpha_map, p.uv, p.footprint); }
vec4 ao_load_normal_map(ao_geometry_material m, ao_map_place p) { return ao_sample(m.normal_map, p.uv, p.footprint); }
#endif

#include "ao/shared/geometry_pass.h"

void main()
{
    // Derivatives come before anything is discarded.
    ao_map_place place = ao_place_of(vec2(0.0), vec2(0.0), vec2(0.0));
    if (use_uvs) {
        place = ao_place_of(uv, dFdx(uv), dFdy(uv));
    }
    if (ao_geometry_cut(ids.z, place)) {
        discard;
    }
    real side = gl_FrontFacing ? 1.0 : -1.0;
    if (write_position) {
        out_position = vec4(position, 1.0);
    }
    if (write_normal) {
        out_normal = ao_geometry_normal(ids.z, place, normal, tangent, side);
    }
    if (write_motion) {
        out_motion = ao_geometry_motion(camera, previous, vec2(gl_FragCoord));
    }
    if (write_ids) {
        out_ids = uvec2(ids);
    }
    if (write_surface) {
        out_surface = ao_geometry_surface(place, side);
    }
    if (write_frame) {
        out_frame = fill_frame ? ao_geometry_frame(normal, tangent) : vec4(0.0);
    }
}
