// What the geometry pass computes per vertex and per fragment (paper 1, stage 1). Rasterisers interpolate in their own way,
// so results agree within the interpolation's bound, not in bits.

// An affine map by its rows: the fourth component is the translation.
struct ao_affine_map {
    vec4 x;
    vec4 y;
    vec4 z;
};

AO_FN vec3 ao_transform_point(ao_affine_map m, vec3 p)
{
    AO_PRECISE real x = m.x.x * p.x + m.x.y * p.y + m.x.z * p.z + m.x.w;
    AO_PRECISE real y = m.y.x * p.x + m.y.y * p.y + m.y.z * p.z + m.y.w;
    AO_PRECISE real z = m.z.x * p.x + m.z.y * p.y + m.z.z * p.z + m.z.w;
    vec3 moved = vec3(x, y, z);
    return moved;
}

AO_FN vec3 ao_transform_direction(ao_affine_map m, vec3 v)
{
    AO_PRECISE real x = m.x.x * v.x + m.x.y * v.y + m.x.z * v.z;
    AO_PRECISE real y = m.y.x * v.x + m.y.y * v.y + m.y.z * v.z;
    AO_PRECISE real z = m.z.x * v.x + m.z.y * v.y + m.z.z * v.z;
    vec3 turned = vec3(x, y, z);
    return turned;
}

// Times the inverse transpose, up to a positive factor: cofactors, so that singular maps stay finite; the sign keeps normals
// outward under mirroring maps. Normalise afterwards.
AO_FN vec3 ao_transform_normal(ao_affine_map m, vec3 n)
{
    vec3 a = vec3(m.x.x, m.y.x, m.z.x);
    vec3 b = vec3(m.x.y, m.y.y, m.z.y);
    vec3 c = vec3(m.x.z, m.y.z, m.z.z);
    vec3 bc = ao_cross(b, c);
    vec3 ca = ao_cross(c, a);
    vec3 ab = ao_cross(a, b);
    AO_PRECISE real determinant = ao_dot(a, bc);
    mask mirrored = determinant < real(0);
    real side = mix(real(1), real(-1), mirrored);
    AO_PRECISE real x = (bc.x * n.x + ca.x * n.y + ab.x * n.z) * side;
    AO_PRECISE real y = (bc.y * n.x + ca.y * n.y + ab.y * n.z) * side;
    AO_PRECISE real z = (bc.z * n.x + ca.z * n.y + ab.z * n.z) * side;
    vec3 turned = vec3(x, y, z);
    return turned;
}

// Normal from a normal map's texel (0 ... 1 for -1 ... 1 in tangent space). `normal` and `tangent` are interpolated, of any
// length; `handedness` is +1 or -1; `green` is +1, or -1 for maps whose green points down.
AO_FN vec3 ao_mapped_normal(vec3 normal, vec3 tangent, real handedness, vec3 texel, real green)
{
    vec3 n = ao_normalize_or(normal, vec3(real(0), real(0), real(1)));
    ao_frame frame = ao_gram_schmidt(n, tangent);
    AO_PRECISE real u = texel.x * real(2) - real(1);
    AO_PRECISE real v = (texel.y * real(2) - real(1)) * green * handedness;
    AO_PRECISE real w = texel.z * real(2) - real(1);
    AO_PRECISE vec3 mapped =
        vec3(frame.tangent.x * u + frame.bitangent.x * v + n.x * w, frame.tangent.y * u + frame.bitangent.y * v + n.y * w,
             frame.tangent.z * u + frame.bitangent.z * v + n.z * w);
    return ao_normalize_or(mapped, n);
}

// Squared length of the longer of the two screen derivatives of uv.
AO_FN real ao_footprint(vec2 along_x, vec2 along_y)
{
    AO_PRECISE real x = along_x.x * along_x.x + along_x.y * along_x.y;
    AO_PRECISE real y = along_y.x * along_y.x + along_y.y * along_y.y;
    return max(x, y);
}

