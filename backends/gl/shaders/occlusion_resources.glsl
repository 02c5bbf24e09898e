// What the passes that estimate visibility from a depth buffer load.
layout(binding = 0) uniform sampler2D ao_depth;
layout(binding = 1) uniform sampler2D ao_normals;
layout(binding = 2) uniform sampler2D ao_rotations;
layout(std140, binding = 1) uniform ao_taps_block { vec4 ao_taps[1024]; };

real ao_load_depth(ivec2 pixel)
{
    return texelFetch(ao_depth, pixel, 0).x;
}

vec4 ao_load_normal(ivec2 pixel)
{
    return texelFetch(ao_normals, pixel, 0);
}

vec2 ao_load_rotation(ivec2 texel)
{
    return vec2(texelFetch(ao_rotations, texel, 0));
}

vec4 ao_tap(int i)
{
    return ao_taps[i];
}
