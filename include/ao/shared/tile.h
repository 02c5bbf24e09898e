// The tile of rotations, repeated over the picture.

AO_CONST int ao_tile_size = 64; // texels a side, a power of two

AO_FN ivec2 ao_tile_texel(ivec2 pixel)
{
    ivec2 texel = ivec2(pixel.x & integer(ao_tile_size - 1), pixel.y & integer(ao_tile_size - 1));
    return texel;
}
