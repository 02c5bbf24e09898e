// Resources and options of both denoising passes.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 2) const int ao_normal_source = 0;
layout(constant_id = 3) const bool ao_rotate_normals = false;
layout(constant_id = 4) const bool ao_parallel = false;
layout(constant_id = 7) const int ao_filter_radius = 2;
layout(constant_id = 12) const bool ao_coarse = false;

layout(binding = 0) uniform sampler2D ao_source;
layout(binding = 1) uniform sampler2D ao_normals;
layout(binding = 2) uniform sampler2D ao_depths; // of every pixel, where coarse

vec2 ao_load_packed(ivec2 texel)
{
    return vec2(texelFetch(ao_source, texel, 0));
}

real ao_load_depth(ivec2 pixel)
{
    return ao_coarse ? texelFetch(ao_depths, pixel, 0).x : texelFetch(ao_source, pixel, 0).y;
}

vec4 ao_load_normal(ivec2 pixel)
{
    return texelFetch(ao_normals, pixel, 0);
}

#include "ao/shared/normal_pass.h"
#include "ao/shared/denoise_pass.h"

layout(std140, binding = 0) uniform ao_constants_block { ao_denoise_constants ao_constants; };
