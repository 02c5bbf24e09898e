// A visibility and its weight in one float, as two whole numbers of 12 bits: what the passes of the method `bitmask` hand on.
// Negative for background. Exact for visibility 1 and 0.

AO_CONST int ao_packed_top = 4095;
AO_CONST int ao_packed_weight = 1024;

// `visibility` in [0, 1], `weight` in [0, 4).
AO_FN real ao_pack_visibility(real visibility, real weight)
{
    AO_PRECISE real value = floor(visibility * real(ao_packed_top) + real(0.5));
    // At least 1: a pixel that is sure of nothing still has a visibility.
    AO_PRECISE real share = min(max(floor(weight * real(ao_packed_weight)), real(1)), real(ao_packed_top));
    AO_PRECISE real both = share * real(4096) + value;
    return both;
}

// Visibility in 4095ths and weight in 1024ths, of a packed value of 0 or more.
AO_FN vec2 ao_unpack_visibility(real both)
{
    AO_PRECISE real share = floor(both * real(0.000244140625));
    AO_PRECISE real value = both - share * real(4096);
    return vec2(value, share);
}
