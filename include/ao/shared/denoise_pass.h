// Denoiser of the method `bitmask`: mean of a window's visibilities, each weighted by what its slices count for, by how near it
// lies to the pixel's tangent plane and, where normals are stored, by how alike they are. A pass along the rows and one along
// the columns.
// Where ao_coarse the estimates are those of the even pixels of even rows: the rows pass finds what lies between them along the
// even rows, the columns pass the odd rows.
// Callbacks: vec2 ao_load_packed(ivec2): packed visibility and eye depth, of the texel of an estimate or, for the columns, of
//            what the rows pass wrote; where ao_bent_normal asks for them, vec2 ao_load_directions(ivec2): packed mean directions
//            beside them (bent_normal.h); real ao_load_depth(ivec2): eye depth of a pixel; and those of normal_pass.h.
// Options:   int ao_filter_radius: pixels; bool ao_coarse; bool ao_parallel; bool ao_bent_normal; and those of normal_pass.h.

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
    real hidden;          // occlusion, in 4095ths, times weight
    real weight;          // in 1024ths
    real depth;           // of the pixel, eye depth, 0 for background
    ao_openness openness; // in 127ths, times weight; where ao_bent_normal asks for it, else 0
    vec3 normal;          // of the pixel
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
    AO_PRECISE real half_of_it = real(n) * real(0.5);
    return integer(half_of_it);
}

// A window along the pixel's row or, where not `rows`, its column.
AO_PASS ao_denoise_sum ao_denoise_window(ao_denoise_constants c, ivec2 pixel, bool rows)
{
    real own = ao_load_depth(pixel);
    mask foreground = ao_is_surface(own, c.background);
    real d = mix(real(1), own, foreground);
    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 direction = vec3(real(0), real(0), real(1)); // the normal as stored, of whatever space
    vec3 normal = direction;
    if (ao_normal_source == ao_normal_from_depth) {
        normal = ao_normal_of_depth(c.projection, vec2(c.width, c.height), pixel, position, ao_parallel);
    }
    else {
        direction = ao_stored_direction(pixel);
        normal = direction;
        if (ao_rotate_normals) {
            normal = ao_rotate(c.normal_to_view, direction);
        }
    }
    AO_PRECISE real sharpness = real(1) / (c.plane_constant + d * d * ao_plane_depth);
    // Along the normal: where the pixel's plane lies, what a point moves per eye depth (in parallel projection: where it is at
    // depth 0), and how that grows from pixel to pixel of the window.
    real plane = ao_dot(normal, position);
    vec3 ray = ao_view_point(c.projection, centre, ao_parallel ? real(0) : real(1), ao_parallel);
    real rise = ao_dot(normal, ray);
    AO_PRECISE real climb = rows ? normal.x * c.projection.slope_x : normal.y * c.projection.slope_y;

    // Places along the window, of texels of the packed picture; these lie `apart` pixels from each other.
    integer middle = rows ? pixel.x : pixel.y;
    integer nearest = middle;
    int apart = 1;
    int before = ao_filter_radius;
    int after = ao_filter_radius;
    real least = real(0);
    if (ao_coarse) {
        nearest = ao_halved(middle);
        apart = 2;
        before = ao_filter_radius / 2;
        after = (ao_filter_radius + 1) / 2;
        least = ao_coarse_floor;
    }
    integer row = ao_coarse ? ao_halved(pixel.y) : pixel.y; // of the packed picture, along the rows
    real size = rows ? c.width : c.height;

    real hidden = real(0);
    real weight = real(0);
    vec3 none = vec3(real(0), real(0), real(0));
    ao_openness openness = { none, none };
    for (int i = -before; i <= after; ++i) {
        integer moved = nearest + integer(i);
        integer place = moved * integer(apart);
        integer distance = place - middle;
        mask inside = moved >= integer(0) && real(place) < size;
        if (ao_coarse) {
            // As far to one side as to the other, wherever between the estimates the pixel lies.
            inside = inside && distance >= integer(-ao_filter_radius) && distance <= integer(ao_filter_radius);
        }
        integer found = mix(nearest, moved, inside);
        ivec2 texel = rows ? ivec2(found, row) : ivec2(pixel.x, found);
        vec2 other = ao_load_packed(texel);
        mask used = inside && other.x >= real(0);
        vec2 value = ao_unpack_visibility(mix(real(0), other.x, used));
        real depth = mix(real(1), other.y, used);
        AO_PRECISE real along = rise + real(distance) * climb;
        AO_PRECISE real away = (ao_parallel ? along - normal.z * depth : along * depth) - plane;
        AO_PRECISE real near = max(real(1) - away * away * sharpness, least);
        AO_PRECISE real weighed = near * near * value.y;
        if (ao_normal_source != ao_normal_from_depth) {
            integer at = found * integer(apart);
            AO_PRECISE real turned = weighed * max(ao_likeness(direction, rows ? ivec2(at, pixel.y) : ivec2(pixel.x, at)), least);
            weighed = turned;
        }
        real share = mix(real(0), weighed, used);
        AO_PRECISE real next_hidden = hidden + share * (real(ao_packed_top) - value.x);
        AO_PRECISE real next_weight = weight + share;
        hidden = next_hidden;
        weight = next_weight;
        if (ao_bent_normal) {
            vec2 directions = ao_load_directions(texel);
            ao_openness seen = ao_unpack_openness(mix(real(0), directions.x, used), mix(real(0), directions.y, used));
            openness = ao_add_openness(openness, seen, share);
        }
    }
    ao_denoise_sum sum = { hidden, mix(real(0), weight, foreground), mix(real(0), d, foreground), openness, normal };
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
    ao_denoise_sum sum = ao_denoise_window(c, pixel, true);
    AO_PRECISE real weight = sum.weight / (real(ao_packed_weight) * real(2 * ao_filter_radius + 1));
    real both = ao_pack_visibility(ao_denoised(sum), weight);
    return vec2(mix(real(-1), both, sum.weight > real(0)), sum.depth);
}

