#version 450
#extension GL_GOOGLE_include_directive : require
#include "temporal_filter.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID);
    if (ao_inside(pixel)) {
        imageStore(ao_picture, pixel, vec4(ao_temporal_resolve_pass(ao_constants, pixel)));
        if (ao_filter_radius > 0 && ao_to_be_filtered(ao_constants, ao_history_at(pixel, ao_constants.width))) {
            ao_list_tile();
        }
    }
}
