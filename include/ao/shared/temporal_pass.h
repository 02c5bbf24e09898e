// Temporal ambient occlusion (paper 2): new samples of this frame are added to what the last frames know of the same surface
// point. Callbacks: real ao_load_depth(ivec2): eye depth of this frame, 0 or less, NaN or infinite for background;
//            real ao_load_own_depth(ivec2): the same, of the pixel itself;
//            vec4 ao_load_motion(ivec2): xy in the host's convention, z eye depth in the last frame, 0 where it is not known;
//            uvec4 ao_load_history(uint): of the last frame (history_load.h);
//            ao_history_row ao_load_history_row(uint, uint, uint, uint): four of them, mostly side by side (history_row.h);
//            vec2 ao_load_rotation(ivec2): from a tile of ao_tile_size squared;
//            vec4 ao_load_tap(uint): an offset of the sequence, in tangent space (ritschel) or on the unit disc (fox_compton), or
//            a tap of a slice as in ao/slices.hpp (bitmask); and those of normal_pass.h, occlusion_tap.h and slice_taps.h.
// Options:   int ao_most_samples: the larger of k1 and k2; int ao_contribution (ao_ritschel, ao_fox_compton, ao_bitmask);
//            int ao_slice_taps: of one slice (bitmask), of which k1, k2 and the period are multiples;
//            bool ao_reproject: else camera and scene stand still; bool ao_use_motion; bool ao_cubic: histories
//            between pixels by Catmull-Rom, else bilinear; int ao_invalidation (ao_keep_weight, ao_smooth_weight,
//            ao_clamp_weight); and those of normal_pass.h, occlusion_tap.h and slice_taps.h.
// "Previous" means view space, pixels and depth of the last frame.

AO_CONST int ao_ritschel = 0;
AO_CONST int ao_fox_compton = 1;
AO_CONST int ao_bitmask = 2;
AO_CONST int ao_keep_weight = 0;
AO_CONST int ao_smooth_weight = 1;
AO_CONST int ao_clamp_weight = 2;

struct ao_temporal_constants {
    ao_projection projection;
    ao_projection previous_projection;
    ao_affine_reals to_previous; // view space of this frame to that of the last, of what stands still in the world
    ao_rotation normal_to_view;
    real radius; // scene units
    real bias;   // as in ao_occlusion_constants
    real bias_linear;
    real bias_quadratic;
    real thickness;
    real background; // eye depths from here on are background
    real width;      // pixels
    real height;
    real motion_scale_x; // previous pixel = pixel + motion * scale + offset
    real motion_scale_y;
    real motion_offset_x;
    real motion_offset_y;
    real tolerance;          // of the depth test, as a share of the depth
    real steepness;          // S / R
    real history;            // 1, or 0 where there is no last frame to believe
    real period;             // samples before the sequence starts again
    real most_weight;        // w_max
    real first_samples;      // k1, while weight < adaptive_weight
    real later_samples;      // k2
    real adaptive_weight;    // c_adaptive w_max
    real rotation_weight;    // c_rot w_max: the pattern is turned from pixel to pixel while weight is less
    real clamped_weight;     // of a history whose neighbourhood changed (ao_clamp_weight)
    real strength;           // fox_compton: scene units
    real least_distance;     // fox_compton: scene units
    real largest;            // fox_compton: of one contribution, (0, 1]
    real tolerance_constant; // of the depth test, scene units
    real moving_weight;      // most_weight of a history that comes from another place on the picture
    real motion_error;       // of depths and positions that come from the motion picture, as a share of the depth
};

// Whether a history is one at all: a frame never written, or poisoned, is not. NaN fails every comparison.
AO_FN mask ao_usable_history(ao_temporal_constants c, ao_history h)
{
    mask usable = c.history > real(0) && h.weight >= real(1) && h.value >= real(0) && h.value <= real(1) && h.index >= real(0) &&
                  h.index < c.period && h.depth > real(0);
    return usable;
}

// Where a surface point was in the last frame.
struct ao_previous {
    vec3 position;
    vec2 pixel;
    mask inside; // the picture, and in front of the eye
};

