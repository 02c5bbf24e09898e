#version 450
#extension GL_GOOGLE_include_directive : require
#include "shading.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (in_picture(pixel)) {
        imageStore(color_picture, pixel, ao_shade_pass(constants, pixel));
    }
}
