// Textures read from a heap of words, so that every backend filters the same texels with the same weights (hardware filters
// weigh in steps of 1/256, and each its own way). ao/texture.hpp makes the heap:
//   256 words      linear light of the sRGB codes, as bits of floats
//   24 per texture width, height, levels, wrap along u, wrap along v, sRGB (0 or 1), 2 reserved, offsets of 16 levels
//   texels         RGBA, red in the low byte, row by row
// Callbacks: uint ao_load_texel(uint index). Exactness: E.

#include "ao/shared/texel.h"

AO_CONST int ao_heap_table = 256;
AO_CONST int ao_descriptor_words = 24;
AO_CONST int ao_descriptor_levels = 8; // first of the offsets

struct ao_texture_header {
    uint at; // its descriptor
    real width;
    real height;
    real levels;
    uint wrap_u;
    uint wrap_v;
    mask srgb;
};

AO_PASS ao_texture_header ao_load_texture(uint texture)
{
    uint at = uint(ao_heap_table) + texture * uint(ao_descriptor_words);
    ao_texture_header t = { at,
                            real(ao_load_texel(at)),
                            real(ao_load_texel(at + uint(1))),
                            real(ao_load_texel(at + uint(2))),
                            ao_load_texel(at + uint(3)),
                            ao_load_texel(at + uint(4)),
                            ao_load_texel(at + uint(5)) != uint(0) };
    return t;
}

AO_PASS real ao_decoded(uint code, mask srgb)
{
    // fl(1 / 255): 255 gives exactly 1, others are within one unit in the last place of code / 255
    AO_PRECISE real linear = real(code) * real(0.003921568859368563);
    if (ao_any(srgb)) {
        linear = mix(linear, ao_real_of_bits(ao_load_texel(code)), srgb);
    }
    return linear;
}

// Color in linear light where the texture is sRGB; alpha is linear always.
AO_PASS vec4 ao_texel(uint index, mask srgb)
{
    uint word = ao_load_texel(index);
    vec4 color = vec4(ao_decoded(word & uint(255), srgb), ao_decoded(word / uint(256) & uint(255), srgb),
                      ao_decoded(word / uint(65536) & uint(255), srgb), ao_decoded(word / uint(16777216), mask(false)));
    return color;
}

// Bilinear within one level (a whole number), from coordinates that ao_wrapped_coordinate returned.
AO_PASS vec4 ao_bilinear(ao_texture_header t, real level, real u, real v)
{
    real scale = ao_power_of_two(-integer(level));
    AO_PRECISE real width = max(floor(t.width * scale), real(1));
    AO_PRECISE real height = max(floor(t.height * scale), real(1));
    AO_PRECISE real column = u * width - real(0.5);
    AO_PRECISE real row = v * height - real(0.5);
    real left = floor(column);
    real top = floor(row);
    AO_PRECISE real across = column - left;
    AO_PRECISE real down = row - top;
    uint offset = ao_load_texel(t.at + uint(ao_descriptor_levels) + uint(level));
    uint x0 = uint(ao_wrapped_texel(integer(left), integer(width), t.wrap_u));
    uint x1 = uint(ao_wrapped_texel(integer(left) + integer(1), integer(width), t.wrap_u));
    uint y0 = offset + uint(ao_wrapped_texel(integer(top), integer(height), t.wrap_v)) * uint(width);
    uint y1 = offset + uint(ao_wrapped_texel(integer(top) + integer(1), integer(height), t.wrap_v)) * uint(width);
    vec4 upper = ao_lerp(ao_texel(y0 + x0, t.srgb), ao_texel(y0 + x1, t.srgb), across);
    vec4 lower = ao_lerp(ao_texel(y1 + x0, t.srgb), ao_texel(y1 + x1, t.srgb), across);
    return ao_lerp(upper, lower, down);
}

// Trilinear. `footprint`: squared length of the longer screen derivative of uv; NaN, 0 and less mean the largest level.
AO_PASS vec4 ao_filtered(ao_texture_header t, vec2 uv, real footprint)
{
    real u = ao_wrapped_coordinate(uv.x, t.wrap_u);
    real v = ao_wrapped_coordinate(uv.y, t.wrap_v);
    real side = max(t.width, t.height);
    AO_PRECISE real texels = footprint * (side * side);
    AO_PRECISE real exact = real(0.5) * ao_log2(texels);
    mask smaller = texels > real(1);
    real lod = mix(real(0), min(exact, t.levels - real(1)), smaller);
    real level = floor(lod);
    AO_PRECISE real weight = lod - level;
    vec4 color = ao_bilinear(t, level, u, v);
    AO_PRECISE real next = level + real(1);
    mask between = weight > real(0);
    if (ao_any(between)) {
        color = ao_lerp(color, ao_bilinear(t, mix(level, next, between), u, v), weight);
    }
    return color;
}

AO_PASS vec4 ao_sample(uint texture, vec2 uv, real footprint)
{
    return ao_filtered(ao_load_texture(texture), uv, footprint);
}

// A texture that goes around: an equirectangular picture, whatever its own modes are.
AO_PASS vec4 ao_sample_around(uint texture, vec2 uv, real footprint)
{
    ao_texture_header t = ao_load_texture(texture);
    t.wrap_u = uint(ao_wrap_repeat);
    t.wrap_v = uint(ao_wrap_clamp);
    return ao_filtered(t, uv, footprint);
}
