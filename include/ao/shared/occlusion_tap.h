// One offset of a kernel held against the depth buffer (paper 1, stage 2): A = P + R S is occluded where it lies behind the
// surface seen at its pixel, by more than a bias and by no more than a thickness.
// Beyond the picture's border nothing is known: there the surface is taken to go on as it is at the border, relative to the
// tangent plane of the pixel. An open plane stays open, and what stands at the border keeps occluding.
// Callbacks: real ao_load_depth(ivec2): eye depth, 0 or less, NaN or infinite for background.
// Options:   bool ao_parallel, bool ao_limit_thickness.

// What the taps of a pixel have in common: the numerators of pixel.x and pixel.y and the eye depth are linear in S.
struct ao_tap_space {
    vec3 across;
    vec3 down;
    vec3 inward;
    real start_x;
    real start_y;
    real depth;
    // Along the tangent plane 1 / depth (in parallel projection depth) is linear in pixel coordinates, with this gradient.
    real gradient_x;
    real gradient_y;
    real last_column;
    real last_row;
};

// `size`: of the picture in pixels. `d`: eye depth of `position`.
AO_PASS ao_tap_space ao_make_tap_space(ao_projection p, vec2 size, vec3 position, ao_frame frame, real d, real radius)
{
    AO_PRECISE real scale_x = p.scale_x * radius;
    AO_PRECISE real scale_y = p.scale_y * radius;
    AO_PRECISE real start_x = p.scale_x * position.x;
    AO_PRECISE real start_y = p.scale_y * position.y;
    AO_PRECISE vec3 across = vec3(scale_x * frame.tangent.x, scale_x * frame.bitangent.x, scale_x * frame.normal.x);
    AO_PRECISE vec3 down = vec3(scale_y * frame.tangent.y, scale_y * frame.bitangent.y, scale_y * frame.normal.y);
    AO_PRECISE vec3 inward = vec3(-radius * frame.tangent.z, -radius * frame.bitangent.z, -radius * frame.normal.z);

    vec3 normal = frame.normal;
    AO_PRECISE real facing = ao_parallel ? normal.z : -ao_dot(normal, position) / d;
    mask steep = facing < real(1e-3);
    AO_PRECISE real turn = ao_parallel ? facing : -facing * d;
    real divisor = mix(turn, real(1), steep);
    AO_PRECISE real gradient_x = mix(normal.x * p.slope_x / divisor, real(0), steep);
    AO_PRECISE real gradient_y = mix(normal.y * p.slope_y / divisor, real(0), steep);
    AO_PRECISE real last_column = size.x - real(0.5);
    AO_PRECISE real last_row = size.y - real(0.5);
    ao_tap_space space = { across, down, inward, start_x, start_y, d, gradient_x, gradient_y, last_column, last_row };
    return space;
}

struct ao_tap_seen {
    ivec2 texel;  // that was looked at, inside the picture
    real surface; // eye depth there, 0 or less for background
    mask hit;     // the offset is occluded
};

// An offset behind the eye or over background is not occluded.
AO_PASS ao_tap_seen ao_look(ao_tap_space t, ao_projection p, vec4 s, real bias, real thickness)
{
    AO_PRECISE real x = t.start_x + (t.across.x * s.x + t.across.y * s.y + t.across.z * s.z);
    AO_PRECISE real y = t.start_y + (t.down.x * s.x + t.down.y * s.y + t.down.z * s.z);
    AO_PRECISE real depth = t.depth + (t.inward.x * s.x + t.inward.y * s.y + t.inward.z * s.z);
    mask ahead = depth > real(1e-30);
    AO_PRECISE real inverse = ao_parallel ? real(1) : real(1) / mix(real(1), depth, ahead);
    AO_PRECISE real column = x * inverse + p.centre_x;
    AO_PRECISE real row = y * inverse + p.centre_y;
    real column_inside = min(max(column, real(0.5)), t.last_column);
    real row_inside = min(max(row, real(0.5)), t.last_row);
    ivec2 texel = ivec2(integer(column_inside), integer(row_inside));
    real surface = ao_load_depth(texel);
    AO_PRECISE real shift = t.gradient_x * (column_inside - column) + t.gradient_y * (row_inside - row);
    mask hit = ahead && ao_is_surface(surface, real(1e30));
    if (ao_parallel) {
        AO_PRECISE real behind = depth + shift - surface;
        hit = hit && behind >= bias;
        if (ao_limit_thickness) {
            hit = hit && behind <= thickness;
        }
    }
    else {
        // surface + bias <= 1 / nearness, without the second division
        AO_PRECISE real nearness = inverse + shift;
        AO_PRECISE real front = (surface + bias) * nearness;
        hit = hit && nearness > real(0) && front <= real(1);
        if (ao_limit_thickness) {
            AO_PRECISE real back = (surface + thickness) * nearness;
            hit = hit && back >= real(1);
        }
    }
    ao_tap_seen seen = { texel, surface, hit };
    return seen;
}
