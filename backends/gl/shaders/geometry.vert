#version 450
#extension GL_GOOGLE_include_directive : require
#include "geometry.glsl"

layout(std140, binding = 0) uniform ao_camera_block { ao_geometry_camera ao_camera; };
layout(std430, binding = 0) readonly buffer ao_instances_block { ao_geometry_instance ao_instances[]; };
layout(std430, binding = 1) readonly buffer ao_previous_block { ao_affine_map ao_previous_models[]; };

layout(location = 0) in vec3 ao_position;
layout(location = 1) in vec3 ao_normal;
layout(location = 2) in vec4 ao_tangent;
layout(location = 3) in vec2 ao_uv;
layout(location = 4) in vec3 ao_previous_position;
layout(location = 5) in uint ao_slot;

layout(location = 0) out vec3 ao_out_position;
layout(location = 1) out vec3 ao_out_normal;
layout(location = 2) out vec4 ao_out_tangent;
layout(location = 3) out vec2 ao_out_uv;
layout(location = 4) out vec3 ao_out_previous;
layout(location = 5) flat out uvec3 ao_out_ids;

void main()
{
    ao_affine_map model = ao_instances[ao_slot].model;
    precise vec3 position = ao_vertex_position(ao_camera.view, model, ao_position);
    gl_Position = ao_vertex_clip(ao_camera.clip, ao_camera.clip_w, position);
    if (ao_write_position) {
        ao_out_position = position;
    }
    if (ao_write_normal || ao_fill_frame) {
        ao_out_normal = ao_vertex_normal(ao_camera.view, model, ao_normal);
    }
    if (ao_use_normal_map || ao_fill_frame) {
        ao_out_tangent = ao_vertex_tangent(ao_camera.view, ao_instances[ao_slot], ao_tangent);
    }
    if (ao_use_uvs) {
        ao_out_uv = ao_uv;
    }
    if (ao_write_motion) {
        vec3 before = ao_deforming ? ao_previous_position : ao_position;
        ao_out_previous = ao_vertex_position(ao_camera.previous_view, ao_previous_models[ao_slot], before);
    }
    if (ao_write_ids || ao_use_alpha_map || ao_use_normal_map) {
        ao_out_ids = uvec3(ao_instances[ao_slot].object, ao_instances[ao_slot].code, ao_instances[ao_slot].leaf);
    }
}
