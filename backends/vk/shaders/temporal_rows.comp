#version 450
#extension GL_GOOGLE_include_directive : require
#include "temporal.glsl"
#include "ao/shared/temporal_filter_pass.h"

layout(binding = 4, r32f) uniform writeonly image2D target;
layout(push_constant) uniform pass_constants { ao_temporal_filter_constants constants; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (in_picture(pixel, constants.width, constants.height)) {
        imageStore(target, pixel, vec4(ao_temporal_rows_pass(constants, pixel)));
    }
}
