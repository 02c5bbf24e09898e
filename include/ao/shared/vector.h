// Vector algebra with the order of evaluation spelled out: GLSL leaves it open for dot, cross, normalize and mix, and two
// routes into one driver differ there (numerics.md 3.2). Exactness: E for sums and products, Q for ao_normalize_or.

// b where m holds, a elsewhere.
AO_FN vec3 ao_select(vec3 a, vec3 b, mask m)
{
    vec3 chosen = vec3(mix(a.x, b.x, m), mix(a.y, b.y, m), mix(a.z, b.z, m));
    return chosen;
}

AO_FN real ao_dot(vec3 a, vec3 b)
{
    AO_PRECISE real sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

AO_FN vec3 ao_cross(vec3 a, vec3 b)
{
    AO_PRECISE real x = a.y * b.z - a.z * b.y;
    AO_PRECISE real y = a.z * b.x - a.x * b.z;
    AO_PRECISE real z = a.x * b.y - a.y * b.x;
    vec3 product = vec3(x, y, z);
    return product;
}

// v / |v| where 1e-15 <= |v| <= 1e15, else `fallback`: zero, denormal, huge, infinite and NaN vectors are all defined.
AO_FN vec3 ao_normalize_or(vec3 v, vec3 fallback)
{
    AO_PRECISE real squared = ao_dot(v, v);
    mask usable = squared >= real(1e-30) && squared <= real(1e30);
    AO_PRECISE real norm = sqrt(mix(real(1), squared, usable));
    AO_PRECISE vec3 unit = vec3(v.x / norm, v.y / norm, v.z / norm);
    return ao_select(fallback, unit, usable);
}

// A rotation by its rows; the fourth real of each is padding.
struct ao_rotation {
    real xx;
    real xy;
    real xz;
    real x_reserved;
    real yx;
    real yy;
    real yz;
    real y_reserved;
    real zx;
    real zy;
    real zz;
    real z_reserved;
};

AO_FN vec3 ao_rotate(ao_rotation m, vec3 v)
{
    AO_PRECISE real x = m.xx * v.x + m.xy * v.y + m.xz * v.z;
    AO_PRECISE real y = m.yx * v.x + m.yy * v.y + m.yz * v.z;
    AO_PRECISE real z = m.zx * v.x + m.zy * v.y + m.zz * v.z;
    vec3 rotated = vec3(x, y, z);
    return rotated;
}
