// Light arriving at a surface, from spherical harmonics (paper 3, PRT): the sum over l <= order of L_lm T_lm(n).
// Callbacks: vec4 ao_load_harmonic(int index), index = l (l + 1) + m: linear RGB of L_lm times everything of T_lm that does not
// depend on n, and g_lm in w (ao/harmonic_light.hpp packs them). Exactness: E.

AO_FN vec3 ao_add_scaled(vec3 sum, vec4 coefficient, real factor)
{
    AO_PRECISE vec3 next = vec3(sum.x + coefficient.x * factor, sum.y + coefficient.y * factor, sum.z + coefficient.z * factor);
    return next;
}

// Linear RGB; may be negative where light of higher orders was cut off. n: unit, in the light's space. order: 0 to 8.
AO_PASS vec3 ao_harmonic_light(int order, vec3 n)
{
    vec3 sum = vec3(real(0), real(0), real(0));
    real c = real(1);
    real s = real(0);
    for (int m = 0; m <= order; ++m) {
        real before = real(0);
        real here = real(1);
        for (int l = m; l <= order; ++l) {
            vec4 even = ao_load_harmonic(l * (l + 1) + m);
            AO_PRECISE real cosine = here * c;
            sum = ao_add_scaled(sum, even, cosine);
            if (m > 0) {
                vec4 odd = ao_load_harmonic(l * (l + 1) - m);
                AO_PRECISE real sine = here * s;
                sum = ao_add_scaled(sum, odd, sine);
            }
            real next = ao_harmonic_next(n.z, here, before, even.w);
            before = here;
            here = next;
        }
        real turned = ao_azimuth_real(c, s, n.x, n.y);
        s = ao_azimuth_imaginary(c, s, n.x, n.y);
        c = turned;
    }
    return sum;
}

// Light that reaches a surface through what occlusion leaves open of its hemisphere: along the mean unoccluded direction
// (bent_normal.h) and scaled by visibility. Light that is the same all around comes out exactly.
AO_PASS vec3 ao_harmonic_light_through(int order, vec3 bent, real visibility)
{
    vec3 light = ao_harmonic_light(order, bent);
    AO_PRECISE vec3 arriving = vec3(light.x * visibility, light.y * visibility, light.z * visibility);
    return arriving;
}
