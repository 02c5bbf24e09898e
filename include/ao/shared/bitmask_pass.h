// Ambient occlusion from slices of the hemisphere with a visibility bitmask: horizon search (Bavoil et al. 2008; Jimenez et al.
// 2016) whose occluders are columns of finite thickness (Therrien et al. 2023), their sectors equal in cosine-weighted measure.
// A slice holds the view vector V and a direction D of the picture's plane. A tap Q on either side of the pixel P stands for the
// column from Q to Q - thickness V, clipped to the sphere of the radius about P and to the tangent plane; the sectors between
// its ends are blocked.
// Beyond the picture's border nothing is known: a tap there is taken at the border.
// Callbacks: vec2 ao_load_rotation(ivec2), vec4 ao_tap(int): the tables of ao/slices.hpp; real ao_load_depth(ivec2): eye depth,
//            0 or less, NaN or infinite for background; and those of normal_pass.h.
// Options:   int ao_tap_count: of all slices; int ao_slice_count; bool ao_parallel; bool ao_mark_background; and those of
//            normal_pass.h.

// What the taps of one slice have in common. Lengths in units of the radius; "slope": of a ray from the eye, x / -z.
struct ao_slice_walk {
    vec2 direction; // D, in view space
    vec2 texels;    // pixels per slope along it
    real reach;     // slope of a tap at the radius
    real least;     // slope of the nearest tap
    real across;    // distance from V per slope and depth
    // Height over the tangent plane of the point at a depth on the ray offset by slopes (x, y) from the pixel's own: in
    // perspective depth * (rise.z + rise.x x + rise.y y) - start, in parallel projection rise.x x + rise.y y + depth rise.z -
    // start.
    vec3 rise;
    real start;
    real upward; // height along V per height over the plane
};

// The sectors that one tap blocks. `sign`: 1 to the right, -1 to the left. `share`: of the steps at which the tap lies; they grow
// outwards, about as share to the power of 1.5.
AO_PASS uint ao_blocked_sectors(ao_occlusion_constants c, ao_slice_walk w, ao_slice_side side, real sign, ivec2 pixel, real share,
                                real thickness, real bias)
{
    AO_PRECISE real far = w.reach * (share * (real(0.4) + real(0.6) * share));
    AO_PRECISE real slope = max(far, w.least) * sign;
    AO_PRECISE real column = real(pixel.x) + real(0.5) + slope * w.texels.x;
    AO_PRECISE real row = real(pixel.y) + real(0.5) + slope * w.texels.y;
    AO_PRECISE real last_column = c.width - real(0.5);
    AO_PRECISE real last_row = c.height - real(0.5);
    ivec2 texel = ivec2(integer(min(max(column, real(0.5)), last_column)), integer(min(max(row, real(0.5)), last_row)));
    real surface = ao_load_depth(texel);
    mask seen = ao_is_surface(surface, c.background);
    real depth = mix(real(1), surface, seen);

    AO_PRECISE real offset_x = real(texel.x - pixel.x) * c.projection.slope_x;
    AO_PRECISE real offset_y = real(texel.y - pixel.y) * c.projection.slope_y;
    AO_PRECISE real along = offset_x * w.direction.x + offset_y * w.direction.y;
    real spread = ao_parallel ? real(1) : depth;
    AO_PRECISE real x = spread * (along * sign * w.across);
    // Texels lie beside the slice by up to half a pixel: what counts is how high they stand over the tangent plane, so that
    // a plane stays open however it is tilted.
    AO_PRECISE real sideways = offset_x * w.rise.x + offset_y * w.rise.y;
    AO_PRECISE real height = ao_parallel ? sideways + (depth * w.rise.z - w.start) : depth * (w.rise.z + sideways) - w.start;
    AO_PRECISE real y = x * side.tangent + height * w.upward;
    // So near V a direction has no cosine: lengths would underflow.
    mask near = seen && x > real(1e-9) && x < real(1);
    AO_PRECISE real inside = real(1) - x * x;
    AO_PRECISE real rim = sqrt(mix(real(0), inside, near));
    AO_PRECISE real plane = x * side.tangent;
    real top = min(y, rim);
    AO_PRECISE real bottom = max(max(y - thickness, -rim), plane);
    mask blocks = near && top > bottom && height > bias;
    real across = mix(real(1), x, blocks);
    real upper = mix(real(0), top, blocks);
    real lower = mix(real(0), bottom, blocks);
    AO_PRECISE real squared = across * across;
    AO_PRECISE real upper_length = sqrt(squared + upper * upper);
    AO_PRECISE real lower_length = sqrt(squared + lower * lower);
    // One division for both cosines.
    AO_PRECISE real inverse = real(1) / (upper_length * lower_length);
    AO_PRECISE real upper_cosine = upper * (lower_length * inverse);
    AO_PRECISE real lower_cosine = lower * (upper_length * inverse);
    integer first = ao_sector_border(side, upper_cosine);
    integer last = ao_sector_border(side, lower_cosine);
    // Borders count from the left: on that side the top is the later one.
    mask leftwards = sign < real(0);
    uint set = ao_sectors_from(mix(first, last, leftwards)) & ~ao_sectors_from(mix(last, first, leftwards));
    return mix(uint(0u), set, blocks);
}

