// Denoiser of the method `bitmask`: mean of a window's visibilities, each weighted by what its slices count for, by how near it
// lies to the pixel's tangent plane and, where normals are stored, by how alike they are. A pass along the rows and one along
// the columns.
// Callbacks: vec2 ao_load_packed(ivec2): packed visibility and eye depth; where ao_bent_normal asks for them, vec2
//            ao_load_directions(ivec2): packed mean directions (bent_normal.h); and those of normal_pass.h.
// Options:   int ao_filter_radius; bool ao_parallel; bool ao_bent_normal; and those of normal_pass.h.

struct ao_denoise_constants {
    ao_projection projection;
    ao_rotation normal_to_view;
    real width; // pixels
    real height;
    real plane_constant; // 1 / scale of squared distances from the plane: constant + d^2 linear, squared scene units
    real plane_depth;
};

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

// Along the rows step_x is 1 and step_y 0, along the columns the other way round.
AO_PASS ao_denoise_sum ao_denoise_window(ao_denoise_constants c, ivec2 pixel, int step_x, int step_y)
{
    vec2 own = ao_load_packed(pixel);
    mask foreground = own.x >= real(0);
    real d = mix(real(1), own.y, foreground);
    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 normal = ao_shading_normal(c.projection, c.normal_to_view, vec2(c.width, c.height), pixel, position, ao_parallel);
    real plane = ao_dot(normal, position);
    vec3 direction = vec3(real(0), real(0), real(1)); // the normal as stored, of whatever space
    if (ao_normal_source != ao_normal_from_depth) {
        direction = ao_stored_direction(pixel);
    }
    AO_PRECISE real sharpness = real(1) / (c.plane_constant + d * d * c.plane_depth);

    real hidden = real(0);
    real weight = real(0);
    vec3 none = vec3(real(0), real(0), real(0));
    ao_openness openness = { none, none };
    for (int i = -ao_filter_radius; i <= ao_filter_radius; ++i) {
        integer column = pixel.x + integer(i * step_x);
        integer row = pixel.y + integer(i * step_y);
        mask inside = column >= integer(0) && real(column) < c.width && row >= integer(0) && real(row) < c.height;
        ivec2 texel = ivec2(mix(pixel.x, column, inside), mix(pixel.y, row, inside));
        vec2 other = ao_load_packed(texel);
        mask used = inside && other.x >= real(0);
        vec2 value = ao_unpack_visibility(mix(real(0), other.x, used));
        AO_PRECISE vec2 there = vec2(real(column) + real(0.5), real(row) + real(0.5));
        vec3 seen = ao_view_point(c.projection, there, mix(real(1), other.y, used), ao_parallel);
        AO_PRECISE real away = ao_dot(normal, seen) - plane;
        AO_PRECISE real near = max(real(1) - away * away * sharpness, real(0));
        AO_PRECISE real weighed = near * near * value.y;
        if (ao_normal_source != ao_normal_from_depth) {
            AO_PRECISE real turned = weighed * ao_likeness(direction, texel);
            weighed = turned;
        }
        real share = mix(real(0), weighed, used);
        AO_PRECISE real next_hidden = hidden + share * (real(ao_packed_top) - value.x);
        AO_PRECISE real next_weight = weight + share;
        hidden = next_hidden;
        weight = next_weight;
        if (ao_bent_normal) {
            vec2 directions = ao_load_directions(texel);
            ao_openness seen_there = ao_unpack_openness(mix(real(0), directions.x, used), mix(real(0), directions.y, used));
            openness = ao_add_openness(openness, seen_there, share);
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

AO_PASS vec2 ao_denoise_rows_pass(ao_denoise_constants c, ivec2 pixel)
{
    ao_denoise_sum sum = ao_denoise_window(c, pixel, 1, 0);
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
AO_PASS vec4 ao_denoise_rows_bent_pass(ao_denoise_constants c, ivec2 pixel)
{
    ao_denoise_sum sum = ao_denoise_window(c, pixel, 1, 0);
    mask foreground = sum.weight > real(0);
    AO_PRECISE real weight = sum.weight / (real(ao_packed_weight) * real(2 * ao_filter_radius + 1));
    real both = ao_pack_visibility(ao_denoised(sum), weight);
    ao_openness mean = ao_denoised_openness(sum);
    vec4 codes = vec4(mix(real(-1), both, foreground), sum.depth, mix(real(0), ao_pack_direction(mean.open), foreground),
                      mix(real(0), ao_pack_direction(mean.whole), foreground));
    return codes;
}

// Mean visibility and bent normal, as ao_bitmask_bent_pass returns them.
AO_PASS vec4 ao_denoise_columns_bent_pass(ao_denoise_constants c, ivec2 pixel)
{
    ao_denoise_sum sum = ao_denoise_window(c, pixel, 0, 1);
    real visibility = ao_denoised(sum);
    vec3 bent = ao_bent_normal_of(ao_denoised_openness(sum), visibility, sum.normal);
    return ao_bent_texel(visibility, ao_select(vec3(real(0), real(0), real(1)), bent, sum.weight > real(0)));
}

AO_PASS real ao_denoise_columns_pass(ao_denoise_constants c, ivec2 pixel)
{
    return ao_denoised(ao_denoise_window(c, pixel, 0, 1));
}
