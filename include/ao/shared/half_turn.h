// Rotations that take +z to a direction, as half turns about the axis halfway: ao_mirrored(d, axis) turns d.

// Unit axis of the half turn that takes +z to the unit vector r. Continuous in r but at r = -z, as far as that can be (no
// tangent field on the sphere is continuous everywhere); there it is +x. Exactness: Q.
AO_FN vec3 ao_half_turn_axis(vec3 r)
{
    AO_PRECISE real across = r.x * r.x + r.y * r.y;
    mask upper = r.z >= real(0);
    // 1 + r.z; for r.z < 0 in a way that does not cancel
    AO_PRECISE real above = real(1) + r.z;
    AO_PRECISE real below = across / (real(1) - min(r.z, real(0)));
    vec3 halfway = vec3(r.x, r.y, mix(below, above, upper));
    return ao_normalize_or(halfway, vec3(real(1), real(0), real(0)));
}
