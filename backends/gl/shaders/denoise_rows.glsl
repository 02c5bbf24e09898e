#include "denoise.glsl"

vec4 ao_texel(ivec2 pixel)
{
    return vec4(ao_denoise_rows_pass(ao_constants, pixel), 0.0, 0.0);
}
