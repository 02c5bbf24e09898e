// Pixels, view space and depth. View space: right-handed, the camera looks along -Z; eye depth d = -z > 0.
// Pixel coordinates: (0, 0) is the corner of the first texel of the first row in memory, its centre is (0.5, 0.5).
// The constants fold the projection matrix, the direction of Y and the picture's size (ao/projection.hpp derives them):
//   pixel.x = scale_x * x / d + centre_x   in perspective,   scale_x * x + centre_x   in parallel projection, and so for y.
// Structs of constants hold reals only, a multiple of four of them: they lie alike in C++, std140 and std430.

struct ao_projection {
    real scale_x; // pixels
    real scale_y;
    real centre_x;
    real centre_y;
    real slope_x; // the inverse: x = (pixel.x * slope_x + offset_x) * d, without d if parallel
    real slope_y;
    real offset_x;
    real offset_y;
};

// View-space point seen at `pixel` at eye depth d.
AO_FN vec3 ao_view_point(ao_projection p, vec2 pixel, real d, bool parallel)
{
    AO_PRECISE real x = pixel.x * p.slope_x + p.offset_x;
    AO_PRECISE real y = pixel.y * p.slope_y + p.offset_y;
    real reach = parallel ? real(1) : d;
    AO_PRECISE vec3 point = vec3(x * reach, y * reach, -d);
    return point;
}

// Pixel coordinates of a view-space point in front of the eye (z < 0 in perspective).
AO_FN vec2 ao_to_pixel(ao_projection p, vec3 point, bool parallel)
{
    AO_PRECISE real inverse = parallel ? real(1) : real(1) / -point.z;
    AO_PRECISE real x = p.scale_x * point.x * inverse + p.centre_x;
    AO_PRECISE real y = p.scale_y * point.y * inverse + p.centre_y;
    vec2 pixel = vec2(x, y);
    return pixel;
}

// What turns a stored depth, linear depth or view-space z at a pixel into eye depth:
//   denominator = stored * scale + offset + pixel.x * slope_x + pixel.y * slope_y
//   d = numerator / denominator, or the denominator itself where `affine` (parallel projections, linear input).
// The slopes are not 0 for oblique near planes only.
struct ao_depth_decode {
    real numerator;
    real scale;
    real offset;
    real slope_x;
    real slope_y;
    real background; // eye depths from here on are background
    real cleared;    // stored value that always is background
    real reserved;
};

// Whether an eye depth is one of a surface. Depths below 1e-30 are none: the products of smaller ones are denormal, which some
// stages of some drivers flush to 0 and others keep.
AO_FN mask ao_is_surface(real depth, real background)
{
    return depth > real(1e-30) && depth < background;
}

// Eye depth, or 0 for background and for whatever is not a finite depth in front of the eye.
AO_FN real ao_eye_depth(ao_depth_decode c, vec2 pixel, real stored, bool affine)
{
    AO_PRECISE real denominator = stored * c.scale + c.offset + pixel.x * c.slope_x + pixel.y * c.slope_y;
    AO_PRECISE real d = affine ? denominator : c.numerator / denominator;
    // Not `stored != c.cleared`: a driver may take a denormal for 0.
    AO_PRECISE real from_cleared = abs(stored - c.cleared);
    mask seen = from_cleared > real(1e-37) && ao_is_surface(d, c.background);
    return mix(real(0), d, seen);
}