AO_PASS ao_previous ao_previous_of(ao_temporal_constants c, ivec2 texel, vec3 position)
{
    vec3 was = ao_transform_point(ao_affine_of(c.to_previous), position);
    mask ahead = was.z < real(-1e-30) || ao_parallel;
    vec2 pixel = ao_to_pixel(c.previous_projection, vec3(was.x, was.y, mix(real(-1), was.z, ahead)), ao_parallel);
    if (ao_use_motion) {
        vec4 motion = ao_load_motion(texel);
        AO_PRECISE real x = real(texel.x) + real(0.5) + (motion.x * c.motion_scale_x + c.motion_offset_x);
        AO_PRECISE real y = real(texel.y) + real(0.5) + (motion.y * c.motion_scale_y + c.motion_offset_y);
        mask known = ao_is_surface(motion.z, c.background);
        real d = mix(-was.z, motion.z, known);
        pixel = vec2(x, y);
        ahead = d > real(0);
        was = ao_view_point(c.previous_projection, pixel, d, ao_parallel);
    }
    mask inside = ahead && pixel.x >= real(0) && pixel.x < c.width && pixel.y >= real(0) && pixel.y < c.height;
    ao_previous previous = { was, vec2(mix(real(0.5), pixel.x, inside), mix(real(0.5), pixel.y, inside)), inside };
    return previous;
}

// A texel between which histories are interpolated, and whether it shows the same surface.
struct ao_recalled_texel {
    real value;
    mask usable;
};

AO_PASS ao_recalled_texel ao_recall_texel(uvec4 words, real nearest, real farthest)
{
    ao_history at = ao_unpacked_history(words, ao_history_format);
    mask usable = at.value >= real(0) && at.value <= real(1) && at.depth >= nearest && at.depth <= farthest;
    ao_recalled_texel texel = { at.value, usable };
    return texel;
}

// Sums over a row of such texels.
struct ao_recalled_row {
    real linear; // of the usable ones of texels 0 and 1, by linear weights
    real linear_weight;
    real cubic;  // where ao_cubic, of all four, by `cubic`; of no meaning where one is not usable
    mask usable; // where ao_cubic: all four
};

// `columns`: texels -1 ... 2, clamped to the picture.
AO_PASS ao_recalled_row ao_recall_row(real width, integer column_0, integer column_1, integer column_2, integer column_3,
                                      integer row, real across, vec4 cubic, real nearest, real farthest)
{
    ao_history_row words =
        ao_load_history_row(ao_history_place(ivec2(column_0, row), width), ao_history_place(ivec2(column_1, row), width),
                            ao_history_place(ivec2(column_2, row), width), ao_history_place(ivec2(column_3, row), width));
    ao_recalled_texel b = ao_recall_texel(words.second, nearest, farthest);
    ao_recalled_texel c = ao_recall_texel(words.third, nearest, farthest);
    AO_PRECISE real before = real(1) - across;
    AO_PRECISE real linear = mix(real(0), before * b.value, b.usable) + mix(real(0), across * c.value, c.usable);
    AO_PRECISE real linear_weight = mix(real(0), before, b.usable) + mix(real(0), across, c.usable);
    ao_recalled_row sums = { linear, linear_weight, real(0), b.usable };
    if (ao_cubic) {
        ao_recalled_texel a = ao_recall_texel(words.first, nearest, farthest);
        ao_recalled_texel d = ao_recall_texel(words.fourth, nearest, farthest);
        AO_PRECISE real sum = cubic.x * a.value + cubic.y * b.value + cubic.z * c.value + cubic.w * d.value;
        ao_recalled_row all = { linear, linear_weight, sum, a.usable && b.usable && c.usable && d.usable };
        sums = all;
    }
    return sums;
}

// The texel of a row or column of `size` that is nearest to x, a whole number.
AO_FN integer ao_texel_within(real x, real size)
{
    AO_PRECISE real last = size - real(1);
    return integer(min(max(x, real(0)), last));
}

