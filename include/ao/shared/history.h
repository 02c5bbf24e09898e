// The history of a pixel as words of a buffer, so that every backend stores the same bits: no hardware conversion is involved.
// ao_history_precise: 4 words: value, weight, index and depth as floats.
// ao_history_packed: 2 words: value in 16 bits, to nearest, and index in 16; depth with 11 bits of fraction, and weight in 12.
// ao_history_half_stalls: 2 words: four half floats, to nearest, as the paper's RGBA target held them. They stop converging: an
// index above 2048 sticks and small steps of the value are lost.
// Exactness: E.

AO_CONST int ao_history_precise = 0;
AO_CONST int ao_history_packed = 1;
AO_CONST int ao_history_half_stalls = 2;

struct ao_history {
    real value;  // mean of the contributions so far, [0, 1]
    real weight; // samples that it stands for, a whole number
    real index;  // of the next sample, a whole number below the period
    real depth;  // eye depth, 0 where there was no surface
};

AO_FN int ao_history_words(int format)
{
    return format == ao_history_precise ? 4 : 2;
}

// A half float's bits, to nearest (ties to even), of x in [0, 65504].
AO_FN uint ao_half_bits(real x)
{
    integer exponent = ao_exponent(max(x, real(6.103515625e-05)));
    AO_PRECISE real steps = x * ao_power_of_two(integer(10) - exponent);
    AO_PRECISE real upward = floor(steps + real(0.5));
    AO_PRECISE real odd = upward - real(2) * floor(upward * real(0.5));
    mask tie = upward - steps == real(0.5) && odd == real(1);
    AO_PRECISE real rounded = upward - mix(real(0), real(1), tie);
    integer code = (exponent + integer(14)) * integer(1024) + integer(rounded);
    return uint(code);
}

AO_FN real ao_real_of_half(uint code)
{
    uint exponent = code / uint(1024);
    uint fraction = code - exponent * uint(1024);
    mask normal = exponent > uint(0);
    integer shift = mix(integer(-24), integer(exponent) - integer(25), normal);
    AO_PRECISE real steps = real(fraction) + mix(real(0), real(1024), normal);
    AO_PRECISE real x = steps * ao_power_of_two(shift);
    return x;
}

// Preconditions: as the struct says; index < 65536, weight < 4096 (packed).
AO_FN uvec4 ao_packed_history(ao_history h, int format)
{
    uvec4 words = uvec4(ao_bits_of_real(h.value), ao_bits_of_real(h.weight), ao_bits_of_real(h.index), ao_bits_of_real(h.depth));
    if (format == ao_history_packed) {
        AO_PRECISE real code = h.value * real(65535) + real(0.5);
        // To nearest: half of the last bit that stays. Depths are below 2^127.
        uint rounded = ao_bits_of_real(h.depth) + uint(2048);
        uint first = uint(floor(code)) + uint(65536) * uint(h.index);
        uint second = rounded - (rounded & uint(4095)) + uint(h.weight);
        words = uvec4(first, second, uint(0), uint(0));
    }
    if (format == ao_history_half_stalls) {
        uint first = ao_half_bits(h.value) + uint(65536) * ao_half_bits(h.weight);
        uint second = ao_half_bits(h.index) + uint(65536) * ao_half_bits(min(h.depth, real(65504)));
        words = uvec4(first, second, uint(0), uint(0));
    }
    return words;
}

AO_FN ao_history ao_unpacked_history(uvec4 words, int format)
{
    ao_history h = { ao_real_of_bits(words.x), ao_real_of_bits(words.y), ao_real_of_bits(words.z), ao_real_of_bits(words.w) };
    uint high = words.x / uint(65536);
    uint low = words.x - high * uint(65536);
    if (format == ao_history_packed) {
        uint weight = words.y & uint(4095);
        AO_PRECISE real value = real(low) / real(65535);
        ao_history unpacked = { value, real(weight), real(high), ao_real_of_bits(words.y - weight) };
        h = unpacked;
    }
    if (format == ao_history_half_stalls) {
        uint depth = words.y / uint(65536);
        ao_history halves = { ao_real_of_half(low), ao_real_of_half(high), ao_real_of_half(words.y - depth * uint(65536)),
                              ao_real_of_half(depth) };
        h = halves;
    }
    return h;
}
