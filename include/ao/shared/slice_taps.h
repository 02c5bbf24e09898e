// Taps of the slices of a pixel's hemisphere, for the method `bitmask`. A slice goes from the view vector V towards a direction D
// of the picture's plane. A tap Q along it stands for the column from Q to Q - thickness V, clipped to the sphere of the radius
// about the pixel's point and to the tangent plane; the sectors between its ends are blocked.
// Beyond the picture's border nothing is known: a tap there is taken at the border.
// Callbacks: real ao_load_depth(ivec2): eye depth, 0 or less, NaN or infinite for background. Options: bool ao_parallel.

// What the slices of one pixel have in common. Lengths in units of the radius; "slope": of a ray from the eye, x / -z.
struct ao_slice_space {
    vec3 normal; // view space
    vec3 view;   // V
    real facing; // the normal's component along V
    real scale;  // 1 / radius
    real thickness;
    real bias;
    real reach; // slope of a tap at the radius
    real least; // slope of the nearest tap
    // Height over the tangent plane of the point at a depth on the ray offset by slopes (x, y) from the pixel's own: in
    // perspective depth * (rise.z + rise.x x + rise.y y) - start, in parallel projection rise.x x + rise.y y + depth rise.z -
    // start.
    vec3 rise;
    real start;
    real upward; // height along V per height over the plane
    real last_column;
    real last_row;
    real background; // eye depths from here on are background
};

// `d`: eye depth of the pixel; `radius`, `thickness`, `bias` in scene units.
AO_PASS ao_slice_space ao_make_slice_space(ao_projection p, vec2 size, vec2 centre, vec3 normal, real d, real radius,
                                           real thickness, real bias, real background)
{
    vec3 ray = ao_view_point(p, centre, real(1), ao_parallel);
    if (ao_parallel) {
        ray = vec3(real(0), real(0), real(-1));
    }
    AO_PRECISE real ray_length = sqrt(ao_dot(ray, ray));
    AO_PRECISE real ray_inverse = real(-1) / ray_length;
    AO_PRECISE vec3 view = vec3(ray.x * ray_inverse, ray.y * ray_inverse, ray.z * ray_inverse);
    real facing = ao_dot(normal, view);
    AO_PRECISE real scale = real(1) / radius;
    AO_PRECISE real thick = thickness * scale;
    AO_PRECISE real aside = bias * scale;
    // Finite, for a step of 0 times an infinite reach would be no number.
    AO_PRECISE real reach = min(ao_parallel ? radius : radius / d, real(1e30));
    // Nearer taps would see the pixel itself.
    AO_PRECISE real least = real(1.3) * max(abs(p.slope_x), abs(p.slope_y));
    AO_PRECISE vec3 rise = vec3(normal.x * scale, normal.y * scale, ao_dot(normal, ray) * scale);
    AO_PRECISE real start = d * rise.z;
    AO_PRECISE real upward = real(1) / max(facing, real(0.03125));
    AO_PRECISE real last_column = size.x - real(0.5);
    AO_PRECISE real last_row = size.y - real(0.5);
    ao_slice_space space = { normal, view, facing, scale,  thick,       aside,    reach,
                             least,  rise, start,  upward, last_column, last_row, background };
    return space;
}

// What the taps of one slice have in common.
struct ao_slice_walk {
    vec2 direction; // D, in view space
    real lean;      // its component along V
    real inverse;   // 1 / length of the rest
    vec2 texels;    // pixels per slope along it
    real across;    // distance from V per slope and depth
    ao_slice slice;
};

// `turn`: cosine of half the pixel's own azimuth, [-1, 1]; `slice_turn`: cosine and sine of the slice's azimuth against it.
AO_PASS ao_slice_walk ao_make_slice_walk(ao_slice_space t, ao_projection p, real turn, vec2 slice_turn)
{
    AO_PRECISE real rest = max(real(1) - turn * turn, real(0));
    AO_PRECISE real sine = real(2) * turn * (rest * ao_inverse_root(rest));
    AO_PRECISE real cosine = real(2) * turn * turn - real(1);
    AO_PRECISE vec2 direction = vec2(cosine * slice_turn.x - sine * slice_turn.y, cosine * slice_turn.y + sine * slice_turn.x);
    AO_PRECISE real lean = direction.x * t.view.x + direction.y * t.view.y;
    AO_PRECISE real square = max(real(1) - lean * lean, real(1e-12));
    AO_PRECISE real inverse = ao_inverse_root(square);
    AO_PRECISE real along = (direction.x * t.normal.x + direction.y * t.normal.y - t.facing * lean) * inverse;
    AO_PRECISE real across = square * inverse * t.scale;
    AO_PRECISE vec2 texels = vec2(direction.x * p.scale_x, direction.y * p.scale_y);
    ao_slice_walk walk = { direction, lean, inverse, texels, across, ao_make_slice(along, t.facing) };
    return walk;
}

