// Screen-space ambient occlusion over a kernel of offsets in tangent space (paper 1, stage 2): k is the share of offsets
// that end up behind the depth buffer, visibility is 1 - k.
// Callbacks: real ao_load_depth(ivec2): eye depth, 0 or less, NaN or infinite for background;
//            vec2 ao_load_rotation(ivec2): helper V_r of the frame, from a tile of ao_tile_size squared;
//            vec4 ao_tap(int): offset in tangent space, normal along +z, in units of the radius; and those of normal_pass.h.
// Options:   int ao_tap_count, bool ao_parallel, bool ao_limit_thickness, bool ao_mark_background; and those of normal_pass.h.

struct ao_occlusion_constants {
    ao_projection projection;
    ao_rotation normal_to_view;
    real radius;         // scene units
    real bias;           // delta of paper 1, scene units
    real bias_linear;    // what the depth's storage adds to it: bias + d * (linear + d * quadratic)
    real bias_quadratic; // 1 / scene unit
    real thickness;      // how far behind a surface an offset may lie and still be occluded, scene units
    real background;     // eye depths from here on are background, at most 1e30
    real width;          // pixels
    real height;
};

// Visibility in [0, 1]; on background 1, or -1 where ao_mark_background asks for a mark that the filter understands.
// An offset behind the eye or over background is not occluded; see below for those off the picture.
AO_PASS real ao_occlusion_pass(ao_occlusion_constants c, ivec2 pixel)
{
    real stored = ao_load_depth(pixel);
    mask foreground = stored > real(0) && stored < c.background;
    real d = mix(real(1), stored, foreground);

    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    vec3 position = ao_view_point(c.projection, centre, d, ao_parallel);
    vec3 normal = ao_shading_normal(c.projection, c.normal_to_view, vec2(c.width, c.height), pixel, position, ao_parallel);
    vec2 helper = ao_load_rotation(ao_tile_texel(pixel));
    ao_frame frame = ao_gram_schmidt(normal, vec3(helper.x, helper.y, real(0)));

    // A = P + R S, projected: the numerators of pixel.x and pixel.y and the eye depth are linear in S.
    ao_projection p = c.projection;
    AO_PRECISE real scale_x = p.scale_x * c.radius;
    AO_PRECISE real scale_y = p.scale_y * c.radius;
    AO_PRECISE real start_x = p.scale_x * position.x;
    AO_PRECISE real start_y = p.scale_y * position.y;
    AO_PRECISE vec3 across = vec3(scale_x * frame.tangent.x, scale_x * frame.bitangent.x, scale_x * frame.normal.x);
    AO_PRECISE vec3 down = vec3(scale_y * frame.tangent.y, scale_y * frame.bitangent.y, scale_y * frame.normal.y);
    AO_PRECISE vec3 inward = vec3(-c.radius * frame.tangent.z, -c.radius * frame.bitangent.z, -c.radius * frame.normal.z);
    AO_PRECISE real bias = c.bias + d * (c.bias_linear + d * c.bias_quadratic);
    real thickness = c.thickness;

    // Beyond the picture's border nothing is known: there the surface is taken to go on as it is at the border, relative to the
    // tangent plane of the pixel. An open plane stays open, and what stands at the border keeps occluding. Along the tangent
    // plane 1 / depth (in parallel projection depth) is linear in pixel coordinates, with this gradient.
    AO_PRECISE real facing = ao_parallel ? normal.z : -ao_dot(normal, position) / d;
    mask steep = facing < real(1e-3);
    AO_PRECISE real turn = ao_parallel ? facing : -facing * d;
    real divisor = mix(turn, real(1), steep);
    AO_PRECISE real gradient_x = mix(normal.x * p.slope_x / divisor, real(0), steep);
    AO_PRECISE real gradient_y = mix(normal.y * p.slope_y / divisor, real(0), steep);
    AO_PRECISE real last_column = c.width - real(0.5);
    AO_PRECISE real last_row = c.height - real(0.5);

    real occluded = real(0);
    AO_UNROLL
    for (int i = 0; i < ao_tap_count; ++i) {
        vec4 s = ao_tap(i);
        AO_PRECISE real x = start_x + (across.x * s.x + across.y * s.y + across.z * s.z);
        AO_PRECISE real y = start_y + (down.x * s.x + down.y * s.y + down.z * s.z);
        AO_PRECISE real depth = d + (inward.x * s.x + inward.y * s.y + inward.z * s.z);
        mask ahead = depth > real(1e-30);
        AO_PRECISE real inverse = ao_parallel ? real(1) : real(1) / mix(real(1), depth, ahead);
        AO_PRECISE real column = x * inverse + p.centre_x;
        AO_PRECISE real row = y * inverse + p.centre_y;
        real column_inside = min(max(column, real(0.5)), last_column);
        real row_inside = min(max(row, real(0.5)), last_row);
        real surface = ao_load_depth(ivec2(integer(column_inside), integer(row_inside)));
        AO_PRECISE real shift = gradient_x * (column_inside - column) + gradient_y * (row_inside - row);
        mask hit = ahead && surface > real(0);
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
        AO_PRECISE real next = occluded + mix(real(0), real(1), hit);
        occluded = next;
    }
    // Hardware may round n / n above 1; below 0 would mean background to the filter.
    AO_PRECISE real visibility = max(real(1) - occluded / real(ao_tap_count), real(0));
    real outside = ao_mark_background ? real(-1) : real(1);
    return mix(outside, visibility, foreground);
}