// Texture coordinates at a fragment and how they change with the pixel.
struct ao_map_place {
    vec2 uv;
    vec2 along_x;
    vec2 along_y;
    real footprint; // ao_footprint of the two
};

AO_FN ao_map_place ao_place_of(vec2 uv, vec2 along_x, vec2 along_y)
{
    ao_map_place place = { uv, along_x, along_y, ao_footprint(along_x, along_y) };
    return place;
}

// Octahedral coordinates in [-1, 1] of a unit vector: the inverse of ao_octahedral_direction.
AO_FN vec2 ao_octahedral_coordinates(vec3 n)
{
    AO_PRECISE real sum = abs(n.x) + abs(n.y) + abs(n.z);
    AO_PRECISE real u = n.x / sum;
    AO_PRECISE real v = n.y / sum;
    mask upper = n.z >= real(0);
    mask right = n.x >= real(0);
    mask top = n.y >= real(0);
    AO_PRECISE real folded_u = (real(1) - abs(v)) * mix(real(-1), real(1), right);
    AO_PRECISE real folded_v = (real(1) - abs(u)) * mix(real(-1), real(1), top);
    vec2 coordinates = vec2(mix(folded_u, u, upper), mix(folded_v, v, upper));
    return coordinates;
}

// The interpolated normal and tangent (any length) with the handedness (+1 or -1) as four numbers: octahedral coordinates of
// the unit normal, then of the tangent; the third is 4 more where the handedness is -1.
AO_FN vec4 ao_packed_frame(vec3 normal, vec3 tangent, real handedness)
{
    vec3 n = ao_normalize_or(normal, vec3(real(0), real(0), real(1)));
    vec2 packed_normal = ao_octahedral_coordinates(n);
    vec2 packed_tangent = ao_octahedral_coordinates(ao_normalize_or(tangent, ao_any_tangent(n)));
    mask turned = handedness < real(0);
    AO_PRECISE real marked = packed_tangent.x + mix(real(0), real(4), turned);
    vec4 stored = vec4(packed_normal.x, packed_normal.y, marked, packed_tangent.y);
    return stored;
}

// ao_mapped_normal of a packed frame, as seen from the front.
AO_FN vec3 ao_normal_of_frame(vec4 stored, vec3 texel, real green)
{
    mask turned = stored.z > real(2);
    AO_PRECISE real along = stored.z - mix(real(0), real(4), turned);
    vec3 normal = ao_octahedral_direction(stored.x, stored.y);
    vec3 tangent = ao_octahedral_direction(along, stored.w);
    return ao_mapped_normal(normal, tangent, mix(real(1), real(-1), turned), texel, green);
}

// A unit normal as the texel that stores it; the counterpart of ao_decoded_normal.
AO_FN vec4 ao_encoded_normal(int source, vec3 n)
{
    vec4 texel = vec4(n.x, n.y, n.z, real(0));
    if (source == ao_normal_unorm10) {
        AO_PRECISE vec3 code = vec3(n.x * real(0.5) + real(0.5), n.y * real(0.5) + real(0.5), n.z * real(0.5) + real(0.5));
        texel = vec4(code.x, code.y, code.z, real(1));
    }
    if (source == ao_normal_octahedral) {
        vec2 coordinates = ao_octahedral_coordinates(n);
        AO_PRECISE vec2 code = vec2(coordinates.x * real(0.5) + real(0.5), coordinates.y * real(0.5) + real(0.5));
        texel = vec4(code.x, code.y, real(0), real(0));
    }
    return texel;
}

// Normals of surfaces seen from behind (side < 0) are turned as a whole, after the map.
AO_FN vec3 ao_facing_normal(vec3 normal, real side)
{
    mask behind = side < real(0);
    AO_PRECISE vec3 reversed = vec3(-normal.x, -normal.y, -normal.z);
    return ao_select(normal, reversed, behind);
}
