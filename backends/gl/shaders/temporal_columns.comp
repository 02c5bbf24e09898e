#version 450
#extension GL_GOOGLE_include_directive : require
#include "temporal_filter.glsl"

void main()
{
    ivec2 pixel = ao_listed_pixel();
    if (ao_inside(pixel)) {
        imageStore(ao_picture, pixel, vec4(ao_temporal_columns_pass(ao_constants, pixel)));
    }
}
