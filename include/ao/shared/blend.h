// Blending of materials (paper 4): I = (1 - b) I_1 + b I_2. Exactness: E.

// b = 0 and b = 1 return the child's bits, whatever the other holds. Precondition: b in [0, 1].
AO_FN vec3 ao_blend(vec3 first, vec3 second, real b)
{
    AO_PRECISE real rest = real(1) - b;
    AO_PRECISE real x = first.x * rest + second.x * b;
    AO_PRECISE real y = first.y * rest + second.y * b;
    AO_PRECISE real z = first.z * rest + second.z * b;
    vec3 mixed = vec3(x, y, z);
    return ao_select(ao_select(mixed, first, b <= real(0)), second, b >= real(1));
}

AO_FN mask ao_is_mask(real b)
{
    return b >= real(0) && b <= real(1);
}

// What a weight or mask counts as: outside [0, 1] the nearer end, 0 for NaN.
AO_FN real ao_clamp_mask(real b)
{
    mask positive = b > real(0);
    return min(mix(real(0), b, positive), real(1));
}