// Unit, in the slice and at a right angle to V.
AO_FN vec3 ao_slice_across(ao_slice_space t, ao_slice_walk w)
{
    AO_PRECISE vec3 across = vec3((w.direction.x - t.view.x * w.lean) * w.inverse,
                                  (w.direction.y - t.view.y * w.lean) * w.inverse, -(t.view.z * w.lean * w.inverse));
    return across;
}

// At which share of the steps a tap lies. `tap`: of ao/slices.hpp; `shift`: the pixel's own, [0, 1); `step_share`: of one step.
AO_FN real ao_step_share(vec4 tap, real shift, real step_share)
{
    AO_PRECISE real place = shift + tap.w;
    AO_PRECISE real share = tap.z + (place - floor(place)) * step_share;
    return share;
}

struct ao_slice_seen {
    ivec2 texel;  // that was looked at, inside the picture
    real surface; // eye depth there, as loaded
    uint blocked; // sectors
};

// Steps grow outwards, about as share to the power of 1.5.
AO_PASS ao_slice_seen ao_look_along(ao_slice_space t, ao_projection p, ao_slice_walk w, ivec2 pixel, real share)
{
    AO_PRECISE real far = t.reach * (share * (real(0.4) + real(0.6) * share));
    AO_PRECISE real slope = max(far, t.least);
    AO_PRECISE real column = real(pixel.x) + real(0.5) + slope * w.texels.x;
    AO_PRECISE real row = real(pixel.y) + real(0.5) + slope * w.texels.y;
    ivec2 texel = ivec2(integer(min(max(column, real(0.5)), t.last_column)), integer(min(max(row, real(0.5)), t.last_row)));
    real surface = ao_load_depth(texel);
    mask seen = ao_is_surface(surface, t.background);
    real depth = mix(real(1), surface, seen);

    AO_PRECISE real offset_x = real(texel.x - pixel.x) * p.slope_x;
    AO_PRECISE real offset_y = real(texel.y - pixel.y) * p.slope_y;
    AO_PRECISE real along = offset_x * w.direction.x + offset_y * w.direction.y;
    real spread = ao_parallel ? real(1) : depth;
    AO_PRECISE real x = spread * (along * w.across);
    // Texels lie beside the slice by up to half a pixel: what counts is how high they stand over the tangent plane, so that
    // a plane stays open however it is tilted.
    AO_PRECISE real sideways = offset_x * t.rise.x + offset_y * t.rise.y;
    AO_PRECISE real height = ao_parallel ? sideways + (depth * t.rise.z - t.start) : depth * (t.rise.z + sideways) - t.start;
    AO_PRECISE real y = x * w.slice.tangent + height * t.upward;
    // So near V a direction has no cosine: lengths would underflow.
    mask near = seen && x > real(1e-9) && x < real(1);
    AO_PRECISE real squared = mix(real(1), x * x, near);
    AO_PRECISE real inside = real(1) - squared;
    AO_PRECISE real rim = inside * ao_inverse_root(inside);
    AO_PRECISE real plane = x * w.slice.tangent;
    real top = min(y, rim);
    AO_PRECISE real bottom = max(max(y - t.thickness, -rim), plane);
    mask blocks = near && top > bottom && height > t.bias;
    real upper = mix(real(0), top, blocks);
    real lower = mix(real(0), bottom, blocks);
    AO_PRECISE real upper_cosine = upper * ao_inverse_root(squared + upper * upper);
    AO_PRECISE real lower_cosine = lower * ao_inverse_root(squared + lower * lower);
    integer first = ao_sector_border(w.slice, upper_cosine);
    integer last = ao_sector_border(w.slice, lower_cosine);
    uint set = ao_sectors_from(first) & ~ao_sectors_from(last);
    ao_slice_seen looked = { texel, surface, mix(uint(0u), set, blocks) };
    return looked;
}
