#version 450
#extension GL_GOOGLE_include_directive : require
#include "geometry.glsl"

layout(binding = 1, std430) readonly buffer instances_block { ao_geometry_instance instances[]; };
layout(binding = 2, std430) readonly buffer previous_block { ao_affine_map previous_models[]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec3 previous_position;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec2 out_uv;
layout(location = 4) out vec3 out_previous;
layout(location = 5) flat out uvec3 out_ids;

void main()
{
    int slot = gl_InstanceIndex;
    ao_affine_map model = instances[slot].model;
    precise vec3 seen = ao_vertex_position(camera.view, model, position);
    gl_Position = ao_vertex_clip(camera.clip, camera.clip_w, seen);
    if (write_position) {
        out_position = seen;
    }
    if (write_normal || fill_frame) {
        out_normal = ao_vertex_normal(camera.view, model, normal);
    }
    if (ao_use_normal_map || fill_frame) {
        out_tangent = ao_vertex_tangent(camera.view, instances[slot], tangent);
    }
    if (use_uvs) {
        out_uv = uv;
    }
    if (write_motion) {
        vec3 before = deforming ? previous_position : position;
        out_previous = ao_vertex_position(camera.previous_view, previous_models[slot], before);
    }
    if (write_ids || ao_use_alpha_map || ao_use_normal_map) {
        out_ids = uvec3(instances[slot].object, instances[slot].code, instances[slot].leaf);
    }
}
