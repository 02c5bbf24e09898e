#include "filter.glsl"

vec4 ao_texel(ivec2 pixel)
{
    return vec4(ao_filter_columns_pass(ao_constants, pixel));
}
