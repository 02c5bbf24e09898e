// Projection matrices of every convention, and what the passes need to know of one.
#pragma once

#include "ao/math.hpp"
#include "ao/matrix.hpp"
#include "ao/result.hpp"

#include <limits>

namespace ao {

// NDC z of the near and far planes: Vulkan, Direct3D, Metal, or OpenGL unless glClipControl says otherwise.
enum class depth_range { zero_to_one, minus_one_to_one };

// Which end of NDC y the first row in memory shows: -1 in OpenGL and Vulkan, +1 in Direct3D, Metal and pictures stored top down.
enum class first_row { at_ndc_minus_one, at_ndc_plus_one };

// View space to clip space, column-major, applied to column vectors: clip = matrix * view. View space is right-handed and looks
// along -Z. Supported: perspective (w = -k z) and parallel (w = k) projections with any near and far plane, standard or
// reversed, finite or infinite, off-centre, with an oblique near plane, Y up or down.
struct camera_projection {
    matrix4 matrix;
    depth_range range = depth_range::zero_to_one;
    first_row rows = first_row::at_ndc_minus_one;
};

// Left, right, bottom and top at distance 1 in front of the eye (in scene units if parallel), and the distances of the planes.
struct frustum {
    double left = -1;
    double right = 1;
    double bottom = -1;
    double top = 1;
    double near = 0.1;
    double far = 1000; // may be infinite in perspective
};

struct projection_options {
    depth_range range = depth_range::zero_to_one;
    first_row rows = first_row::at_ndc_minus_one;
    bool reversed = false; // near at depth 1, far at depth 0
    bool y_down = false;   // NDC y grows downwards, as in Vulkan
    bool parallel = false;
};

constexpr camera_projection make_projection(const frustum& f, const projection_options& options = {})
{
    const bool infinite = f.far > std::numeric_limits<double>::max();
    const double near_z =
        options.range == depth_range::zero_to_one ? (options.reversed ? 1.0 : 0.0) : (options.reversed ? 1.0 : -1.0);
    const double far_z =
        options.range == depth_range::zero_to_one ? (options.reversed ? 0.0 : 1.0) : (options.reversed ? -1.0 : 1.0);
    const double width = f.right - f.left;
    const double height = f.top - f.bottom;
    const double flip = options.y_down ? -1.0 : 1.0;

    matrix4 m = matrix4::zero();
    m[0][0] = static_cast<float>(2.0 / width);
    m[1][1] = static_cast<float>(flip * 2.0 / height);
    if (options.parallel) {
        // ndc z = near_z + (d - near) / (far - near) * (far_z - near_z), d = -z
        const double slope = (far_z - near_z) / (f.far - f.near);
        m[3][0] = static_cast<float>(-(f.right + f.left) / width);
        m[3][1] = static_cast<float>(-flip * (f.top + f.bottom) / height);
        m[2][2] = static_cast<float>(-slope);
        m[3][2] = static_cast<float>(near_z - f.near * slope);
        m[3][3] = 1.0F;
    }
    else {
        // ndc z = a + b / d with the given values at d = near and d = far
        const double b = infinite ? (near_z - far_z) * f.near : (near_z - far_z) * f.near * f.far / (f.far - f.near);
        const double a = infinite ? far_z : near_z - b / f.near;
        m[2][0] = static_cast<float>((f.right + f.left) / width);
        m[2][1] = static_cast<float>(flip * (f.top + f.bottom) / height);
        m[2][2] = static_cast<float>(-a);
        m[3][2] = static_cast<float>(b);
        m[2][3] = -1.0F;
    }
    return { m, options.range, options.rows };
}

// A projection folded with a picture's size.
struct projection_constants {
    math<float>::ao_projection projection;
    math<float>::ao_depth_decode decode; // of a hardware depth buffer
    bool parallel = false;
};

// Preconditions: width, height > 0. Fails for matrices that are singular, not finite or of another shape (a view or model
// transformation multiplied in, a mirrored w). `background`: eye depth from which on everything is background.
constexpr result<projection_constants> fold_projection(const camera_projection& camera, int width, int height,
                                                       float background = std::numeric_limits<float>::max())
{
    const auto at = [&](int row, int column) { return static_cast<double>(camera.matrix[column][row]); };
    const auto fail = [](const char* why) { return error(errc::invalid_projection, why); };
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            if (!(at(row, column) >= -3e38 && at(row, column) <= 3e38)) {
                return fail("projection matrix is not finite");
            }
        }
    }
    const bool parallel = at(3, 2) == 0;
    const double k = parallel ? at(3, 3) : -at(3, 2);
    if (at(3, 0) != 0 || at(3, 1) != 0 || !(k > 0) || (!parallel && at(3, 3) != 0)) {
        return fail("projection matrix: last row must be (0, 0, -k, 0) or (0, 0, 0, k), k > 0");
    }
    if (at(0, 1) != 0 || at(1, 0) != 0 || (parallel ? at(0, 2) != 0 || at(1, 2) != 0 : at(0, 3) != 0 || at(1, 3) != 0)) {
        return fail("projection matrix: sheared or skewed projections are not supported");
    }
    const double row_sign = camera.rows == first_row::at_ndc_minus_one ? 1.0 : -1.0;
    const double scale_x = at(0, 0) / k * width / 2;
    const double scale_y = row_sign * at(1, 1) / k * height / 2;
    const double depth_term = parallel ? at(2, 2) / k : at(2, 3) / k;
    if (scale_x == 0 || scale_y == 0 || depth_term == 0) {
        return fail("projection matrix is singular");
    }
    const double shift_x = (parallel ? at(0, 3) : -at(0, 2)) / k;
    const double shift_y = row_sign * (parallel ? at(1, 3) : -at(1, 2)) / k;
    const double centre_x = (1 + shift_x) * width / 2;
    const double centre_y = (1 + shift_y) * height / 2;
    const double slope_x = 1 / scale_x;
    const double slope_y = 1 / scale_y;
    const double offset_x = -centre_x / scale_x;
    const double offset_y = -centre_y / scale_y;

    // ndc z = stored * unit + zero; clip z = p x + q y + r z + s
    const double unit = camera.range == depth_range::zero_to_one ? 1.0 : 2.0;
    const double zero = camera.range == depth_range::zero_to_one ? 0.0 : -1.0;
    const double p = at(2, 0) / k;
    const double q = at(2, 1) / k;
    const double r = at(2, 2) / k;
    const double s = at(2, 3) / k;
    const double common = parallel ? (s - zero + p * offset_x + q * offset_y) / r : r + zero - p * offset_x - q * offset_y;

    projection_constants folded{};
    const auto single = [](double x) { return static_cast<float>(x); };
    folded.projection = { single(scale_x), single(scale_y), single(centre_x), single(centre_y),
                          single(slope_x), single(slope_y), single(offset_x), single(offset_y) };
    folded.decode.numerator = single(s);
    folded.decode.scale = single(parallel ? -unit / r : unit);
    folded.decode.offset = single(common);
    folded.decode.slope_x = single((parallel ? p / r : -p) * slope_x);
    folded.decode.slope_y = single((parallel ? q / r : -q) * slope_y);
    folded.decode.background = background;
    // The far end of the depth range: 1 where depth grows with distance, 0 in reversed buffers.
    folded.decode.cleared = (parallel ? folded.decode.scale > 0 : s < 0) ? 1.0F : 0.0F;
    folded.parallel = parallel;
    const auto& f = folded.projection;
    for (const float x : { f.scale_x, f.scale_y, f.centre_x, f.centre_y, f.slope_x, f.slope_y, f.offset_x, f.offset_y,
                           folded.decode.numerator, folded.decode.scale, folded.decode.offset }) {
        if (!(x >= -3e38F && x <= 3e38F)) {
            return fail("projection matrix is singular");
        }
    }
    return folded;
}

} // namespace ao
