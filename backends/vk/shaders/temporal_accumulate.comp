#version 450
#extension GL_GOOGLE_include_directive : require
#include "temporal.glsl"
#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_tap.h"
#include "ao/shared/temporal_reads.glsl"
#include "ao/shared/slice_taps.h"
#include "ao/shared/temporal_pass.h"

layout(binding = 7, std140) uniform pass_constants { ao_temporal_constants constants; };
layout(binding = 10, std430) writeonly buffer written_block { uint written[]; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (in_picture(pixel, constants.width, constants.height)) {
        uvec4 words = ao_packed_history(ao_accumulate_pass(constants, pixel), ao_history_format);
        uint place = ao_history_place(pixel, constants.width) * uint(ao_history_words(ao_history_format));
        written[place] = words.x;
        written[place + 1] = words.y;
        if (ao_history_words(ao_history_format) == 4) {
            written[place + 2] = words.z;
            written[place + 3] = words.w;
        }
    }
}
