// sRGB (IEC 61966-2-1) for display. Decoding is a table of 256 (ao/color.hpp). Exactness: E.

// Encoded value of linear light: 0 ... 1, 0 for NaN.
AO_FN real ao_srgb_of_linear(real linear)
{
    mask lit = linear > real(0);
    real inside = min(mix(real(0), linear, lit), real(1));
    AO_PRECISE real straight = inside * real(12.92);
    AO_PRECISE real curved = real(1.055) * ao_power(inside, real(0.4166666666666667)) - real(0.055);
    mask dark = inside <= real(0.0031308);
    return mix(curved, straight, dark);
}

// The 8-bit code, 0 ... 255.
AO_FN real ao_srgb_code(real linear)
{
    AO_PRECISE real scaled = ao_srgb_of_linear(linear) * real(255) + real(0.5);
    return floor(scaled);
}
