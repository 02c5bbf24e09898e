// Resources and options of the shading passes.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 0) const bool ao_stored_position = false;
layout(constant_id = 1) const bool ao_parallel = false;
layout(constant_id = 2) const int ao_normal_source = 0;
layout(constant_id = 3) const bool ao_use_visibility = false;
layout(constant_id = 4) const bool ao_use_maps = false;
layout(constant_id = 5) const bool ao_use_reflections = false;
layout(constant_id = 6) const bool ao_use_frames = false;
layout(constant_id = 7) const bool ao_use_blends = false;
layout(constant_id = 11) const bool ao_use_bent_normal = false;
layout(constant_id = 12) const bool ao_use_bounces = false;
layout(constant_id = 8) const bool ao_visibility_in_codes = false; // r8

layout(binding = 0) uniform sampler2D ao_geometry_picture;
layout(binding = 1) uniform sampler2D ao_normal_picture;
layout(binding = 2) uniform usampler2D ao_ids_picture;
layout(binding = 3) uniform sampler2D ao_surface_picture;
layout(binding = 4) uniform sampler2D ao_frame_picture;
layout(binding = 5) uniform sampler2D ao_visibility_picture;
layout(binding = 1, rgba32f) uniform image2DArray ao_targets;
layout(std430, binding = 0) readonly buffer ao_table_block { uint ao_table[]; };
layout(std430, binding = 1) readonly buffer ao_heap_block { uint ao_heap[]; };
layout(std430, binding = 2) buffer ao_statistics_block { uint ao_clamped; };

vec4 ao_load_geometry(ivec2 pixel)
{
    return texelFetch(ao_geometry_picture, pixel, 0);
}

vec4 ao_load_normal(ivec2 pixel)
{
    return texelFetch(ao_normal_picture, pixel, 0);
}

uvec2 ao_load_ids(ivec2 pixel)
{
    return uvec2(texelFetch(ao_ids_picture, pixel, 0));
}

vec4 ao_load_surface(ivec2 pixel)
{
    return texelFetch(ao_surface_picture, pixel, 0);
}

vec4 ao_load_frame(ivec2 pixel)
{
    return texelFetch(ao_frame_picture, pixel, 0);
}

real ao_load_visibility(ivec2 pixel)
{
    real stored = texelFetch(ao_visibility_picture, pixel, 0).x;
    if (ao_visibility_in_codes) {
        return ao_unorm_value(stored, 255.0);
    }
    return stored;
}

vec3 ao_load_bent_normal(ivec2 pixel)
{
    vec4 texel = texelFetch(ao_visibility_picture, pixel, 0);
    return vec3(texel.y, texel.z, texel.w);
}

vec4 ao_load_target(int target, ivec2 pixel)
{
    return imageLoad(ao_targets, ivec3(pixel, target));
}

uint ao_load_word(uint index)
{
    return ao_table[index];
}

uint ao_load_texel(uint index)
{
    return ao_heap[index];
}

void ao_count_clamped(uint count)
{
    atomicAdd(ao_clamped, count);
}

#include "ao/shared/texture.h"
#include "ao/shared/shade_tables.h"
#include "ao/shared/shade_pass.h"

layout(std140, binding = 0) uniform ao_constants_block
{
    ao_shade_constants ao_constants;
    int ao_output; // a layer of ao_targets, or -1: ao_picture
};
