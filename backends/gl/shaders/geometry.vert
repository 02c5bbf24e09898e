#version 450
#extension GL_GOOGLE_include_directive : require
#include "geometry.glsl"

struct ao_instance {
    ao_affine_map model;
    uint object; // object + 1
    uint code;   // object::material + 1
    uint leaf;   // of ao_materials
    real handed; // -1 where the model matrix mirrors, else +1
};

layout(std430, binding = 0) readonly buffer ao_instances_block { ao_instance ao_instances[]; };
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
    vec3 position = ao_transform_point(ao_view, ao_transform_point(model, ao_position));
    precise real w = ao_clip_w.z * position.z + ao_clip_w.w;
    gl_Position = vec4(ao_transform_point(ao_clip, position), w);
    if (ao_write_position) {
        ao_out_position = position;
    }
    if (ao_write_normal || ao_fill_frame) {
        ao_out_normal = ao_transform_direction(ao_view, ao_transform_normal(model, ao_normal));
    }
    if (ao_use_normal_map || ao_fill_frame) {
        vec3 tangent = ao_transform_direction(ao_view, ao_transform_direction(model, vec3(ao_tangent)));
        ao_out_tangent = vec4(tangent, ao_tangent.w * ao_instances[ao_slot].handed);
    }
    if (ao_use_uvs) {
        ao_out_uv = ao_uv;
    }
    if (ao_write_motion) {
        vec3 before = ao_deforming ? ao_previous_position : ao_position;
        ao_out_previous = ao_transform_point(ao_previous_view, ao_transform_point(ao_previous_models[ao_slot], before));
    }
    if (ao_write_ids || ao_use_alpha_map || ao_use_normal_map) {
        ao_out_ids = uvec3(ao_instances[ao_slot].object, ao_instances[ao_slot].code, ao_instances[ao_slot].leaf);
    }
}
