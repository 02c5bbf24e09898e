// A pixel's history from the buffer, pixel after pixel, row after row.
// Callbacks: uint ao_load_history(uint): a word. Options: int ao_history_format.

AO_PASS uint ao_history_place(ivec2 pixel, real width)
{
    return (uint(pixel.y) * uint(width) + uint(pixel.x)) * uint(ao_history_words(ao_history_format));
}

AO_PASS ao_history ao_history_at(ivec2 pixel, real width)
{
    uint at = ao_history_place(pixel, width);
    uvec4 stored = uvec4(ao_load_history(at), ao_load_history(at + uint(1)), uint(0), uint(0));
    if (ao_history_words(ao_history_format) == 4) {
        stored = uvec4(stored.x, stored.y, ao_load_history(at + uint(2)), ao_load_history(at + uint(3)));
    }
    return ao_unpacked_history(stored, ao_history_format);
}

// Its depth alone, and its value with it: what a neighbour is asked for. x: value; y: depth.
AO_PASS real ao_history_depth_at(ivec2 pixel, real width)
{
    uint at = ao_history_place(pixel, width);
    if (ao_history_format == ao_history_precise) {
        return ao_real_of_bits(ao_load_history(at + uint(3)));
    }
    return ao_unpacked_history(uvec4(uint(0), ao_load_history(at + uint(1)), uint(0), uint(0)), ao_history_format).depth;
}

AO_PASS vec2 ao_history_value_and_depth_at(ivec2 pixel, real width)
{
    uint at = ao_history_place(pixel, width);
    if (ao_history_format == ao_history_precise) {
        return vec2(ao_real_of_bits(ao_load_history(at)), ao_real_of_bits(ao_load_history(at + uint(3))));
    }
    ao_history h =
        ao_unpacked_history(uvec4(ao_load_history(at), ao_load_history(at + uint(1)), uint(0), uint(0)), ao_history_format);
    return vec2(h.value, h.depth);
}
