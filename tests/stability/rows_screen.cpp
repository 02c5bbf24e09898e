// 4.5: geometry of the screen.
#include "stability/figure.hpp"
#include "stability/methods.hpp"
#include "stability/planted.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"

#include "ao/conformance/functions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stability {

namespace {

constexpr float endless_f = std::numeric_limits<float>::infinity();

void mark_faulty(subject& s)
{
    s.faulty = true;
}
void infinite_thickness(subject& s)
{
    s.change_shot = [](shot& made) { made.settings.thickness = endless_f; };
}

// Mean occlusion of a wall at distance 6 by a square that floats before it by `gap`; the wall's pixels only.
double wall_occlusion(subject& s, double gap, ao::method m)
{
    const viewer v{ 48, 36, 0.5, false };
    ao::settings settings;
    settings.method = m;
    settings.filter = 1;
    settings.bias = 0.01F;
    const shot made = shoot(v, both(tilted(0, 6), square(0.8, 6 - gap)), settings);
    const auto seen = s.frame(made);
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (made.depth[i] > 5.9F) {
            sum += 1 - static_cast<double>(seen[i]);
            ++count;
        }
    }
    return sum / count;
}

// Farther before the wall than radius + thickness nothing of it may be darker.
double halo(subject& s)
{
    worst w;
    for (const ao::method m : methods) {
        const double reach = m == ao::method::box ? std::sqrt(3.0) : 1;
        w.add(wall_occlusion(s, reach + 2.05, m));
    }
    return w.value();
}

// Greatest change of the halo from one gap to the next, in steps of 0.1.
double halo_jump(subject& s)
{
    worst w;
    double last = -1;
    for (int i = 2; i <= 36; i += s.thorough ? 1 : 2) {
        const double now = wall_occlusion(s, 0.1 * i, ao::method::hemisphere);
        if (last >= 0) {
            w.add(std::abs(now - last) / (s.thorough ? 1 : 2));
        }
        last = now;
    }
    return w.value();
}

// A range check without a slope is one with few steps in depth.
void coarse_depth(subject& s)
{
    s.change_shot = [](shot& made) {
        for (float& d : made.depth) {
            d = d > 5.9F ? d : std::round(d);
        }
    };
}

// Mean difference between a picture and the same pixels of one three times as wide, within a radius of the border, where a wall
// stands at the border and just outside.
double border_difference(subject& s)
{
    worst w;
    for (const double wall : { 0.9, 1.15, 1.4 }) {
        const viewer narrow{ 40, 40, 0.25, false };
        viewer wide{ 120, 120, 0.75, false };
        ao::settings settings;
        settings.filter = 1;
        settings.bias = 0.05F;
        const solid scene = both(tilted(0, 5), plane(core_test::normalized({ -1, 0, 0.2 }), -(wall + 1.0) / std::sqrt(1.04)));
        const auto cropped = s.frame(shoot(narrow, scene, settings));
        const auto full = s.frame(shoot(wide, scene, settings));
        double sum = 0;
        int count = 0;
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 40; ++x) {
                if (std::min({ x, y, 39 - x, 39 - y }) < 16) {
                    sum += std::abs(static_cast<double>(cropped[static_cast<std::size_t>(y * 40 + x)]) -
                                    static_cast<double>(full[static_cast<std::size_t>((y + 40) * 120 + x + 40)]));
                    ++count;
                }
            }
        }
        w.add(sum / count);
    }
    return w.value();
}

// A wall that leaves the picture by steps of half a pixel: greatest change of the border's mean occlusion from step to step, of a
// picture cut out of one with a guard band of a radius on either side; faulty: without the band.
double border_pan(subject& s)
{
    worst w;
    double last = -1;
    const int band = s.faulty ? 0 : 12;
    const viewer v{ 40 + 2 * band, 30, 0.3, false };
    for (int i = 0; i < (s.thorough ? 24 : 10); ++i) {
        ao::settings settings;
        settings.filter = 1;
        settings.bias = 0.03F;
        const double at = 1.8 + 0.5 * i * (2 * 0.4 * 5 / 40);
        const auto seen = s.frame(shoot(v, both(tilted(0, 5), plane({ -1, 0, 0 }, -at)), settings));
        double now = 0;
        for (int y = 0; y < 30; ++y) {
            for (int x = band + 32; x < band + 36; ++x) {
                now += (1 - static_cast<double>(seen[static_cast<std::size_t>(y * v.width + x)])) / (30 * 4);
            }
        }
        if (last >= 0) {
            w.add(std::abs(now - last));
        }
        last = now;
    }
    return w.value();
}

