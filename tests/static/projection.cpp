// Folding projection matrices of every convention, as constant expressions.
#include "ao/projection.hpp"
#include "static/support.hpp"

namespace {

using namespace static_test;

constexpr double infinite = std::numeric_limits<double>::infinity();

// A view-space point through the matrix, as the API's rasteriser would place it: pixel and stored depth.
struct placed {
    double column;
    double row;
    double stored;
};

constexpr placed place(const ao::camera_projection& camera, double width, double height, double x, double y, double z)
{
    double clip[4] = {};
    const double point[4] = { x, y, z, 1 };
    for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < 4; ++c) {
            clip[r] += static_cast<double>(camera.matrix[c][r]) * point[c];
        }
    }
    const double ndc_y = clip[1] / clip[3];
    const double ndc_z = clip[2] / clip[3];
    return { (clip[0] / clip[3] * 0.5 + 0.5) * width,
             (camera.rows == ao::first_row::at_ndc_minus_one ? ndc_y * 0.5 + 0.5 : 0.5 - ndc_y * 0.5) * height,
             camera.range == ao::depth_range::zero_to_one ? ndc_z : ndc_z * 0.5 + 0.5 };
}

constexpr bool agrees(const ao::camera_projection& camera, int width, int height)
{
    using m = ao::math<float>;
    const auto folded = ao::fold_projection(camera, width, height);
    if (!folded) {
        return false;
    }
    const double points[3][3] = { { 0.3, -0.2, -0.5 }, { -1.5, 1.25, -3 }, { 2, 1, -40 } };
    for (const auto& p : points) {
        const placed truth = place(camera, width, height, p[0], p[1], p[2]);
        const m::vec3 point(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
        const m::vec2 pixel = m::ao_to_pixel(folded->projection, point, folded->parallel);
        const float d = m::ao_eye_depth(folded->decode, pixel, static_cast<float>(truth.stored), folded->parallel);
        const m::vec3 back = m::ao_view_point(folded->projection, pixel, point.z * -1, folded->parallel);
        if (!near(static_cast<double>(pixel.x), truth.column, 0.01) || !near(static_cast<double>(pixel.y), truth.row, 0.01) ||
            !near(static_cast<double>(d), -p[2], 1e-3 * -p[2]) || !near(back, point, 1e-4F)) {
            return false;
        }
    }
    return true;
}

constexpr bool every_convention(const ao::frustum& f, bool parallel)
{
    for (int bits = 0; bits < 16; ++bits) {
        ao::projection_options options;
        options.range = (bits & 1) != 0 ? ao::depth_range::minus_one_to_one : ao::depth_range::zero_to_one;
        options.rows = (bits & 2) != 0 ? ao::first_row::at_ndc_plus_one : ao::first_row::at_ndc_minus_one;
        options.reversed = (bits & 4) != 0;
        options.y_down = (bits & 8) != 0;
        options.parallel = parallel;
        const ao::camera_projection camera = ao::make_projection(f, options);
        if (!agrees(camera, 64, 48) || ao::fold_projection(camera, 64, 48)->decode.cleared != (options.reversed ? 0.0F : 1.0F)) {
            return false;
        }
    }
    return true;
}

static_assert(every_convention({}, false));
static_assert(every_convention({ -0.5, 1.5, -2, 0.25, 0.1, 100 }, false));
static_assert(every_convention({ -1, 1, -1, 1, 0.1, infinite }, false));
static_assert(every_convention({ -4, 3, -2, 5, 0.1, 100 }, true));
// A near plane behind the eye is fine in parallel projection.
static_assert(every_convention({ -4, 3, -2, 5, -10, 100 }, true));

constexpr ao::camera_projection changed(int row, int column, float value, bool parallel = false)
{
    ao::projection_options options;
    options.parallel = parallel;
    ao::camera_projection camera = ao::make_projection({}, options);
    camera.matrix[column][row] = value;
    return camera;
}
constexpr bool refused(const ao::camera_projection& camera)
{
    const auto folded = ao::fold_projection(camera, 64, 48);
    return !folded && folded.error().code() == ao::errc::invalid_projection && !folded.error().reason().empty();
}
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

constexpr bool refused_everywhere(float value)
{
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            if (!refused(changed(row, column, value))) {
                return false;
            }
        }
    }
    return true;
}
static_assert(refused_everywhere(nan) && refused_everywhere(inf) && refused_everywhere(-inf));
static_assert(refused(changed(0, 0, 0.0F)) && refused(changed(1, 1, 0.0F)) && refused(changed(2, 3, 0.0F)));
static_assert(refused(changed(2, 2, 0.0F, true)));
static_assert(refused(changed(0, 1, 0.1F)) && refused(changed(1, 0, 0.1F)));
static_assert(refused(changed(0, 3, 0.1F)) && refused(changed(0, 2, 0.1F, true)));
static_assert(refused(changed(3, 0, 0.1F)) && refused(changed(3, 1, 0.1F)));
static_assert(refused(changed(3, 2, 1.0F))); // w = +z: looks along +Z
static_assert(refused(changed(3, 3, 1.0F))); // neither perspective nor parallel
static_assert(refused(changed(3, 3, -1.0F, true)));
static_assert(refused(changed(3, 2, 0.0F))); // w = 0
static_assert(refused({ ao::matrix4::zero(), {}, {} }));
// Subnormal scales: the inverse overflows a float.
static_assert(refused(changed(0, 0, 1e-44F)));
static_assert(ao::fold_projection({ ao::matrix4(), {}, {} }, 64, 48)->parallel); // the identity is a parallel projection

// An oblique near plane (Lengyel 2005): the depth row is any plane.
static_assert([] {
    ao::camera_projection camera = ao::make_projection({});
    camera.matrix[0][2] = 0.05F;
    camera.matrix[1][2] = -0.03F;
    return agrees(camera, 64, 48);
}());

using m = ao::math<float>;
constexpr m::ao_depth_decode decode = ao::fold_projection(ao::make_projection({}), 64, 48, 50.0F)->decode;
static_assert(m::ao_eye_depth(decode, m::vec2(0.5F, 0.5F), decode.cleared, false) == 0.0F);
static_assert(m::ao_eye_depth(decode, m::vec2(0.5F, 0.5F), 2.0F, false) == 0.0F);    // beyond infinity
static_assert(m::ao_eye_depth(decode, m::vec2(0.5F, 0.5F), 0.9999F, false) == 0.0F); // beyond `background`
static_assert(m::ao_eye_depth(decode, m::vec2(0.5F, 0.5F), 0.9F, false) > 0.9F);
// Reversed depth: a driver may take a denormal for the cleared 0, so every denormal counts as that.
constexpr m::ao_depth_decode reversed{ 0, -59.75F, 60, 0, 0, 1e30F, 0, 0 };
static_assert(m::ao_eye_depth(reversed, m::vec2(0.5F, 0.5F), 1e-40F, true) == 0.0F);
static_assert(m::ao_eye_depth(reversed, m::vec2(0.5F, 0.5F), 1e-30F, true) == 60.0F);

// Shared constants hold reals only, a multiple of four of them.
static_assert(sizeof(m::ao_projection) == 32 && sizeof(m::ao_depth_decode) == 32 && sizeof(m::ao_rotation) == 48);
static_assert(sizeof(ao::math<double>::ao_projection) == 64);

} // namespace
