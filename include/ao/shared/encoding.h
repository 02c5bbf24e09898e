// Decoding of stored normals. Normalised integers arrive as the float that the API's own conversion made; the integer is
// recovered first (the conversion's rounding is the driver's own), so every backend decodes the same number. Exactness: Q.

// 0 ... `top` from a normalised value in [0, 1].
AO_FN real ao_unorm_code(real value, real top)
{
    AO_PRECISE real scaled = value * top + real(0.5);
    return floor(scaled);
}

// The value in [0, 1] itself, rounded once: an API's own conversion may be a step off.
AO_FN real ao_unorm_value(real value, real top)
{
    AO_PRECISE real exact = ao_unorm_code(value, top) / top;
    return exact;
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

AO_CONST int ao_normal_vector = 0;     // xyz of a float format, any length
AO_CONST int ao_normal_unorm10 = 1;    // xyz of RGB10A2, 0 ... 1 for -1 ... 1
AO_CONST int ao_normal_octahedral = 2; // xy of RG16, 0 ... 1 for -1 ... 1, octahedral
AO_CONST int ao_normal_from_depth = 3; // none stored: rebuilt from depth

// What a stored normal's texel, as the API delivers it, says; of any length.
AO_FN vec3 ao_decoded_normal(int source, vec4 texel)
{
    vec3 stored = vec3(texel);
    if (source == ao_normal_unorm10) {
        stored = vec3(ao_signed_from_code(ao_unorm_code(texel.x, real(1023)), real(1023)),
                      ao_signed_from_code(ao_unorm_code(texel.y, real(1023)), real(1023)),
                      ao_signed_from_code(ao_unorm_code(texel.z, real(1023)), real(1023)));
    }
    if (source == ao_normal_octahedral) {
        stored = ao_octahedral_direction(ao_signed_from_code(ao_unorm_code(texel.x, real(65535)), real(65535)),
                                         ao_signed_from_code(ao_unorm_code(texel.y, real(65535)), real(65535)));
    }
    return stored;
}