// An open plane that the kernel reaches through to behind the eye.
double behind_the_eye(subject& s)
{
    worst w;
    for (const ao::method m : methods) {
        for (const double distance : { 0.11, 0.3, 0.7 }) {
            ao::settings settings;
            settings.method = m;
            settings.thickness = endless_f;
            settings.filter = 1;
            settings.bias = 1e-5F;
            w.add(1 - least(s.frame(shoot({ 24, 18, 0.6, false }, tilted(0, distance), settings))));
        }
    }
    return w.value();
}

shot busy_shot(const ao::settings& settings)
{
    const viewer v{ 32, 24, 0.5, false };
    return shoot(v, both(both(crease(0.8), tilted(0, 7)), sphere({ -0.4, -0.6, -4 }, 0.5)), settings);
}

// 1 - visibility where the kernel is far smaller than a pixel.
double small_radius(subject& s)
{
    worst w;
    for (const ao::method m : methods) {
        ao::settings settings;
        settings.method = m;
        settings.radius = 1e-4F;
        w.add(1 - least(s.frame(busy_shot(settings))));
    }
    return w.value();
}

// How far visibilities leave [0, 1] at radii up to 1e15.
double large_radius(subject& s)
{
    worst w;
    for (const float radius : { 1e-30F, 1e-10F, 1.0F, 1e3F, 1e8F, 1e15F }) {
        for (const ao::method m : methods) {
            if (!s.thorough && radius != 1e15F && m != ao::method::hemisphere) {
                continue;
            }
            ao::settings settings;
            settings.method = m;
            settings.radius = radius;
            settings.filter = 3;
            shot made = busy_shot(settings);
            for (std::size_t i = 0; i < made.depth.size(); ++i) { // single pixels in background
                made.depth[i] = i < 320 && i % 5 != 0 ? 0.0F : made.depth[i];
            }
            for (const float x : s.frame(made)) {
                w.add(x >= 0 && x <= 1 ? 0 : endless);
            }
        }
    }
    return w.value();
}

// Mean of rendered minus true occlusion of the wall by wires of a width, at their true thickness of 0.05.
double wire_error(subject& s, double half_width, float thickness)
{
    const viewer v{ 64, 48, 0.15, false };
    const solid wire = [=](const glm::dvec3& o, const glm::dvec3& d) {
        const double t = 4.6 + o.z;
        const glm::dvec3 p = o + d * t;
        return std::abs(p.x) <= half_width ? core_test::surface_point{ t, { 0, 0, 1 } } : core_test::surface_point{};
    };
    const solid scene = both(tilted(0, 5), wire);
    ao::settings settings;
    settings.filter = 1;
    settings.taps = 64;
    settings.bias = 0.01F;
    settings.thickness = thickness;
    const shot made = shoot(v, scene, settings);
    const auto seen = s.frame(made);
    core_test::pictures buffer(v.width, v.height);
    buffer.depth = made.depth;
    ao::settings truth = settings;
    truth.thickness = 0.05F;
    double sum = 0;
    int count = 0;
    for (int y = 20; y < 28; y += 2) {
        for (int x = 4; x < 60; x += 2) {
            const auto i = static_cast<std::size_t>(y * v.width + x);
            if (made.depth[i] > 4.9F) {
                sum += 1 - static_cast<double>(seen[i]) - core_test::expected_occlusion(v, scene, buffer, truth, x, y, 2000);
                ++count;
            }
        }
    }
    return sum / count;
}

double wires_with_thickness(subject& s)
{
    worst w;
    for (const double half : { 0.02, 0.08, 0.3 }) {
        w.add(std::abs(wire_error(s, half, s.faulty ? endless_f : 0.05F)));
    }
    return w.value();
}

