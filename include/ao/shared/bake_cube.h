// A cube map of distances around a start: what is met in the middle of each texel stands for all directions of the texel (paper
// 3's depth buffers). Corners are in front of a face's camera, beside it or behind it alike: edges are planes through the camera
// and two corners, without clipping and without a near plane (Olano and Greer, "Triangle scan conversion using 2D homogeneous
// coordinates", 1997). Edges of two triangles are the same planes to the last bit. Exactness: A.

// p as the camera of a face sees it: across in x and y, ahead in z. Faces: x, -x, y, -y, z, -z; odd ones are mirrored.
AO_FN vec3 ao_cube_seen(int face, vec3 p)
{
    vec3 turned = p;
    if (face < 2) {
        turned = vec3(p.y, p.z, p.x);
    }
    else if (face < 4) {
        turned = vec3(p.z, p.x, p.y);
    }
    return vec3(turned.x, turned.y, face % 2 == 0 ? turned.z : -turned.z);
}

AO_FN int ao_cube_face_of(vec3 direction)
{
    vec3 a = vec3(abs(direction.x), abs(direction.y), abs(direction.z));
    int face = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 2 : 4;
    real along = face == 0 ? direction.x : face == 2 ? direction.y : direction.z;
    return along < real(0) ? face + 1 : face;
}

// The texel at `across`, -1 to 1, of so many in a row.
AO_FN int ao_cube_texel(real across, int texels)
{
    AO_PRECISE real place = (across * real(0.5) + real(0.5)) * real(texels);
    return int(min(max(floor(place), real(0)), real(texels - 1)));
}

// Its middle.
AO_FN real ao_cube_middle(int texel, int texels)
{
    AO_PRECISE real middle = (real(2 * texel) + real(1)) / real(texels) - real(1);
    return middle;
}

// The first and the last texel whose middle is between `low` and `high`; a thousandth of a texel more for rounding.
AO_FN int ao_cube_first(real low, int texels)
{
    AO_PRECISE real place = real(0.499) - (max(low, real(-2)) * real(0.5) + real(0.5)) * real(texels);
    return int(max(-floor(place), real(0)));
}

AO_FN int ao_cube_last(real high, int texels)
{
    AO_PRECISE real place = (min(high, real(2)) * real(0.5) + real(0.5)) * real(texels) - real(0.499);
    return int(min(floor(place), real(texels - 1)));
}

struct ao_cube_triangle {
    vec3 bc; // normals of the planes through the camera and two corners
    vec3 ca;
    vec3 ab;
    real
        volume; // six times, of the camera and the corners; below 0 where the corners are seen counter-clockwise, mirrored or not
};

// Corners as a face's camera sees them.
AO_FN ao_cube_triangle ao_cube_triangle_of(vec3 a, vec3 b, vec3 c)
{
    vec3 bc = ao_cross(b, c);
    vec3 ca = ao_cross(c, a);
    vec3 ab = ao_cross(a, b);
    ao_cube_triangle triangle = { bc, ca, ab, ao_dot(a, bc) };
    return triangle;
}

// Texels around a triangle that is wholly ahead of the camera, else all: columns first_x to last_x, rows first_y to last_y.
struct ao_cube_box {
    int first_x;
    int last_x;
    int first_y;
    int last_y;
};

AO_FN ao_cube_box ao_cube_box_of(vec3 a, vec3 b, vec3 c, int texels)
{
    ao_cube_box box = { 0, texels - 1, 0, texels - 1 };
    if (min(min(a.z, b.z), c.z) > real(1e-6)) {
        AO_PRECISE vec3 x = vec3(a.x / a.z, b.x / b.z, c.x / c.z);
        AO_PRECISE vec3 y = vec3(a.y / a.z, b.y / b.z, c.y / c.z);
        box.first_x = ao_cube_first(min(min(x.x, x.y), x.z), texels);
        box.last_x = ao_cube_last(max(max(x.x, x.y), x.z), texels);
        box.first_y = ao_cube_first(min(min(y.x, y.y), y.z), texels);
        box.last_y = ao_cube_last(max(max(y.x, y.y), y.z), texels);
    }
    return box;
}

// Whether the ray through (x, y, 1) meets it, and at which distance: -1 where it does not.
AO_FN real ao_cube_distance(ao_cube_triangle t, real x, real y)
{
    vec3 ray = vec3(x, y, real(1));
    AO_PRECISE real bc = ao_dot(t.bc, ray);
    AO_PRECISE real ca = ao_dot(t.ca, ray);
    AO_PRECISE real ab = ao_dot(t.ab, ray);
    AO_PRECISE real sum = bc + ca + ab;
    mask left = bc >= real(0) && ca >= real(0) && ab >= real(0) && sum > real(0) && t.volume > real(0);
    mask right = bc <= real(0) && ca <= real(0) && ab <= real(0) && sum < real(0) && t.volume < real(0);
    AO_PRECISE real squared = x * x + y * y + real(1);
    AO_PRECISE real distance = t.volume / mix(real(1), sum, left || right) * sqrt(squared);
    return mix(real(-1), distance, left || right);
}
