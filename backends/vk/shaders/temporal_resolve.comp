#version 450
#extension GL_GOOGLE_include_directive : require
#include "temporal.glsl"
#include "ao/shared/temporal_filter_pass.h"

#define AO_TILES_BINDING 11
#include "ao/shared/temporal_tiles.glsl"

layout(binding = 4, AO_OUTPUT) uniform writeonly image2D target;
layout(push_constant) uniform pass_constants { ao_temporal_filter_constants constants; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (in_picture(pixel, constants.width, constants.height)) {
        imageStore(target, pixel, vec4(ao_temporal_resolve_pass(constants, pixel)));
        if (ao_filter_radius > 0 && ao_to_be_filtered(constants, ao_history_at(pixel, constants.width))) {
            ao_list_tile();
        }
    }
}