// The documented sign: with the default thickness thin things are too dark, never too light.
double wires_by_default(subject& s)
{
    double low = 0;
    for (const double half : { 0.02, 0.08, 0.3 }) {
        const double error = wire_error(s, half, s.faulty ? 1e-3F : 2.0F);
        low = error >= low ? low : std::isnan(error) ? -endless : error;
    }
    return low;
}

// How far visibilities leave [0, 1] under normals of every direction, away from the eye, zero and tiny; some background.
double any_normal(subject& s)
{
    worst w;
    for (const ao::method m : methods) {
        for (const bool parallel : { false, true }) {
            viewer v{ 33, 21, parallel ? 3.0 : 0.5, parallel };
            ao::settings settings;
            settings.method = m;
            settings.filter = 3;
            shot made = shoot(v, both(tilted(50, 4), square(0.7, 3)), settings);
            ao::random_stream random(3);
            for (std::size_t i = 0; i < made.normals.size(); ++i) {
                made.normals[i] = ao::conformance::detail::unit_vector(random) * (i % 7 == 0    ? 1e-38F
                                                                                  : i % 11 == 0 ? 0.0F
                                                                                                : 1.0F);
                made.depth[i] = i % 13 == 0 ? 0.0F : made.depth[i];
            }
            for (const float x : s.frame(made)) {
                w.add(x >= 0 && x <= 1 ? 0 : endless);
            }
        }
    }
    return w.value();
}

// 1 - visibility of an open plane in pictures of odd shapes and projections.
double odd_viewports(subject& s)
{
    struct shape {
        int width;
        int height;
        bool parallel;
        double shift;   // off-centre
        double squeeze; // height of a pixel over its width
    };
    const shape shapes[] = { { 1, 1, false, 0, 1 },  { 1, 9, false, 0, 1 },    { 9, 1, false, 0, 1 },   { 33, 17, false, 0, 3 },
                             { 17, 33, true, 0, 1 }, { 31, 7, false, 0.4, 1 }, { 13, 11, true, 2, 0.3 } };
    worst w;
    for (const shape& x : shapes) {
        ao::settings settings;
        settings.bias = 0.3F;
        settings.filter = 3;
        viewer v{ x.width, x.height, (x.parallel ? 2.0 : 0.3) * std::min(1.0, static_cast<double>(x.height) / x.width),
                  x.parallel };
        shot made = shoot(v, tilted(0, 4), settings);
        ao::projection_options o;
        o.parallel = x.parallel;
        made.camera.projection = ao::make_projection(
            { x.shift - v.wide(), x.shift + v.wide(), -v.extent * x.squeeze, v.extent * x.squeeze, 0.1, 100 }, o);
        // Depth by the projection that is in use: a plane tilted by 0.3, so that the other border is at another depth.
        const auto p = ao::fold_projection(made.camera.projection, x.width, x.height)->projection;
        for (std::size_t i = 0; i < made.depth.size(); ++i) {
            const double column = static_cast<double>(i % static_cast<std::size_t>(x.width)) + 0.5;
            const double slope = column * static_cast<double>(p.slope_x) + static_cast<double>(p.offset_x);
            made.depth[i] = static_cast<float>(x.parallel ? 4 + 0.3 * slope : 4 / (1 - 0.3 * slope));
            made.normals[i] = core_test::normalized({ 0.3, 0, 1 });
        }
        w.add(1 - least(s.frame(made)));
    }
    return w.value();
}