// What the last frame knows of a surface point: weight 0 where that is nothing. `slope`: change of depth per pixel.
AO_PASS ao_history ao_recalled_history(ao_temporal_constants c, vec2 centre, ao_previous previous, real slope)
{
    ivec2 nearest = ivec2(integer(previous.pixel.x), integer(previous.pixel.y));
    ao_history h = ao_history_at(nearest, c.width);
    AO_PRECISE real expected = -previous.position.z;
    // Index, weight and depth come from the nearest pixel. It is half a pixel away at most along each axis, the cubic's texels
    // two.
    real near_tolerance = ao_depth_tolerance(expected, c.tolerance, c.tolerance_constant, c.bias_linear, c.bias_quadratic, slope);
    AO_PRECISE real wide_tolerance = near_tolerance + real(3) * slope;
    mask kept = previous.inside && ao_usable_history(c, h) && ao_same_surface(expected, h.depth, near_tolerance);

    AO_PRECISE real nearest_depth = max(expected - wide_tolerance, real(1e-30));
    AO_PRECISE real farthest_depth = expected + wide_tolerance;
    AO_PRECISE real left = floor(previous.pixel.x - real(0.5));
    AO_PRECISE real top = floor(previous.pixel.y - real(0.5));
    AO_PRECISE real across = previous.pixel.x - real(0.5) - left;
    AO_PRECISE real down = previous.pixel.y - real(0.5) - top;
    integer column_0 = ao_texel_within(left - real(1), c.width);
    integer column_1 = ao_texel_within(left, c.width);
    integer column_2 = ao_texel_within(left + real(1), c.width);
    integer column_3 = ao_texel_within(left + real(2), c.width);
    vec4 cubic_across = ao_cubic_weights(across);
    ao_recalled_row second = ao_recall_row(c.width, column_0, column_1, column_2, column_3, ao_texel_within(top, c.height),
                                           across, cubic_across, nearest_depth, farthest_depth);
    ao_recalled_row third =
        ao_recall_row(c.width, column_0, column_1, column_2, column_3, ao_texel_within(top + real(1), c.height), across,
                      cubic_across, nearest_depth, farthest_depth);
    AO_PRECISE real above = real(1) - down;
    AO_PRECISE real linear = above * second.linear + down * third.linear;
    AO_PRECISE real linear_weight = above * second.linear_weight + down * third.linear_weight;
    mask any = linear_weight > real(0);
    AO_PRECISE real linear_mean = linear / mix(real(1), linear_weight, any);
    real value = mix(h.value, linear_mean, any);
    if (ao_cubic) {
        ao_recalled_row first =
            ao_recall_row(c.width, column_0, column_1, column_2, column_3, ao_texel_within(top - real(1), c.height), across,
                          cubic_across, nearest_depth, farthest_depth);
        ao_recalled_row fourth =
            ao_recall_row(c.width, column_0, column_1, column_2, column_3, ao_texel_within(top + real(2), c.height), across,
                          cubic_across, nearest_depth, farthest_depth);
        vec4 cubic_down = ao_cubic_weights(down);
        AO_PRECISE real sum =
            cubic_down.x * first.cubic + cubic_down.y * second.cubic + cubic_down.z * third.cubic + cubic_down.w * fourth.cubic;
        value = mix(value, sum, first.usable && second.usable && third.usable && fourth.usable);
    }
    AO_PRECISE real moved = abs(previous.pixel.x - centre.x) + abs(previous.pixel.y - centre.y);
    real most = mix(c.most_weight, min(c.most_weight, c.moving_weight), moved > real(0.015625));
    ao_history recalled = { mix(real(0), min(max(value, real(0)), real(1)), kept), mix(real(0), min(h.weight, most), kept),
                            mix(real(0), h.index, ao_usable_history(c, h)), h.depth };
    return recalled;
}

// The same where camera and scene stand still: the pixel's own history as it is.
AO_PASS ao_history ao_own_history(ao_temporal_constants c, ivec2 pixel)
{
    ao_history h = ao_history_at(pixel, c.width);
    mask usable = ao_usable_history(c, h);
    ao_history own = { mix(real(0), h.value, usable), mix(real(0), min(h.weight, c.most_weight), usable),
                       mix(real(0), h.index, usable), h.depth };
    return own;
}

