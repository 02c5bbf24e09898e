// Tangent frames. A frame is orthonormal and right-handed: tangent x bitangent = normal.

struct ao_frame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

// A tangent of the unit vector n that is finite for every n, both poles and n = 0 included.
// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
AO_FN vec3 ao_any_tangent(vec3 n)
{
    mask upper = n.z >= real(0);
    real side = mix(real(-1), real(1), upper);
    AO_PRECISE real a = real(-1) / (side + n.z);
    AO_PRECISE real x = real(1) + side * n.x * n.x * a;
    AO_PRECISE real y = side * n.x * n.y * a;
    AO_PRECISE real z = -side * n.x;
    vec3 tangent = vec3(x, y, z);
    return tangent;
}

// Gram-Schmidt frame about the unit vector n, turned towards `helper` (paper 1: T = normalize(V_r - N (V_r . N)), B = N x T).
// The rejection loses about 2e-7 / t of orthogonality at angle t between n and helper; below t = 0.05, and for a zero or
// non-finite helper, the tangent is ao_any_tangent, so the error stays below 1e-5 for every pair.
AO_FN ao_frame ao_gram_schmidt(vec3 n, vec3 helper)
{
    AO_PRECISE real along = ao_dot(helper, n);
    AO_PRECISE vec3 rejected = vec3(helper.x - n.x * along, helper.y - n.y * along, helper.z - n.z * along);
    AO_PRECISE real squared = ao_dot(rejected, rejected);
    AO_PRECISE real least = real(0.0025) * ao_dot(helper, helper);
    mask apart = squared > least && squared <= real(1e30) && squared >= real(1e-30);
    vec3 spare = ao_any_tangent(n);
    vec3 tangent = ao_select(spare, ao_normalize_or(rejected, spare), apart);
    ao_frame frame = { tangent, ao_cross(n, tangent), n };
    return frame;
}
