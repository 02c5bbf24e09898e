#include "denoise.glsl"

vec4 ao_texel(ivec2 pixel)
{
    return vec4(ao_denoise_columns_pass(ao_constants, pixel));
}