// delta of (9) for the surface point seen by a tap, 0 where it cannot matter: behind the tangent plane in both frames, out of
// reach, or out of the last picture; and where it is what depths and motion are rounded by. `was`, `normal_was`: of the pixel
// itself, in the last frame. `slope`: change of depth per pixel; what is near slopes as the pixel does.
AO_PASS real ao_neighbour_change(ao_temporal_constants c, ao_tap_seen seen, vec3 position, vec3 normal, vec3 was, vec3 normal_was,
                                 real bias, real slope)
{
    mask surface = ao_is_surface(seen.surface, c.background);
    AO_PRECISE vec2 centre = vec2(real(seen.texel.x) + real(0.5), real(seen.texel.y) + real(0.5));
    vec3 point = ao_view_point(c.projection, centre, mix(real(1), seen.surface, surface), ao_parallel);
    ao_previous before = ao_previous_of(c, seen.texel, point);
    real stored = ao_history_at(ivec2(integer(before.pixel.x), integer(before.pixel.y)), c.width).depth;
    mask usable = c.history > real(0) && stored > real(0) && stored < real(1e30);
    AO_PRECISE real expected = -before.position.z;
    real tolerance = ao_depth_tolerance(expected, c.tolerance, c.tolerance_constant, c.bias_linear, c.bias_quadratic, slope);
    mask same = usable && ao_same_surface(expected, stored, tolerance);
    vec3 stood = ao_view_point(c.previous_projection, before.pixel, mix(real(1), stored, usable), ao_parallel);
    vec3 then = ao_select(stood, before.position, same);

    AO_PRECISE vec3 now_offset = vec3(point.x - position.x, point.y - position.y, point.z - position.z);
    AO_PRECISE vec3 then_offset = vec3(then.x - was.x, then.y - was.y, then.z - was.z);
    AO_PRECISE real now_height = ao_dot(now_offset, normal);
    AO_PRECISE real then_height = ao_dot(then_offset, normal_was);
    mask near_now = now_height > bias;
    mask near_then = then_height > bias;
    mask matters = surface && before.inside && (near_now || (usable && near_then));
    real change = real(0);
    // On most of a picture everything near lies in the pixel's own plane.
    if (ao_any(matters)) {
        AO_PRECISE real now_distance = sqrt(ao_dot(now_offset, now_offset));
        AO_PRECISE real then_distance = sqrt(ao_dot(then_offset, then_offset));
        AO_PRECISE real difference = abs(now_distance - then_distance);
        if (ao_contribution == ao_fox_compton || ao_limit_thickness) {
            // What is farther occludes nothing: a change there is no change.
            AO_PRECISE real reach = ao_contribution == ao_fox_compton ? c.radius : c.radius + c.thickness;
            near_now = near_now && now_distance < reach;
            near_then = near_then && then_distance < reach;
        }
        // Where the last frame saw no surface, one has come.
        real rounded =
            ao_depth_tolerance(expected, c.motion_error, c.tolerance_constant, c.bias_linear, c.bias_quadratic, real(0));
        real found = mix(mix(c.radius, difference, usable), real(0), same && difference <= rounded);
        change = mix(real(0), found, surface && before.inside && (near_now || (usable && near_then)));
    }
    return change;
}

// One new sample: [0, 1].
AO_PASS real ao_contribution_of(ao_temporal_constants c, ao_tap_seen seen, vec3 position, vec3 normal, real bias)
{
    real blocked = mix(real(0), real(1), seen.hit);
    if (ao_contribution == ao_fox_compton) {
        // Fox and Compton 2008: the patch itself counts, by its cosine and distance.
        mask surface = ao_is_surface(seen.surface, c.background);
        AO_PRECISE vec2 centre = vec2(real(seen.texel.x) + real(0.5), real(seen.texel.y) + real(0.5));
        vec3 point = ao_view_point(c.projection, centre, mix(real(1), seen.surface, surface), ao_parallel);
        AO_PRECISE vec3 offset = vec3(point.x - position.x, point.y - position.y, point.z - position.z);
        AO_PRECISE real height = ao_dot(offset, normal) - bias;
        AO_PRECISE real distance = sqrt(ao_dot(offset, offset));
        mask counts = surface && height > real(0) && distance <= c.radius;
        AO_PRECISE real cosine = height / mix(real(1), distance, counts);
        AO_PRECISE real strength = c.strength * cosine / max(c.least_distance, distance);
        blocked = mix(real(0), min(strength, c.largest), counts);
    }
    return blocked;
}

