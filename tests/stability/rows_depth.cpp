// 4.4: storage of depth and position.
#include "stability/figure.hpp"
#include "stability/methods.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"
#include "stability/stills.hpp"

#include "ao/conformance/functions.hpp"
#include "conformance/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace stability {

namespace {

using ids = ao::conformance::evaluator<float>;
constexpr float endless_f = std::numeric_limits<float>::infinity();

// Largest change of depth within half a pixel of a centre: what the bias must cover (docs/integrating.md).
double half_pixel_step(const viewer& v, const solid& scene)
{
    double most = 0;
    for (int y = 0; y < v.height; ++y) {
        for (int x = 0; x < v.width; ++x) {
            const double middle = v.see(scene, x + 0.5, y + 0.5).depth;
            for (const double dx : { 0.0, 1.0 }) {
                for (const double dy : { 0.0, 1.0 }) {
                    most = std::max(most, std::abs(v.see(scene, x + dx, y + dy).depth - middle));
                }
            }
        }
    }
    return most;
}

// A viewer of a tilted plane at distance 1 in which half a pixel changes depth by `step`; the widest is 0.3.
viewer viewer_of(double tilt, double step)
{
    viewer v{ 28, 21, 0.3, false };
    double low = 1e-6;
    double high = 0.3;
    for (int i = 0; i < 40 && tilt > 0; ++i) {
        v.extent = (low + high) / 2;
        (half_pixel_step(v, tilted(tilt, 1)) > step ? high : low) = v.extent;
    }
    v.extent = tilt > 0 ? low : 0.3;
    return v;
}

// 1 - least visibility over open planes; the bias covers half a pixel and nothing else, storage is the plan's to cover.
double open_planes(subject& s)
{
    worst w;
    std::size_t turn = 0;
    const std::vector<double> distances =
        s.thorough ? std::vector<double>{ 0.1, 1, 10, 100, 1e3, 1e4, 1e5 } : std::vector<double>{ 0.1, 30, 1e5 };
    const std::vector<double> tilts =
        s.thorough ? std::vector<double>{ 0, 20, 40, 60, 75, 85 } : std::vector<double>{ 0, 60, 85 };
    for (const double distance : distances) {
        for (const depth_storage& d : depth_storages) {
            if (d.format == ao::pixel_format::rgba16f && distance > 3e4) {
                continue; // beyond half floats: D2
            }
            for (const ao::method m : methods) {
                if (!s.thorough && turn++ % methods.size() != 0) {
                    continue;
                }
                for (const double tilt : tilts) {
                    const viewer v = viewer_of(tilt, 5e-4);
                    ao::settings settings;
                    settings.method = m;
                    settings.filter = 1;
                    settings.thickness = endless_f;
                    settings.radius = static_cast<float>(0.02 * distance);
                    settings.bias = tilt > 0 ? static_cast<float>(5.0005e-4 * distance) : 0.0F;
                    const bool usual_planes = distance >= 1 && distance <= 100;
                    shot made = shoot(v, tilted(tilt, distance), settings);
                    if (s.faulty) { // half floats, and the plan does not know
                        for (float& x : made.depth) {
                            x = distance < 6e4 ? ao::half_to_float(ao::float_to_half(x)) : x;
                        }
                    }
                    else {
                        made = stored_as(made, d, v, usual_planes ? 0.1 : distance / 100, usual_planes ? 1000 : distance * 100);
                    }
                    w.add(1 - least(s.frame(made)));
                }
            }
        }
    }
    return w.value();
}

// Steps of half-float depths over the bias that the plan gives them; faulty: over a constant one, 0.02.
double half_steps(subject& s)
{
    shot made = stored_as(shoot({ 2, 2, 0.3, false }, tilted(0, 1)), depth_storages[4], { 2, 2, 0.3, false }, 0.1, 1e5);
    made.settings.bias = 0;
    const auto plan = ao::make_plan(made.settings, made.facts, made.camera);
    double linear = 0;
    for (const ao::pass& p : plan->passes) {
        if (p.type == ao::pass_type::occlusion) {
            linear = static_cast<double>(ao::constants_of<ao::occlusion_constants>(p).bias_linear);
        }
    }
    worst w;
    for (float d = 0.001F; d < 65504.0F; d *= 1.37F) {
        const std::uint16_t code = ao::float_to_half(d);
        const double step =
            static_cast<double>(ao::half_to_float(static_cast<std::uint16_t>(code + 1)) - ao::half_to_float(code));
        w.add(step / (s.faulty ? 0.02 : linear * static_cast<double>(d)));
    }
    return w.value();
}

// Half-float positions beyond 65504 are infinite: background, exactly open, and no occluder to what lies before them.
double half_overflow(subject& s)
{
    const viewer v{ 24, 18, 0.3, false };
    shot made = stored_as(shoot(v, both(tilted(0, 1e5), square(0.1, 1))), depth_storages[4], v, 0.1, 1e6);
    made.settings.thickness = endless_f;
    made.settings.filter = 1;
    if (s.faulty) { // clamped to the greatest half float instead
        for (float& d : made.depth) {
            d = std::min(d, 65504.0F);
        }
        made.settings.radius = 1e5F;
    }
    return 1 - least(s.frame(made));
}

// Strongest line of the spectrum of 1 - visibility over a tilted plane's rows.
double moire(subject& s)
{
    worst w;
    for (const double tilt : { 45.0, 70.0 }) {
        const viewer v = viewer_of(tilt, 0.02);
        ao::settings settings;
        settings.filter = 1;
        settings.bias = s.faulty ? 0.0F : 0.020002F * 4;
        settings.thickness = endless_f;
        const auto seen = s.frame(shoot(v, tilted(tilt, 4), settings));
        for (int line = 1; line <= v.width / 2; ++line) {
            std::complex<double> sum = 0;
            for (std::size_t i = 0; i < seen.size(); ++i) {
                const double phase =
                    6.283185307179586 * line * static_cast<double>(i % static_cast<std::size_t>(v.width)) / v.width;
                sum += (1 - static_cast<double>(seen[i])) * std::polar(1.0, phase);
            }
            w.add(std::abs(sum) / static_cast<double>(seen.size()));
        }
    }
    return w.value();
}

// Occlusion that the bias takes from a right-angled crease near its corner, mean over its closed form (1 - h)^2 (2 + h) / 4.
double contact_lost(subject& s)
{
    const viewer v{ 96, 72, 0.5, false };
    const glm::dvec3 up(0, 0.6, 0.8);
    const glm::dvec3 left = core_test::normalized({ -1, 0, 0.0001 });
    const solid scene = both(plane(up, -4), plane(left, left.x * 0.8));
    ao::settings settings;
    settings.taps = 64;
    settings.filter = 1;
    settings.bias = 0.03F;
    settings.thickness = endless_f;
    const shot made = shoot(v, scene, settings);
    const auto seen = s.frame(made);
    double sum = 0;
    int count = 0;
    for (int y = 12; y < 60; ++y) {
        for (int x = 0; x < v.width; ++x) {
            const auto i = static_cast<std::size_t>(y * v.width + x);
            const glm::dvec3 p = v.point(x + 0.5, y + 0.5, static_cast<double>(made.depth[i]));
            const double h = 0.8 - p.x;
            if (made.normals[i].x > -0.5F && h > 0.05 && h < 0.5) {
                sum += (1 - h) * (1 - h) * (2 + h) / 4 - (1 - static_cast<double>(seen[i]));
                ++count;
            }
        }
    }
    return count > 200 ? sum / count : endless;
}

void large_bias(subject& s)
{
    s.change_shot = [](shot& made) { made.settings.bias = 0.25F; };
}

// Background, in every convention of hardware depth, beside a surface: exactly open, and no occluder.
double cleared_background(subject& s)
{
    worst w;
    for (const bool reversed : { false, true }) {
        for (const double far : { 100.0, std::numeric_limits<double>::infinity() }) {
            for (const auto range : { ao::depth_range::zero_to_one, ao::depth_range::minus_one_to_one }) {
                const viewer v{ 24, 18, 0.6, false };
                shot made = shoot(v, square(1, 4));
                made.settings.filter = 1;
                made.settings.thickness = endless_f;
                made.facts.depth = ao::depth_source::hardware;
                made.facts.depth_format = ao::pixel_format::d32f;
                made.camera.projection =
                    ao::make_projection({ -0.8, 0.8, -0.6, 0.6, 0.1, far }, { .range = range, .reversed = reversed });
                stored_shot stored = store(made);
                for (std::size_t i = 0; s.faulty && i < made.depth.size(); ++i) {
                    if (made.depth[i] == 0.0F) { // cleared to the near end
                        stored.depth.set_texel(i, 1 - stored.depth.texel<float>(i));
                    }
                }
                w.add(1 - least(s.frame(made, stored)));
            }
        }
    }
    return w.value();
}

// Pixels that a pixel's centre is off after unprojection and projection, 1920x1080, every convention, depths 0.3 to 50.
double round_trip(subject& s)
{
    worst w;
    for (const bool parallel : { false, true }) {
        std::vector<glm::vec4> unproject;
        std::vector<glm::vec4> project;
        std::vector<glm::vec4> pixels;
        for (const convention& c : all_conventions()) {
            const auto p = ao::fold_projection(projection_of(c), 1920, 1080)->projection;
            for (int i = 0; i < 400 && c.options.parallel == parallel; ++i) {
                const auto x = static_cast<float>(i * 641 % 1920) + 0.5F;
                const auto y = static_cast<float>(i * 421 % 1080) + 0.5F;
                // The four constants of either direction, in the order of ao_projection.
                unproject.emplace_back(p.slope_x, p.slope_y, p.offset_x, p.offset_y);
                project.emplace_back(p.scale_x, p.scale_y, p.centre_x, p.centre_y);
                pixels.emplace_back(x, y, 0.3F * std::pow(1.013F, static_cast<float>(i)), 0.0F);
            }
        }
        const auto points = s.evaluate(parallel ? ids::ao_of_view_point_parallel : ids::ao_of_view_point, unproject, pixels);
        const auto back = s.evaluate(parallel ? ids::ao_of_to_pixel_parallel : ids::ao_of_to_pixel, project, points);
        for (std::size_t i = 0; i < back.size(); ++i) {
            w.add(std::abs(static_cast<double>(back[i].x) - static_cast<double>(pixels[i].x)));
            w.add(std::abs(static_cast<double>(back[i].y) - static_cast<double>(pixels[i].y)));
        }
    }
    return w.value();
}

// As if the centre of a pixel were its corner.
void half_pixel_off(subject& s)
{
    subject plain(s);
    s.evaluate_instead = [plain](int function, auto a, auto b, auto out) mutable {
        const auto made = plain.evaluate(function, { a.begin(), a.end() }, { b.begin(), b.end() });
        const bool pixel = function == ids::ao_of_to_pixel || function == ids::ao_of_to_pixel_parallel;
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = made[i] - (pixel ? glm::vec4(0.5F, 0.5F, 0, 0) : glm::vec4(0));
        }
    };
}