double oblique_plane(subject& s)
{
    const viewer v{ 24, 18, 0.5, false };
    shot made = shoot(v, both(crease(0.8), tilted(0, 7)));
    made.settings.filter = 1;
    made.settings.bias = 0.02F;
    made.facts.depth = ao::depth_source::hardware;
    made.facts.depth_format = ao::pixel_format::d32f;
    const auto plain = s.frame(made);
    // The near plane through (0, 0, -0.5), tilted (Lengyel 2005): only how depth is stored changes.
    const glm::dvec4 near(0.2, 0.1, -1, -0.5);
    const auto& m = made.camera.projection.matrix;
    const glm::dvec4 q(1 / static_cast<double>(m[0][0]), 1 / static_cast<double>(m[1][1]), -1, 0.02);
    const double k = 1 / (near.x * q.x + near.y * q.y + near.z * q.z + near.w * q.w);
    for (int i = 0; i < 4; ++i) {
        made.camera.projection.matrix[i][2] = static_cast<float>(k * near[i]);
    }
    if (s.faulty) {
        const shot wrong = made;
        made = shoot(v, both(crease(0.8), tilted(0, 7)), made.settings);
        made.facts = wrong.facts;
        const stored_shot stored = store(wrong); // stored through the tilted plane, read without it
        return greatest_difference(plain, s.frame(made, stored));
    }
    // Taps may flip where depths are rounded differently.
    const auto seen = s.frame(made);
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        sum += std::abs(static_cast<double>(seen[i]) - static_cast<double>(plain[i])) / static_cast<double>(seen.size());
    }
    return sum;
}

} // namespace

std::vector<row> screen_rows()
{
    return {
        { "S1", "occlusion of a wall by a square farther before it than radius + thickness, every method", 0, false,
          "no tap lies within the thickness behind the square", domain::passes, halo, "infinite thickness, as printed in paper 1",
          infinite_thickness },
        { "S1c", "greatest change of that halo per 0.1 of gap, gaps 0.2 to 3.6", 0.012, false,
          "a step moves at most 0.075 of the half ball through the range check, for 15 % of the wall's pixels", domain::passes,
          halo_jump, "square's depth in steps of 1", coarse_depth },
        { "S2", "visibility within a radius of the border against a picture with a guard band, mean difference", 0.05, false,
          "policy: the surface goes on along the pixel's tangent plane; what is outside cannot be known", domain::passes,
          border_difference, "reads that wrap around", plant_wrap },
        { "S2p",
          "greatest change of occlusion near the border per half pixel while a wall leaves a picture with a guard band of a "
          "radius",
          0.05, false, "half a pixel of 0.1 units changes k by at most 3/4 of 0.05", domain::passes, border_pan,
          "no guard band: the wall is gone with its last pixel", mark_faulty },
        { "S3", "1 - visibility of open planes nearer to the eye than the radius: offsets behind the eye", 0, false, "exact",
          domain::passes, behind_the_eye, "offsets behind the eye projected like others", plant_mirror },
        { "S4", "1 - visibility at radii of 1e-4, far below a pixel, every method", 0, false, "the bias exceeds the radius",
          domain::passes, small_radius, "bias 0 (paper 1 without delta)",
          [](subject& s) { s.change_shot = [](shot& made) { made.settings.bias = 0; }; } },
        { "S4r", "visibilities outside [0, 1], radii 1e-30 to 1e15", 0, false, "exact", domain::passes, large_radius,
          "background blurred in", plant_blur },
        { "S5", "occlusion by wires against truth, |mean error|, thickness set to the wires'", 0.02, false,
          "sampling of 112 pixels of 64 taps: 0.4 / sqrt(7168) is 0.005; bias 0.01", domain::passes, wires_with_thickness,
          "infinite thickness, as printed", mark_faulty },
        { "S5d", "least mean error of occlusion by wires, default thickness: too dark, never too light", -0.01, true,
          "documented sign; sampling as in S5", domain::passes, wires_by_default, "thickness below the wires'", mark_faulty },
        { "S6", "visibilities outside [0, 1]: normals of any direction, zero, 1e-38; perspective and parallel", 0, false, "exact",
          domain::passes, any_normal, "background blurred in", plant_blur },
        { "S7", "1 - visibility of an open plane: 1x1, 1xN, odd sizes, oblong pixels, parallel, off-centre", 0, false,
          "bias covers half a pixel", domain::passes, odd_viewports, "reads that wrap around", plant_wrap },
        { "S7o", "visibility under an oblique near plane against a plain one, mean difference", 2e-3, false,
          "only the rounding of stored depths differs: 1e-6 of taps flip, each by 1/32", domain::passes, oblique_plane,
          "stored through the oblique plane, read without it", mark_faulty },
    };
}

} // namespace stability
