#version 450
#extension GL_GOOGLE_include_directive : require
#include "shading.glsl"
#include "compute.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID);
    if (!ao_inside(pixel)) {
        return;
    }
    vec4 color = ao_segment_pass(ao_constants, pixel);
    if (color.w >= 0.0) {
        if (ao_output < 0) {
            imageStore(ao_picture, pixel, color);
        }
        else {
            imageStore(ao_targets, ivec3(pixel, ao_output), color);
        }
    }
}
