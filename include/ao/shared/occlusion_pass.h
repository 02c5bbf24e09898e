// Screen-space ambient occlusion over a kernel of offsets in tangent space (paper 1, stage 2): k is the share of offsets
// that end up behind the depth buffer, visibility is 1 - k.
// Callbacks: vec2 ao_load_rotation(ivec2): helper V_r of the frame, from a tile of ao_tile_size squared;
//            vec4 ao_tap(int): offset in tangent space, normal along +z, in units of the radius;
//            and those of normal_pass.h and occlusion_tap.h.
// Options:   int ao_tap_count, bool ao_mark_background; and those of normal_pass.h and occlusion_tap.h.

// Visibility in [0, 1]; on background 1, or -1 where ao_mark_background asks for a mark that the filter understands.
// An offset behind the eye or over background is not occluded; occlusion_tap.h tells of those off the picture.
AO_PASS real ao_occlusion_pass(ao_occlusion_constants c, ivec2 pixel)
{
    real stored = ao_load_depth(pixel);
    mask foreground = ao_is_surface(stored, c.background);
    real d = mix(real(1), stored, foreground);

    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 normal = ao_shading_normal(c.projection, c.normal_to_view, vec2(c.width, c.height), pixel, position, ao_parallel);
    vec2 helper = ao_load_rotation(ao_tile_texel(pixel));
    ao_frame frame = ao_gram_schmidt(normal, vec3(helper.x, helper.y, real(0)));

    AO_PRECISE real bias = c.bias + d * (c.bias_linear + d * c.bias_quadratic);
    ao_tap_space space = ao_make_tap_space(c.projection, vec2(c.width, c.height), position, frame, d, c.radius);

    real occluded = real(0);
    AO_UNROLL
    for (int i = 0; i < ao_tap_count; ++i) {
        ao_tap_seen seen = ao_look(space, c.projection, ao_tap(i), bias, c.thickness);
        AO_PRECISE real next = occluded + mix(real(0), real(1), seen.hit);
        occluded = next;
    }
    // Hardware may round n / n above 1; below 0 would mean background to the filter.
    AO_PRECISE real visibility = max(real(1) - occluded / real(ao_tap_count), real(0));
    real outside = ao_mark_background ? real(-1) : real(1);
    return mix(outside, visibility, foreground);
}