// Temporal visibility in a pan at 10^6 units from the origin against the same at the origin, mean difference.
double far_from_origin(subject& s)
{
    std::vector<std::vector<float>> seen;
    for (const double origin : { 0.0, 1e6 }) {
        temporal_run run(s);
        run.settings.filter = 1;
        run.settings.first_samples = 16;
        temporal_test::stage stage{ .width = 32, .height = 24, .origin = { origin, origin, -origin } };
        temporal_test::stage before = stage;
        run.facts = temporal_test::facts_of(stage, false);
        if (!run.start()) {
            return endless;
        }
        for (int i = 0; i < 6; ++i) {
            stage.eye[0] = 0.04 * i;
            stage.yaw = 0.002 * i;
            auto frame = temporal_test::make_frame(stage, before);
            for (double& x : frame.camera.eye) {
                x = s.faulty ? static_cast<double>(static_cast<float>(x)) : x;
            }
            if (!run.step(frame)) {
                return endless;
            }
            before = stage;
        }
        seen.push_back(run.visibility());
    }
    double sum = 0;
    for (std::size_t i = 0; i < seen[0].size(); ++i) {
        sum += std::abs(static_cast<double>(seen[0][i]) - static_cast<double>(seen[1][i]));
    }
    return sum / static_cast<double>(seen[0].size());
}

