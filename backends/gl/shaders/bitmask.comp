#version 450
#extension GL_GOOGLE_include_directive : require
#include "bitmask.glsl"
#include "compute.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID);
    if (ao_inside(pixel)) {
        imageStore(ao_picture, pixel, ao_texel(pixel));
    }
}
