#version 450
#extension GL_GOOGLE_include_directive : require
#include "temporal.glsl"
#include "ao/shared/temporal_filter_pass.h"

#define AO_TILES_BINDING 11
#include "ao/shared/temporal_tiles.glsl"

layout(binding = 4, r32f) uniform writeonly image2D target;
layout(push_constant) uniform pass_constants { ao_temporal_filter_constants constants; };

void main()
{
    ivec2 pixel = ao_listed_pixel();
    if (in_picture(pixel, constants.width, constants.height)) {
        imageStore(target, pixel, vec4(ao_temporal_rows_pass(constants, pixel)));
    }
}
