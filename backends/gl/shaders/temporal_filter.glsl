// What the passes behind the accumulation have in common: one picture, made from this frame's history.
#include "temporal.glsl"

layout(constant_id = 11) const int ao_filter_radius = 2;

layout(binding = 1) uniform sampler2D ao_row_values;
layout(binding = 0) writeonly uniform image2D ao_picture;

real ao_load_row(ivec2 pixel)
{
    return texelFetch(ao_row_values, pixel, 0).x;
}

#include "ao/shared/temporal_filter_pass.h"

layout(std140, binding = 0) uniform ao_constants_block { ao_temporal_filter_constants ao_constants; };

bool ao_inside(ivec2 pixel)
{
    return all(lessThan(pixel, imageSize(ao_picture)));
}

#define AO_TILES_BINDING 0
#include "ao/shared/temporal_tiles.glsl"
