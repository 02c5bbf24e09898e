// Ambient occlusion from slices of the hemisphere with a visibility bitmask: horizon search (Bavoil et al. 2008; Jimenez et al.
// 2016) whose occluders are columns of finite thickness (Therrien et al. 2023), their sectors equal in cosine-weighted measure.
// Callbacks: vec2 ao_load_rotation(ivec2), vec4 ao_tap(int): the tables of ao/slices.hpp; and those of normal_pass.h and
//            slice_taps.h.
// Options:   int ao_tap_count: of all slices; int ao_slice_count; bool ao_mark_background; bool ao_coarse: one estimate per 2x2
//            pixels; and those of normal_pass.h and slice_taps.h.

struct ao_bitmask_result {
    real visibility; // [0, 1]; on background 1, or -1 where ao_mark_background asks for a mark
    real weight;     // what it counts for among neighbours, [0, pi]
    real depth;      // eye depth, 0 for background
};

// `texel`: of what is written; it is the pixel itself, or where ao_coarse the one at twice its place.
AO_PASS ao_bitmask_result ao_bitmask_pass(ao_occlusion_constants c, ivec2 texel)
{
    ivec2 pixel = texel;
    if (ao_coarse) {
        pixel = ivec2(texel.x * integer(2), texel.y * integer(2));
    }
    real stored = ao_load_depth(pixel);
    mask foreground = ao_is_surface(stored, c.background);
    real d = mix(real(1), stored, foreground);

    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 normal = ao_shading_normal(c.projection, c.normal_to_view, vec2(c.width, c.height), pixel, position, ao_parallel);
    AO_PRECISE real bias = c.bias + d * (c.bias_linear + d * c.bias_quadratic);
    ao_slice_space space =
        ao_make_slice_space(c.projection, vec2(c.width, c.height), centre, normal, d, c.radius, c.thickness, bias, c.background);
    vec2 turn = ao_load_rotation(ao_tile_texel(texel));
    int steps = ao_tap_count / ao_slice_count;
    AO_PRECISE real step_share = real(1) / real(steps);

    real open = real(0);
    real total = real(0);
    for (int s = 0; s < ao_slice_count; ++s) {
        vec4 slice_turn = ao_tap(steps * s);
        ao_slice_walk walk = ao_make_slice_walk(space, c.projection, turn.x, vec2(slice_turn.x, slice_turn.y));
        uint blocked = uint(0u);
        AO_UNROLL
        for (int k = 0; k < steps; ++k) {
            real share = ao_step_share(ao_tap(steps * s + k), turn.y, step_share);
            blocked = blocked | ao_look_along(space, c.projection, walk, pixel, share).blocked;
        }
        AO_PRECISE real clear = real(1) - ao_sectors_in(blocked) / real(ao_sector_count);
        AO_PRECISE real next_open = open + walk.slice.weight * clear;
        AO_PRECISE real next_total = total + walk.slice.weight;
        open = next_open;
        total = next_total;
    }
    mask weighed = total > real(0);
    AO_PRECISE real mean = open / mix(real(1), total, weighed);
    real visibility = mix(real(1), min(mean, real(1)), weighed);
    AO_PRECISE real weight = total / real(ao_slice_count);
    real outside = ao_mark_background ? real(-1) : real(1);
    ao_bitmask_result result = { mix(outside, visibility, foreground), mix(real(0), weight, foreground),
                                 mix(real(0), d, foreground) };
    return result;
}

// The same as the denoiser takes it: packed_visibility.h, and eye depth.
AO_PASS vec2 ao_bitmask_packed_pass(ao_occlusion_constants c, ivec2 texel)
{
    ao_bitmask_result r = ao_bitmask_pass(c, texel);
    mask foreground = r.depth > real(0);
    real both = ao_pack_visibility(mix(real(1), r.visibility, foreground), r.weight);
    return vec2(mix(real(-1), both, foreground), r.depth);
}
