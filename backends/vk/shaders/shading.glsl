// Resources and options of the shading passes.
#extension GL_EXT_samplerless_texture_functions : require
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(local_size_x_id = 9, local_size_y_id = 10) in;

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
layout(constant_id = 8) const bool visibility_in_codes = false; // r8

layout(binding = 0) uniform texture2D geometry_picture;
layout(binding = 1) uniform texture2D normal_picture;
layout(binding = 2) uniform utexture2D ids_picture;
layout(binding = 3) uniform texture2D surface_picture;
layout(binding = 4) uniform texture2D frame_picture;
layout(binding = 5) uniform texture2D visibility_picture;
layout(binding = 6, rgba32f) uniform writeonly image2D color_picture;
layout(binding = 7, rgba32f) uniform image2DArray targets;
layout(binding = 8, std430) readonly buffer table_block { uint table[]; };
layout(binding = 9, std430) readonly buffer heap_block { uint heap[]; };
layout(binding = 10, std430) buffer statistics_block { uint clamped; };

vec4 ao_load_geometry(ivec2 pixel) { return texelFetch(geometry_picture, pixel, 0); }
vec4 ao_load_normal(ivec2 pixel) { return texelFetch(normal_picture, pixel, 0); }
uvec2 ao_load_ids(ivec2 pixel) { return texelFetch(ids_picture, pixel, 0).xy; }
vec4 ao_load_surface(ivec2 pixel) { return texelFetch(surface_picture, pixel, 0); }
vec4 ao_load_frame(ivec2 pixel) { return texelFetch(frame_picture, pixel, 0); }
real ao_load_visibility(ivec2 pixel)
{
    real stored = texelFetch(visibility_picture, pixel, 0).x;
    if (visibility_in_codes) {
        return ao_unorm_value(stored, 255.0);
    }
    return stored;
}
vec3 ao_load_bent_normal(ivec2 pixel) { return texelFetch(visibility_picture, pixel, 0).yzw; }
vec4 ao_load_target(int target, ivec2 pixel) { return imageLoad(targets, ivec3(pixel, target)); }
uint ao_load_word(uint index) { return table[index]; }
uint ao_load_texel(uint index) { return heap[index]; }
void ao_count_clamped(uint count) { atomicAdd(clamped, count); }

#include "ao/shared/texture.h"
#include "ao/shared/shade_tables.h"
#include "ao/shared/shade_pass.h"

// `reserved` carries the pass's output: a layer of `targets`, or -1 for the color.
layout(push_constant) uniform pass_constants { ao_shade_constants constants; };

bool in_picture(ivec2 pixel) { return all(lessThan(pixel, imageSize(color_picture))); }
