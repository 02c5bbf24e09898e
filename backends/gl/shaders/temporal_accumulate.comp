#version 450
#extension GL_GOOGLE_include_directive : require
#include "temporal.glsl"

layout(constant_id = 0) const int ao_most_samples = 32;
layout(constant_id = 1) const int ao_contribution = 0;
layout(constant_id = 3) const int ao_invalidation = 0;
layout(constant_id = 4) const bool ao_reproject = false;
layout(constant_id = 5) const bool ao_use_motion = false;
layout(constant_id = 6) const bool ao_cubic = false;
layout(constant_id = 7) const int ao_normal_source = 0;
layout(constant_id = 8) const bool ao_rotate_normals = false;
layout(constant_id = 10) const bool ao_limit_thickness = false;
layout(constant_id = 13) const int ao_slice_taps = 1;

layout(binding = 1) uniform sampler2D ao_normals;
layout(binding = 2) uniform sampler2D ao_motions;
layout(binding = 3) uniform sampler2D ao_rotations;
layout(std430, binding = 0) writeonly buffer ao_written_block { uint ao_history_words_written[]; };
layout(binding = 5) uniform samplerBuffer ao_taps;

vec4 ao_load_normal(ivec2 pixel)
{
    return texelFetch(ao_normals, pixel, 0);
}

vec4 ao_load_motion(ivec2 pixel)
{
    return texelFetch(ao_motions, pixel, 0);
}

vec2 ao_load_rotation(ivec2 texel)
{
    return vec2(texelFetch(ao_rotations, texel, 0));
}

vec4 ao_load_tap(uint index)
{
    return texelFetch(ao_taps, int(index));
}

#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_tap.h"
#include "ao/shared/temporal_reads.glsl"
#include "ao/shared/slice_taps.h"
#include "ao/shared/temporal_pass.h"

layout(std140, binding = 0) uniform ao_constants_block { ao_temporal_constants ao_constants; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID);
    if (pixel.x < int(ao_constants.width) && pixel.y < int(ao_constants.height)) {
        uvec4 words = ao_packed_history(ao_accumulate_pass(ao_constants, pixel), ao_history_format);
        uint at = ao_history_place(pixel, ao_constants.width) * uint(ao_history_words(ao_history_format));
        ao_history_words_written[at] = words.x;
        ao_history_words_written[at + 1] = words.y;
        if (ao_history_words(ao_history_format) == 4) {
            ao_history_words_written[at + 2] = words.z;
            ao_history_words_written[at + 3] = words.w;
        }
    }
}
