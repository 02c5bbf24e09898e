// Denoiser of the method `bitmask`: mean of a window's visibilities, each weighted by what its slices count for, by how near it
// lies to the pixel's tangent plane and, where normals are stored, by how alike they are. A pass along the rows and one along
// the columns.
// Where ao_coarse the estimates are those of the even pixels of even rows: the rows pass finds what lies between them along the
// even rows, the columns pass the odd rows.
// Callbacks: vec2 ao_load_packed(ivec2): packed visibility and eye depth, of the texel of an estimate or, for the columns, of
//            what the rows pass wrote; real ao_load_depth(ivec2): eye depth of a pixel; and those of normal_pass.h.
// Options:   int ao_filter_radius: pixels; bool ao_coarse; bool ao_parallel; and those of normal_pass.h.

struct ao_denoise_constants {
    ao_projection projection;
    ao_rotation normal_to_view;
    real width; // pixels
    real height;
    real plane_constant; // squared scene units
    real background;     // eye depths from here on are background
};

// Squared distances from the tangent plane at which a neighbour counts for nothing: plane_constant + d^2 * this.
AO_CONST real ao_plane_depth = real(4e-6);
// What a neighbour on another surface counts for, for distance and for direction, where no estimate lies on the pixel's own.
AO_CONST real ao_coarse_floor = real(0.001);

// What a window holds of the pixel's surface.
struct ao_denoise_sum {
    real hidden; // occlusion, in 4095ths, times weight
    real weight; // in 1024ths
    real depth;  // of the pixel, eye depth, 0 for background
};

// The cosine between a unit direction and a texel's normal, as they are stored, to the fourth power; 0 from a right angle on and
// for a normal that is none.
AO_PASS real ao_likeness(vec3 direction, ivec2 texel)
{
    vec3 other = ao_decoded_normal(ao_normal_source, ao_load_normal(texel));
    real squared = ao_dot(other, other);
    real along = ao_dot(direction, other);
    mask usable = along > real(0) && squared > real(1e-30) && squared < real(1e30);
    AO_PRECISE real inverse = ao_inverse_root(mix(real(1), squared, usable));
    AO_PRECISE real cosine = mix(real(0), along, usable) * inverse;
    AO_PRECISE real square = cosine * cosine;
    AO_PRECISE real likeness = square * square;
    return likeness;
}

// Half a whole number of 0 or more, rounded down.
AO_FN integer ao_halved(integer n)
{
    return integer(real(n) * real(0.5));
}

// Along the rows step_x is 1 and step_y 0, along the columns the other way round.
AO_PASS ao_denoise_sum ao_denoise_window(ao_denoise_constants c, ivec2 pixel, int step_x, int step_y)
{
    real own = ao_load_depth(pixel);
    mask foreground = ao_is_surface(own, c.background);
    real d = mix(real(1), own, foreground);
    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 normal = ao_shading_normal(c.projection, c.normal_to_view, vec2(c.width, c.height), pixel, position, ao_parallel);
    real plane = ao_dot(normal, position);
    vec3 direction = vec3(real(0), real(0), real(1)); // the normal as stored, of whatever space
    if (ao_normal_source != ao_normal_from_depth) {
        direction = ao_stored_direction(pixel);
    }
    AO_PRECISE real sharpness = real(1) / (c.plane_constant + d * d * ao_plane_depth);

    // Texels of the packed picture, and how many pixels apart these lie.
    int apart_x = ao_coarse ? 1 + step_x : 1;
    int apart_y = ao_coarse ? 2 : 1;
    ivec2 nearest = pixel;
    int before = ao_filter_radius;
    int after = ao_filter_radius;
    if (ao_coarse) {
        nearest = ivec2(step_x == 1 ? ao_halved(pixel.x) : pixel.x, ao_halved(pixel.y));
        before = ao_filter_radius / 2;
        after = (ao_filter_radius + 1) / 2;
    }
    real least = ao_coarse ? ao_coarse_floor : real(0);

    real hidden = real(0);
    real weight = real(0);
    for (int i = -before; i <= after; ++i) {
        integer column = nearest.x + integer(i * step_x);
        integer row = nearest.y + integer(i * step_y);
        ivec2 place = ivec2(column * integer(apart_x), row * integer(apart_y));
        mask inside = column >= integer(0) && real(place.x) < c.width && row >= integer(0) && real(place.y) < c.height;
        if (ao_coarse) {
            // As far to one side as to the other, wherever between the estimates the pixel lies.
            integer distance = step_x == 1 ? place.x - pixel.x : place.y - pixel.y;
            inside = inside && distance >= integer(-ao_filter_radius) && distance <= integer(ao_filter_radius);
        }
        ivec2 texel = ivec2(mix(nearest.x, column, inside), mix(nearest.y, row, inside));
        vec2 other = ao_load_packed(texel);
        mask used = inside && other.x >= real(0);
        vec2 value = ao_unpack_visibility(mix(real(0), other.x, used));
        AO_PRECISE vec2 there = vec2(real(place.x) + real(0.5), real(place.y) + real(0.5));
        vec3 seen = ao_view_point(c.projection, there, mix(real(1), other.y, used), ao_parallel);
        AO_PRECISE real away = ao_dot(normal, seen) - plane;
        AO_PRECISE real near = max(real(1) - away * away * sharpness, least);
        AO_PRECISE real weighed = near * near * value.y;
        if (ao_normal_source != ao_normal_from_depth) {
            ivec2 at = ivec2(texel.x * integer(apart_x), texel.y * integer(apart_y));
            AO_PRECISE real turned = weighed * max(ao_likeness(direction, at), least);
            weighed = turned;
        }
        real share = mix(real(0), weighed, used);
        AO_PRECISE real next_hidden = hidden + share * (real(ao_packed_top) - value.x);
        AO_PRECISE real next_weight = weight + share;
        hidden = next_hidden;
        weight = next_weight;
    }
    ao_denoise_sum sum = { hidden, mix(real(0), weight, foreground), mix(real(0), d, foreground) };
    return sum;
}

// Mean visibility of a window, in [0, 1]; 1 on background.
AO_FN real ao_denoised(ao_denoise_sum sum)
{
    mask foreground = sum.weight > real(0);
    AO_PRECISE real mean = real(1) - sum.hidden / (mix(real(1), sum.weight, foreground) * real(ao_packed_top));
    return mix(real(1), max(mean, real(0)), foreground);
}

// `texel`: of what is written: the pixel, or where ao_coarse the one in the row at twice its place.
AO_PASS vec2 ao_denoise_rows_pass(ao_denoise_constants c, ivec2 texel)
{
    ivec2 pixel = texel;
    if (ao_coarse) {
        pixel = ivec2(texel.x, texel.y * integer(2));
    }
    ao_denoise_sum sum = ao_denoise_window(c, pixel, 1, 0);
    AO_PRECISE real weight = sum.weight / (real(ao_packed_weight) * real(2 * ao_filter_radius + 1));
    real both = ao_pack_visibility(ao_denoised(sum), weight);
    return vec2(mix(real(-1), both, sum.weight > real(0)), sum.depth);
}

AO_PASS real ao_denoise_columns_pass(ao_denoise_constants c, ivec2 pixel)
{
    return ao_denoised(ao_denoise_window(c, pixel, 0, 1));
}
