// log2, exp2, power and the arc of two numbers by polynomials and exponent bits: the built-in ones differ between drivers by
// up to 4096 units in the last place (numerics.md 3.1). Coefficients: Chebyshev interpolation of the quotients named below.
// Exactness: E, but Q for ao_turns, which divides.
// Of the scope: integer ao_exponent(real): floor of log2 of x in [2^-126, 2^127]; real ao_power_of_two(integer): 2^-126 to 2^127;
// real ao_inverse_root_guess(real): of the bits 0x5f1ffff9 - bits / 2.

// Within 1e-7 of log2(x) where that is 1 or more, relative, else within 1.6e-7 relative, for x in [2^-126, 2^126]; nearer ones of
// these for what lies outside, -126 for NaN. Exactly 0 at 1.
AO_FN real ao_log2(real x)
{
    mask usable = x >= real(1.1754943508222875e-38);
    mask beyond = x > real(8.507059173023462e37);
    real inside = mix(mix(real(1.1754943508222875e-38), x, usable), real(8.507059173023462e37), beyond);
    integer exponent = ao_exponent(inside);
    AO_PRECISE real scaled = inside * ao_power_of_two(-exponent);
    mask high = scaled > real(1.4142135);
    AO_PRECISE real t = mix(scaled, scaled * real(0.5), high) - real(1);
    AO_PRECISE real whole = real(exponent) + mix(real(0), real(1), high);
    // log2(1 + t) / t on [sqrt(1/2) - 1, sqrt(2) - 1]
    AO_PRECISE real q = real(0.184760334) + t * real(-0.107497894);
    q = real(-0.191388377) + t * q;
    q = real(0.204857648) + t * q;
    q = real(-0.239608122) + t * q;
    q = real(0.288552561) + t * q;
    q = real(-0.360696542) + t * q;
    q = real(0.48089852) + t * q;
    q = real(-0.721347354) + t * q;
    q = real(1.44269504) + t * q;
    AO_PRECISE real logarithm = whole + t * q;
    return logarithm;
}

// Within 1.1e-7 of 2^x, relative, for x in [-126, 126]; 0 below and for NaN, 2^126 above. Exactly 1 at 0.
AO_FN real ao_exp2(real x)
{
    mask usable = x >= real(-126);
    mask beyond = x > real(126);
    real inside = mix(mix(real(0), x, usable), real(126), beyond);
    AO_PRECISE real whole = floor(inside + real(0.5));
    AO_PRECISE real f = inside - whole;
    // (2^f - 1) / f on [-1/2, 1/2]
    AO_PRECISE real q = real(0.00133908634) + f * real(0.000154531629);
    q = real(0.00961808256) + f * q;
    q = real(0.0555035711) + f * q;
    q = real(0.240226508) + f * q;
    q = real(0.693147188) + f * q;
    AO_PRECISE real power = (real(1) + f * q) * ao_power_of_two(integer(whole));
    return mix(real(0), power, usable);
}

// Within 6.6e-4 of 1 / sqrt(x), relative, for normal x; finite for 0 and denormals. A start from halved exponent bits and one
// step of Newton's method with the constants of Kadlec (2010).
AO_FN real ao_inverse_root(real x)
{
    real start = ao_inverse_root_guess(x);
    AO_PRECISE real squared = start * start;
    AO_PRECISE real inverse = start * (real(0.703952253) * (real(2.38924456) - x * squared));
    return inverse;
}

// x^y for x in [0, 1] (more counts as 1, less, NaN and denormals as 0) and y in [0, 8192] (less and NaN count as 0).
// Within 1.2e-7 of it, absolutely. 0^0 = 1; x^0 and 1^y are exactly 1.
AO_FN real ao_power(real x, real y)
{
    mask positive = x >= real(1.1754943508222875e-38);
    mask raised = y > real(0);
    real base = min(mix(real(1), x, positive), real(1));
    AO_PRECISE real logarithm = mix(real(0), y, raised) * ao_log2(base);
    real power = mix(real(0), ao_exp2(logarithm), positive);
    return mix(real(1), power, raised);
}

// Angle of (x, y) from the x axis in turns, -1/2 to 1/2: atan2(y, x) / (2 pi), within 5e-8. 0 for (0, 0).
// Precondition: finite, none beyond 1e18.
AO_FN real ao_turns(real y, real x)
{
    real across = abs(x);
    real up = abs(y);
    real larger = max(across, up);
    real smaller = min(across, up);
    mask somewhere = larger > real(0);
    AO_PRECISE real ratio = smaller / mix(real(1), larger, somewhere);
    AO_PRECISE real s = ratio * ratio;
    // atan(sqrt(s)) / (2 pi sqrt(s)) on [0, 1]
    AO_PRECISE real q = real(-0.00250370606) + s * real(0.000440267693);
    q = real(0.00670641108) + s * q;
    q = real(-0.0118679531) + s * q;
    q = real(0.0168996617) + s * q;
    q = real(-0.022596497) + s * q;
    q = real(0.0318180526) + s * q;
    q = real(-0.0530511756) + s * q;
    q = real(0.15915494) + s * q;
    AO_PRECISE real arc = ratio * q;
    mask steep = up > across;
    AO_PRECISE real quarter = mix(arc, real(0.25) - arc, steep);
    mask left = x < real(0);
    AO_PRECISE real half_turn = mix(quarter, real(0.5) - quarter, left);
    mask below = y < real(0);
    return mix(half_turn, -half_turn, below);
}