AO_PASS ao_frame ao_sampling_frame(vec3 normal, vec2 helper)
{
    if (ao_contribution == ao_fox_compton) {
        // The disc faces the eye.
        vec3 along = ao_normalize_or(vec3(helper.x, helper.y, real(0)), vec3(real(1), real(0), real(0)));
        AO_PRECISE real back = -along.y;
        ao_frame screen = { along, vec3(back, along.x, real(0)), normal };
        return screen;
    }
    return ao_gram_schmidt(normal, vec3(helper.x, helper.y, real(0)));
}

// Change of depth per pixel along the surface, at most a tenth of the depth.
AO_FN real ao_depth_slope(ao_tap_space space, bool parallel)
{
    AO_PRECISE real gradient = abs(space.gradient_x) + abs(space.gradient_y);
    AO_PRECISE real slope = parallel ? gradient : gradient * space.depth * space.depth;
    AO_PRECISE real most = space.depth * real(0.1);
    return min(slope, most);
}

// A pixel before its new samples are taken.
struct ao_temporal_pixel {
    mask foreground;
    real depth; // eye depth, 1 on background
    vec3 position;
    vec3 normal;
    real slope; // change of depth per pixel
    ao_previous previous;
    ao_history history;
    real wanted; // new samples, 0 on background
};

AO_PASS ao_temporal_pixel ao_begin_pixel(ao_temporal_constants c, ivec2 pixel)
{
    real stored = ao_load_own_depth(pixel);
    mask foreground = ao_is_surface(stored, c.background);
    real d = mix(real(1), stored, foreground);
    vec2 size = vec2(c.width, c.height);
    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 normal = ao_shading_normal(c.projection, c.normal_to_view, size, pixel, position, ao_parallel);
    // The slope does not depend on the turn of the frame.
    ao_frame upright = ao_sampling_frame(normal, vec2(real(1), real(0)));
    real slope = ao_depth_slope(ao_make_tap_space(c.projection, size, position, upright, d, c.radius), ao_parallel);
    ao_previous previous = { position, centre, foreground };
    ao_history h;
    if (ao_reproject) {
        previous = ao_previous_of(c, pixel, position);
        h = ao_recalled_history(c, centre, previous, slope);
    }
    else {
        h = ao_own_history(c, pixel);
    }
    real wanted = mix(c.later_samples, c.first_samples, h.weight < c.adaptive_weight);
    ao_temporal_pixel begun = { foreground, d, position, normal, slope, previous, h, mix(real(0), wanted, foreground) };
    return begun;
}

// What a frame's samples of a pixel found.
struct ao_new_samples {
    real sum;    // of their occlusions, by weight
    real weight; // their number, or what their slices count for, on average one a sample
    real change; // the greatest of the neighbourhood, scene units
};

// Single offsets of a sequence, all of one weight.
AO_PASS ao_new_samples ao_sample_offsets(ao_temporal_constants c, ao_temporal_pixel begun, ivec2 pixel, real bias,
                                         vec3 normal_was)
{
    vec2 tile = ao_load_rotation(ao_tile_texel(pixel));
    mask turned = begun.history.weight < c.rotation_weight;
    vec2 helper = vec2(mix(real(1), tile.x, turned), mix(real(0), tile.y, turned));
    ao_frame frame = ao_sampling_frame(begun.normal, helper);
    ao_tap_space taps = ao_make_tap_space(c.projection, vec2(c.width, c.height), begun.position, frame, begun.depth, c.radius);

    real sum = real(0);
    real change = real(0);
    int i = 0;
    do { // the condition last: llvmpipe runs a body to its end even where no pixel is left
        mask taken = real(i) < begun.wanted;
        real index = ao_next_index(begun.history.index, real(i), c.period);
        ao_tap_seen seen = ao_look(taps, c.projection, ao_load_tap(uint(index)), bias, c.thickness);
        AO_PRECISE real next = sum + mix(real(0), ao_contribution_of(c, seen, begun.position, begun.normal, bias), taken);
        sum = next;
        if (ao_reproject && ao_invalidation != ao_keep_weight) {
            real found = ao_neighbour_change(c, seen, begun.position, begun.normal, begun.previous.position, normal_was, bias,
                                             begun.slope);
            change = max(change, mix(real(0), found, taken));
        }
        ++i;
    } while (i < ao_most_samples && ao_any(real(i) < begun.wanted));
    ao_new_samples samples = { sum, begun.wanted, change };
    return samples;
}

