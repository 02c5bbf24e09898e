// Real spherical harmonics of a unit vector n by recurrence: Y_lm = N_lm R_lm(n.z) times real (m >= 0) or imaginary part of
// (n.x + i n.y)^|m|, where R_lm, the |m|-th derivative of Legendre's polynomial with 1 as its leading coefficient, obeys
// R_mm = 1, R_l+1,m = z R_lm - g_lm R_l-1,m, g_lm = (l^2 - m^2) / (4 l^2 - 1). ao/harmonics.hpp has N_lm. Exactness: E.

// R of the next degree.
AO_FN real ao_harmonic_next(real z, real here, real before, real g)
{
    AO_PRECISE real next = z * here - g * before;
    return next;
}

// Real part of (c + i s) (x + i y), and imaginary part.
AO_FN real ao_azimuth_real(real c, real s, real x, real y)
{
    AO_PRECISE real next = c * x - s * y;
    return next;
}

AO_FN real ao_azimuth_imaginary(real c, real s, real x, real y)
{
    AO_PRECISE real next = c * y + s * x;
    return next;
}
