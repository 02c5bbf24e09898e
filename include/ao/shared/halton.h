// Radical inverses by integer digit reversal and one multiplication: no running power that rounds, no result of 1.
// Exactness: E.

// Base of dimension 0 to 5: 2, 3, 5, 7, 11, 13. Higher bases correlate pairwise at the sample counts in use
// (numerics.md 4.2, H4) and are left out.
AO_FN int ao_halton_base(int dimension)
{
    const int bases[6] = { 2, 3, 5, 7, 11, 13 };
    return bases[dimension];
}

// Number of digits D with base^D < 2^32: what a reversed index may hold without overflow.
AO_FN int ao_halton_digits(int base)
{
    return base == 2 ? 31 : base == 3 ? 20 : base == 5 ? 13 : base == 7 ? 11 : base == 11 ? 9 : 8;
}

// base^-D of the digits above.
AO_FN real ao_halton_scale(int base)
{
    return base == 2    ? real(4.656612873077393e-10)
           : base == 3  ? real(2.8679719907924413e-10)
           : base == 5  ? real(8.192e-10)
           : base == 7  ? real(5.057333106630622e-10)
           : base == 11 ? real(4.2409761837248493e-10)
                        : real(1.2258947398402568e-9);
}

// Element `index` of the van der Corput sequence in `base` (2, 3, 5, 7, 11 or 13), in [0, 1). The first base^D indices
// (at least 8e8) are distinct before rounding; the sequence then repeats.
AO_FN real ao_radical_inverse(int base, uint index)
{
    uint left = index;
    uint reversed = uint(0);
    int digits = ao_halton_digits(base);
    for (int i = 0; i < digits; ++i) {
        uint next = left / uint(base);
        reversed = reversed * uint(base) + (left - next * uint(base));
        left = next;
    }
    AO_PRECISE real fraction = real(reversed) * ao_halton_scale(base);
    return min(fraction, real(0.99999994039535522));
}