void mark_faulty(subject& s)
{
    s.faulty = true;
}

} // namespace

std::vector<row> depth_rows()
{
    return {
        { "D1",
          "1 - visibility of open planes, tilts 0 to 85 degrees, distances 0.1 to 1e5, every depth format and method; bias of "
          "half a pixel only",
          1e-3, false, "numerics.md D1", domain::passes, open_planes, "half-float depths under a bias that knows nothing of them",
          mark_faulty },
        { "D2", "step of half-float depths over the plan's own bias, depths 0.001 to 65504", 1, false,
          "pixel and tap are truncated alike: one step apart at most", domain::core, half_steps, "a constant bias of 0.02",
          mark_faulty },
        { "D2o", "1 - visibility of a square before a surface at 1e5 in half-float positions, which is infinite there", 0, false,
          "background is open and no occluder", domain::passes, half_overflow, "clamped to 65504 instead", mark_faulty },
        { "D3", "strongest line in the spectrum of 1 - visibility over a tilted plane, documented bias", 1e-6, false,
          "the plane is exactly open", domain::passes, moire, "bias 0", mark_faulty },
        { "D3c", "occlusion lost in a crease at 0.05 to 0.5 radii, mean, bias 0.03 radii", 0.01, false,
          "dk/dh is at most 3/4; half a pixel is 0.02, either way; the wall is seen edge-on", domain::passes, contact_lost,
          "bias 0.25", large_bias },
        { "D4", "1 - visibility of background and of a square before it: 0..1, -1..1, reversed, infinite", 0, false, "exact",
          domain::passes, cleared_background, "buffer cleared to the near end", mark_faulty },
        { "D4p", "pixels off after unprojecting and projecting, 1920x1080, 32 conventions", 0.01, false, "numerics.md D4",
          domain::passes, round_trip, "pixel corners for centres", half_pixel_off },
        { "D5", "temporal visibility in a pan 1e6 units from the origin against at the origin, mean difference", 1e-3, false,
          "eyes differ in double; numerics.md D5", domain::temporal, far_from_origin, "eye positions in float", mark_faulty },
    };
}

} // namespace stability
