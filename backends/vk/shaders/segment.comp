#version 450
#extension GL_GOOGLE_include_directive : require
#include "shading.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!in_picture(pixel)) {
        return;
    }
    vec4 color = ao_segment_pass(constants, pixel);
    if (color.w >= 0.0) {
        if (constants.reserved < 0.0) {
            imageStore(color_picture, pixel, color);
        }
        else {
            imageStore(targets, ivec3(pixel, int(constants.reserved)), color);
        }
    }
}
