#include "denoise.glsl"

vec4 ao_texel(ivec2 pixel)
{
    if (ao_bent_normal) {
        return ao_denoise_columns_bent_pass(ao_constants, pixel);
    }
    return vec4(ao_denoise_columns_pass(ao_constants, pixel));
}
