// Glossy light by a weighted design (paper 3, DPRT): B~(v) = sum of l_k L(g x_k), g a rotation that takes +z, about which the
// design stands, to the mirror direction 2 (n.v) n - v. Callbacks: vec4 ao_load_lobe(int k): direction x_k about +z, weight l_k
// in w (ao/lobe_rule.hpp); those of surroundings.h. Exactness: Q.

// Linear RGB. n: the normal, to_eye: v, both unit and in the light's space. The lobe is not cut at the surface's horizon.
// Continuous in n and v but where the mirror direction is -Z; how much the choice of g matters there is what the light has beyond
// the design's order.
AO_PASS vec3 ao_lobe_light(int directions, real width, real height, vec3 n, vec3 to_eye)
{
    vec3 axis = ao_half_turn_axis(ao_mirrored(to_eye, n));
    vec3 sum = vec3(real(0), real(0), real(0));
    for (int k = 0; k < directions; ++k) {
        vec4 lobe = ao_load_lobe(k);
        vec3 light = ao_surroundings(width, height, ao_mirrored(vec3(lobe), axis));
        AO_PRECISE vec3 next = vec3(sum.x + lobe.w * light.x, sum.y + lobe.w * light.y, sum.z + lobe.w * light.z);
        sum = next;
    }
    return sum;
}
