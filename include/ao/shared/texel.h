// What all bilinear look-ups share: coordinates and texels brought into a picture, and the weighing. Exactness: E.

AO_CONST int ao_wrap_repeat = 0;
AO_CONST int ao_wrap_clamp = 1;
AO_CONST int ao_wrap_mirror = 2;

AO_FN real ao_lerp(real a, real b, real weight)
{
    AO_PRECISE real sum = a * (real(1) - weight) + b * weight;
    return sum;
}

AO_FN vec4 ao_lerp(vec4 a, vec4 b, real weight)
{
    vec4 sum = vec4(ao_lerp(a.x, b.x, weight), ao_lerp(a.y, b.y, weight), ao_lerp(a.z, b.z, weight), ao_lerp(a.w, b.w, weight));
    return sum;
}

// A texture coordinate brought into the period of its mode; 0 for NaN and beyond 4e6, where floats hold no fraction of use.
AO_FN real ao_wrapped_coordinate(real u, uint wrap)
{
    mask usable = abs(u) <= real(4e6);
    real finite = mix(real(0), u, usable);
    AO_PRECISE real repeated = finite - floor(finite);
    AO_PRECISE real half_period = finite * real(0.5);
    AO_PRECISE real mirrored = finite - real(2) * floor(half_period);
    real clamped = min(max(finite, real(-1)), real(2));
    return mix(mix(repeated, clamped, wrap == uint(ao_wrap_clamp)), mirrored, wrap == uint(ao_wrap_mirror));
}

// The texel of 0 ... size - 1 that stands at i, within one period (repeat: -1 ... size, mirror: -1 ... 2 size).
AO_FN integer ao_wrapped_texel(integer i, integer size, uint wrap)
{
    mask below = i < integer(0);
    mask beyond = i >= size;
    integer last = size - integer(1);
    integer repeated = mix(mix(i, i + size, below), i - size, beyond);
    integer mirrored = mix(mix(i, integer(-1) - i, below), size + last - i, beyond);
    integer chosen = mix(mix(repeated, i, wrap == uint(ao_wrap_clamp)), mirrored, wrap == uint(ao_wrap_mirror));
    return mix(mix(chosen, integer(0), chosen < integer(0)), last, chosen > last);
}
