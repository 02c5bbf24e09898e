#include "denoise.glsl"

vec4 ao_texel(ivec2 pixel)
{
    if (ao_bent_normal) {
        return ao_denoise_rows_bent_pass(ao_constants, pixel);
    }
    return vec4(ao_denoise_rows_pass(ao_constants, pixel), 0.0, 0.0);
}
