// Decoding of stored normals. Normalised integers arrive as the float that the API's own conversion made; the integer is
// recovered first (the conversion's rounding is the driver's own), so every backend decodes the same number. Exactness: Q.

// 0 ... `top` from a normalised value in [0, 1].
AO_FN real ao_unorm_code(real value, real top)
{
    AO_PRECISE real scaled = value * top + real(0.5);
    return floor(scaled);
}

// [-1, 1] from a code in 0 ... top, both ends exact.
AO_FN real ao_signed_from_code(real code, real top)
{
    AO_PRECISE real decoded = (code + code - top) / top;
    return decoded;
}

// Unit vector from octahedral coordinates in [-1, 1]^2. Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 3(2), 2014. The result is not yet normalised.
AO_FN vec3 ao_octahedral_direction(real u, real v)
{
    AO_PRECISE real z = real(1) - abs(u) - abs(v);
    AO_PRECISE real fold = max(-z, real(0));
    mask right = u >= real(0);
    mask top = v >= real(0);
    AO_PRECISE real x = u - mix(-fold, fold, right);
    AO_PRECISE real y = v - mix(-fold, fold, top);
    vec3 direction = vec3(x, y, z);
    return direction;
}