// Whole slices, each with the weight of its share of the hemisphere: the mean over many is that of the hemisphere.
AO_PASS ao_new_samples ao_sample_slices(ao_temporal_constants c, ao_temporal_pixel begun, ivec2 pixel, real bias, vec3 normal_was)
{
    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    ao_slice_space space = ao_make_slice_space(c.projection, vec2(c.width, c.height), centre, begun.normal, begun.depth, c.radius,
                                               c.thickness, bias, c.background);
    vec2 turn = ao_load_rotation(ao_tile_texel(pixel));
    AO_PRECISE real step_share = real(1) / real(ao_slice_taps);

    real sum = real(0);
    real weight = real(0);
    real change = real(0);
    int i = 0;
    do {
        mask taken = real(i) < begun.wanted;
        vec4 slice_turn = ao_load_tap(uint(ao_next_index(begun.history.index, real(i), c.period)));
        ao_slice_walk walk = ao_make_slice_walk(space, c.projection, turn.x, vec2(slice_turn.x, slice_turn.y));
        uint blocked = uint(0u);
        for (int k = 0; k < ao_slice_taps; ++k) {
            real index = ao_next_index(begun.history.index, real(i + k), c.period);
            real share = ao_step_share(ao_load_tap(uint(index)), turn.y, step_share);
            ao_slice_seen seen = ao_look_along(space, c.projection, walk, pixel, share);
            blocked = blocked | seen.blocked;
            if (ao_reproject && ao_invalidation != ao_keep_weight) {
                ao_tap_seen tap = { seen.texel, seen.surface, seen.blocked != uint(0u) };
                real found = ao_neighbour_change(c, tap, begun.position, begun.normal, begun.previous.position, normal_was, bias,
                                                 begun.slope);
                change = max(change, mix(real(0), found, taken));
            }
        }
        AO_PRECISE real counts = mix(real(0), walk.slice.weight * real(ao_slice_taps), taken);
        AO_PRECISE real next_sum = sum + counts * (ao_sectors_in(blocked) / real(ao_sector_count));
        AO_PRECISE real next_weight = weight + counts;
        sum = next_sum;
        weight = next_weight;
        i += ao_slice_taps;
    } while (i < ao_most_samples && ao_any(real(i) < begun.wanted));
    ao_new_samples samples = { sum, weight, change };
    return samples;
}

// What the next frames are to know of the pixel. Background: all 0.
AO_PASS ao_history ao_accumulate_pass(ao_temporal_constants c, ivec2 pixel)
{
    ao_temporal_pixel begun = ao_begin_pixel(c, pixel);
    mask foreground = begun.foreground;
    real d = begun.depth;
    ao_history h = begun.history;
    AO_PRECISE real bias = c.bias + d * (c.bias_linear + d * c.bias_quadratic);
    vec3 normal_was = ao_transform_direction(ao_affine_of(c.to_previous), begun.normal);
    ao_new_samples samples;
    if (ao_contribution == ao_bitmask) {
        samples = ao_sample_slices(c, begun, pixel, bias, normal_was);
    }
    else {
        samples = ao_sample_offsets(c, begun, pixel, bias, normal_was);
    }
    real weight = h.weight;
    if (ao_reproject && ao_invalidation != ao_keep_weight) {
        real confidence = ao_confidence(samples.change, c.steepness); // the least over the samples
        weight = ao_invalidation == ao_smooth_weight ? ao_kept_weight(weight, confidence)
                                                     : mix(weight, min(weight, c.clamped_weight), confidence < real(0.5));
    }
    // A slice at right angles to the normal, and no history: nothing is known.
    AO_PRECISE real known = weight + samples.weight;
    real value = ao_accumulated(h.value, weight, samples.sum, mix(real(1), samples.weight, known > real(0)));
    ao_history next = { mix(real(0), min(value, real(1)), foreground),
                        mix(real(0), ao_next_weight(weight, begun.wanted, c.most_weight), foreground),
                        mix(real(0), ao_next_index(h.index, begun.wanted, c.period), foreground), mix(real(0), d, foreground) };
    return next;
}
