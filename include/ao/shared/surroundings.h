// Light from all around, from an equirectangular picture of linear RGB: its middle is -Z, right of it +X, its first row +Y.
// Callbacks: vec3 ao_load_surroundings(uint index), index = row * width + column. Exactness: Q, for the direction's angles.

AO_FN vec3 ao_lerp(vec3 a, vec3 b, real weight)
{
    vec3 sum = vec3(ao_lerp(a.x, b.x, weight), ao_lerp(a.y, b.y, weight), ao_lerp(a.z, b.z, weight));
    return sum;
}

// Towards d, of length about 1: bilinear between the middles of texels; goes around in azimuth, ends at the first and last row.
// width, height: whole numbers, 1 to 16384.
AO_PASS vec3 ao_surroundings(real width, real height, vec3 d)
{
    vec2 uv = ao_equirectangular(d);
    AO_PRECISE real column = uv.x * width - real(0.5);
    AO_PRECISE real row = uv.y * height - real(0.5);
    real left = floor(column);
    real top = floor(row);
    AO_PRECISE real across = column - left;
    AO_PRECISE real down = row - top;
    integer x = integer(left);
    integer y = integer(top);
    uint x0 = uint(ao_wrapped_texel(x, integer(width), uint(ao_wrap_repeat)));
    uint x1 = uint(ao_wrapped_texel(x + integer(1), integer(width), uint(ao_wrap_repeat)));
    uint y0 = uint(ao_wrapped_texel(y, integer(height), uint(ao_wrap_clamp))) * uint(width);
    uint y1 = uint(ao_wrapped_texel(y + integer(1), integer(height), uint(ao_wrap_clamp))) * uint(width);
    vec3 upper = ao_lerp(ao_load_surroundings(y0 + x0), ao_load_surroundings(y0 + x1), across);
    vec3 lower = ao_lerp(ao_load_surroundings(y1 + x0), ao_load_surroundings(y1 + x1), across);
    return ao_lerp(upper, lower, down);
}
