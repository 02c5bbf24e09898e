// What a direction contributes to a vertex, in whole numbers, whose sums do not depend on order: the same bits for any number
// of threads. Exactness: E.

AO_CONST real ao_bake_weight_one = real(1073741824); // 2^30: the weight of the whole sphere
AO_CONST real ao_bake_levels = real(8);              // of visibility, where changes between neighbours are counted

AO_FN real ao_bake_cosine(ao_bake_line line, vec3 normal)
{
    AO_PRECISE real cosine = normal.x * line.dx + normal.y * line.dy + normal.z * line.dz;
    return cosine;
}

// Of a direction at this cosine >= 0 to the normal; `by_cosine`: 1 or 0. In the tangent plane a direction counts half.
AO_FN real ao_bake_weight(real weight, real cosine, bool by_cosine)
{
    AO_PRECISE real half_weight = weight * real(0.5);
    real whole = mix(weight, half_weight, cosine == real(0));
    if (by_cosine) {
        AO_PRECISE real scaled = weight * cosine + real(0.5);
        whole = floor(scaled);
    }
    return whole;
}

// A share of a weight; part in [-1, 1]. All of it exactly, odd or even.
AO_FN real ao_bake_part(real weight, real part)
{
    AO_PRECISE real scaled = weight * part + real(0.5);
    return mix(floor(scaled), weight, part == real(1));
}

// Visibility in whole levels.
AO_FN real ao_bake_level(real open)
{
    AO_PRECISE real scaled = open * ao_bake_levels + real(0.5);
    return floor(scaled);
}

// What a change of visibility between neighbouring directions counts: levels squared, by the squared cosine where weights are.
AO_FN real ao_bake_change(real open, real other_open, real cosine, bool by_cosine)
{
    AO_PRECISE real difference = ao_bake_level(open) - ao_bake_level(other_open);
    AO_PRECISE real squared = difference * difference;
    if (by_cosine) {
        AO_PRECISE real share = cosine * cosine;
        AO_PRECISE real scaled = squared * ao_bake_level(share);
        squared = scaled;
    }
    return squared;
}

// Visibility past an occluder at `distance`, [0, 1]; falloff: 0 none, 1 linear, 2 smooth (bake_falloff).
AO_FN real ao_bake_openness(real distance, real reach, int falloff)
{
    AO_PRECISE real x = min(distance / reach, real(1));
    real open = real(0);
    if (falloff == 1) {
        open = x;
    }
    if (falloff == 2) {
        AO_PRECISE real smooth_step = x * x * (real(3) - real(2) * x);
        open = smooth_step;
    }
    return open;
}

// The distance at which a ray from `start` meets the ground, -1 where it does not; what is below counts as lying on it. `ground`:
// xyz the upward unit vector, w its height. `sign`: 1 along the line's d, -1 against it. Exactness: Q.
AO_FN real ao_bake_ground(vec4 ground, ao_bake_line line, vec3 start, real sign)
{
    AO_PRECISE real height = start.x * ground.x + start.y * ground.y + start.z * ground.z - ground.w;
    AO_PRECISE real slope = (line.dx * ground.x + line.dy * ground.y + line.dz * ground.z) * sign;
    mask meets = slope < real(0);
    AO_PRECISE real distance = max(height, real(0)) / mix(real(1), abs(slope), meets);
    return mix(real(-1), distance, meets);
}