struct ao_bitmask_result {
    real visibility; // [0, 1]; on background 1, or -1 where ao_mark_background asks for a mark
    real weight;     // what it counts for among neighbours, [0, pi / 2]
    real depth;      // eye depth, 0 for background
};

AO_PASS ao_bitmask_result ao_bitmask_pass(ao_occlusion_constants c, ivec2 pixel)
{
    real stored = ao_load_depth(pixel);
    mask foreground = ao_is_surface(stored, c.background);
    real d = mix(real(1), stored, foreground);

    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 normal = ao_shading_normal(c.projection, c.normal_to_view, vec2(c.width, c.height), pixel, position, ao_parallel);
    vec3 ray = ao_view_point(c.projection, centre, real(1), ao_parallel);
    if (ao_parallel) {
        ray = vec3(real(0), real(0), real(-1));
    }
    AO_PRECISE real ray_length = sqrt(ao_dot(ray, ray));
    AO_PRECISE real ray_inverse = real(-1) / ray_length;
    AO_PRECISE vec3 view = vec3(ray.x * ray_inverse, ray.y * ray_inverse, ray.z * ray_inverse);
    real facing = ao_dot(normal, view);

    AO_PRECISE real scale = real(1) / c.radius;
    AO_PRECISE real thickness = c.thickness * scale;
    AO_PRECISE real bias = (c.bias + d * (c.bias_linear + d * c.bias_quadratic)) * scale;
    // Finite, for a step of 0 times an infinite reach would be no number.
    AO_PRECISE real reach = min(ao_parallel ? c.radius : c.radius / d, real(1e30));
    // Nearer taps would see the pixel itself.
    AO_PRECISE real least = real(1.3) * max(abs(c.projection.slope_x), abs(c.projection.slope_y));
    vec2 turn = ao_load_rotation(ao_tile_texel(pixel));
    AO_PRECISE real sine = sqrt(max(real(1) - turn.x * turn.x, real(0)));
    AO_PRECISE vec3 rise = vec3(normal.x * scale, normal.y * scale, ao_dot(normal, ray) * scale);
    AO_PRECISE real start = d * rise.z;
    AO_PRECISE real upward = real(1) / max(facing, real(0.03125));
    int steps = ao_tap_count / (2 * ao_slice_count);
    AO_PRECISE real step_share = real(1) / real(steps);

    real open = real(0);
    real total = real(0);
    for (int s = 0; s < ao_slice_count; ++s) {
        vec4 slice_turn = ao_tap(2 * steps * s);
        AO_PRECISE vec2 direction =
            vec2(turn.x * slice_turn.x - sine * slice_turn.y, turn.x * slice_turn.y + sine * slice_turn.x);
        AO_PRECISE real lean = direction.x * view.x + direction.y * view.y;
        AO_PRECISE real straight = sqrt(max(real(1) - lean * lean, real(1e-12)));
        AO_PRECISE real along = (direction.x * normal.x + direction.y * normal.y - facing * lean) / straight;
        ao_slice slice = ao_make_slice(along, facing);
        AO_PRECISE vec2 texels = vec2(direction.x * c.projection.scale_x, direction.y * c.projection.scale_y);
        AO_PRECISE real across = straight * scale;
        ao_slice_walk walk = { direction, texels, reach, least, across, rise, start, upward };

        uint blocked = uint(0u);
        AO_UNROLL
        for (int k = 0; k < steps; ++k) {
            vec4 right = ao_tap(2 * (steps * s + k));
            vec4 left = ao_tap(2 * (steps * s + k) + 1);
            AO_PRECISE real place = turn.y + right.w;
            AO_PRECISE real other = turn.y + left.w;
            AO_PRECISE real share = right.z + (place - floor(place)) * step_share;
            AO_PRECISE real other_share = left.z + (other - floor(other)) * step_share;
            blocked = blocked | ao_blocked_sectors(c, walk, slice.right, real(1), pixel, share, thickness, bias);
            blocked = blocked | ao_blocked_sectors(c, walk, slice.left, real(-1), pixel, other_share, thickness, bias);
        }
        AO_PRECISE real clear = real(1) - ao_sectors_in(blocked) / real(ao_sector_count);
        AO_PRECISE real next_open = open + slice.weight * clear;
        AO_PRECISE real next_total = total + slice.weight;
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
AO_PASS vec2 ao_bitmask_packed_pass(ao_occlusion_constants c, ivec2 pixel)
{
    ao_bitmask_result r = ao_bitmask_pass(c, pixel);
    mask foreground = r.depth > real(0);
    real both = ao_pack_visibility(mix(real(1), r.visibility, foreground), r.weight);
    return vec2(mix(real(-1), both, foreground), r.depth);
}
