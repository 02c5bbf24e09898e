// A pixel's history from the buffer, pixel after pixel, row after row.
// Callbacks: uvec4 ao_load_history(uint): a pixel's words, the last two of no meaning in formats of two.
// Options:   int ao_history_format.

AO_PASS uint ao_history_place(ivec2 pixel, real width)
{
    return uint(pixel.y) * uint(width) + uint(pixel.x);
}

AO_PASS ao_history ao_history_at(ivec2 pixel, real width)
{
    return ao_unpacked_history(ao_load_history(ao_history_place(pixel, width)), ao_history_format);
}