// Mean directions of a window.
AO_FN ao_openness ao_denoised_openness(ao_denoise_sum sum)
{
    mask foreground = sum.weight > real(0);
    AO_PRECISE real inverse = real(1) / (mix(real(1), sum.weight, foreground) * real(ao_packed_direction));
    vec3 none = vec3(real(0), real(0), real(0));
    ao_openness nothing = { none, none };
    return ao_add_openness(nothing, sum.openness, inverse);
}

// As above, and packed mean directions.
AO_PASS vec4 ao_denoise_rows_bent_pass(ao_denoise_constants c, ivec2 texel)
{
    ivec2 pixel = texel;
    if (ao_coarse) {
        pixel = ivec2(texel.x, texel.y * integer(2));
    }
    ao_denoise_sum sum = ao_denoise_window(c, pixel, true);
    mask foreground = sum.weight > real(0);
    AO_PRECISE real weight = sum.weight / (real(ao_packed_weight) * real(2 * ao_filter_radius + 1));
    real both = ao_pack_visibility(ao_denoised(sum), weight);
    ao_openness mean = ao_denoised_openness(sum);
    vec4 codes = vec4(mix(real(-1), both, foreground), sum.depth, mix(real(0), ao_pack_direction(mean.open), foreground),
                      mix(real(0), ao_pack_direction(mean.whole), foreground));
    return codes;
}

// Mean visibility and bent normal, as ao_bitmask_bent_pass returns them; the normal itself where no estimate counts.
AO_PASS vec4 ao_denoise_columns_bent_pass(ao_denoise_constants c, ivec2 pixel)
{
    ao_denoise_sum sum = ao_denoise_window(c, pixel, false);
    real visibility = ao_denoised(sum);
    vec3 bent = ao_bent_normal_of(ao_denoised_openness(sum), visibility, sum.normal);
    return ao_bent_texel(visibility, ao_select(vec3(real(0), real(0), real(1)), bent, sum.depth > real(0)));
}

AO_PASS real ao_denoise_columns_pass(ao_denoise_constants c, ivec2 pixel)
{
    return ao_denoised(ao_denoise_window(c, pixel, false));
}
