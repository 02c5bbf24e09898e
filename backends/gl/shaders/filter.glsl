// Resources and options of both filter passes; each reads the same unit as what it is.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 7) const int ao_filter_radius = 2;

layout(binding = 0) uniform sampler2D ao_source;

real ao_load_visibility(ivec2 pixel)
{
    return texelFetch(ao_source, pixel, 0).x;
}

vec2 ao_load_row_sum(ivec2 pixel)
{
    return vec2(texelFetch(ao_source, pixel, 0));
}

#include "ao/shared/filter_pass.h"

layout(std140, binding = 0) uniform ao_constants_block { ao_filter_constants ao_constants; };
