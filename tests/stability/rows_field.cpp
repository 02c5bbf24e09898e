// Entries of numerics.md 7 that no row of 4 measures.
#include "stability/figure.hpp"
#include "stability/methods.hpp"
#include "stability/planted.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"
#include "stability/stills.hpp"

#include "ao/conformance/reference.hpp"
#include "conformance/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace stability {

namespace {

constexpr float endless_f = std::numeric_limits<float>::infinity();

void mark_faulty(subject& s)
{
    s.faulty = true;
}

double mean_occlusion(subject& s, const shot& made)
{
    return 1 - mean(s.frame(made));
}

// 7.5. Occlusion that a thick wall loses before infinite thickness, mean over the picture.
double thick_wall(subject& s)
{
    ao::settings settings;
    settings.bias = 0.03F;
    settings.filter = 1;
    shot made = shoot({ 64, 48, 0.5, false }, both(tilted(0, 6), plane({ -1, 0, 0 }, -1.5)), settings);
    made.settings.thickness = endless_f;
    const double all = mean_occlusion(s, made);
    made.settings.thickness = s.faulty ? 0.1F : 2.0F;
    return (all - mean_occlusion(s, made)) / all;
}

// 7.9. Slope of the squared error against taps, 8 to 128, on an edge and its crease.
double noise_slope(subject& s)
{
    const auto with = [](int taps) {
        ao::settings settings;
        settings.method = ao::method::halton;
        settings.taps = taps;
        settings.filter = 1;
        settings.bias = 0.03F;
        return shoot({ 64, 48, 0.5, false }, both(crease(0.6), plane({ 0, 0, 1 }, -6)), settings);
    };
    static const ao::picture truth = [&] { // by the reference, which compiles nothing
        const shot made = with(ao::max_taps);
        const stored_shot stored = store(made);
        return ao::conformance::reference_visibility(*ao::make_plan(made.settings, made.facts, made.camera), stored.depth,
                                                     stored.normal);
    }();
    double xx = 0;
    double xy = 0;
    double sx = 0;
    double sy = 0;
    const std::array counts{ 8, 32, 128 };
    for (const int taps : counts) {
        const auto seen = s.frame(with(s.faulty ? std::min(taps, 16) : taps));
        double sum = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const double e = static_cast<double>(seen[i]) - static_cast<double>(truth.texel<float>(i));
            sum += e * e / static_cast<double>(seen.size());
        }
        const double x = std::log(taps);
        const double y = std::log(sum);
        sx += x;
        sy += y;
        xx += x * x;
        xy += x * y;
    }
    const double n = static_cast<double>(counts.size());
    return (n * xy - sx * sy) / (n * xx - sx * sx);
}

// Mean difference between the columns on either side of the middle.
double middle_contrast(const std::vector<float>& seen)
{
    double contrast = 0;
    for (std::size_t y = 0; y < 16 && seen.size() == 32 * 16; ++y) {
        contrast += (static_cast<double>(seen[32 * y + 16]) - static_cast<double>(seen[32 * y + 15])) / 16;
    }
    return contrast;
}

// 7.10. Contrast over a jump of depth between closed and open that a filter of 5 loses, of the temporal filter; faulty: of the
// box filter of paper 1.
double lost_contrast(subject& s)
{
    double contrast[2]{};
    for (const bool filtered : { false, true }) {
        if (s.faulty) {
            ao::settings settings;
            settings.filter = filtered ? 5 : 1;
            settings.bias = 0;
            settings.radius = 0.5F;
            shot made = shoot({ 32, 16, 0.5, false }, tilted(0, 4), settings);
            for (std::size_t i = 0; i < made.depth.size(); ++i) {
                made.depth[i] = i % 32 < 16 ? 2.0F : 60.0F;
                made.normals[i] = { 0, 0, i % 32 < 16 ? -1.0F : 1.0F };
            }
            contrast[filtered ? 1 : 0] = middle_contrast(s.frame(made));
            continue;
        }
        const temporal_test::stage stage{ .width = 32, .height = 16 };
        auto frame = temporal_test::make_frame(stage, stage);
        for (std::size_t i = 0; i < frame.inputs.depth.pixels(); ++i) {
            const bool left = i % 32 < 16;
            frame.inputs.depth.set_texel(i, left ? 2.0F : 60.0F);
            frame.inputs.normal.set_texel(i, glm::vec4(0, 0, left ? -1.0F : 1.0F, 0));
        }
        temporal_run run(s);
        run.facts = temporal_test::facts_of(stage, false);
        run.settings.filter = filtered ? 5 : 1;
        run.settings.radius = 0.5F;
        run.settings.bias = 0;
        run.settings.spatial = 1;
        if (!run.start() || !run.step(frame)) {
            return endless;
        }
        contrast[filtered ? 1 : 0] = middle_contrast(run.visibility());
    }
    return contrast[0] > 0.5 ? 1 - contrast[1] / contrast[0] : endless;
}

// 7.11. Contrast of a crevice two pixels wide after a filter, as a share of what it is without.
double crevice(subject& s)
{
    ao::settings settings;
    settings.filter = 1;
    settings.bias = 0.01F;
    settings.radius = 0.4F;
    shot made = shoot({ 64, 48, 0.3, false }, tilted(0, 4), settings);
    for (std::size_t i = 0; i < made.depth.size(); ++i) {
        made.depth[i] = i % 64 / 2 == 16 ? 4.3F : 4.0F;
    }
    const auto contrast = [&](int filter) {
        made.settings.filter = filter;
        const auto seen = s.frame(made);
        double in = 0;
        double out = 0;
        for (std::size_t y = 8; y < 40; ++y) {
            in += static_cast<double>(seen[64 * y + 32]) + static_cast<double>(seen[64 * y + 33]);
            out += static_cast<double>(seen[64 * y + 12]) + static_cast<double>(seen[64 * y + 50]);
        }
        return out - in;
    };
    return contrast(s.faulty ? 15 : 5) / contrast(1);
}

// A ball of flat faces, cut by planes at distance 1 from its centre along the points of a spiral.
solid faceted(bool smooth_normals)
{
    std::vector<glm::dvec3> faces;
    for (int i = 0; i < 120; ++i) {
        const double z = 1 - (2 * i + 1) / 120.0;
        const double angle = 2.399963229728653 * i;
        const double across = std::sqrt(1 - z * z);
        faces.emplace_back(across * std::cos(angle), across * std::sin(angle), z);
    }
    const glm::dvec3 centre(0, 0, -4);
    return [=](const glm::dvec3& o, const glm::dvec3& d) {
        double enter = 0;
        double leave = 1e30;
        glm::dvec3 normal(0, 0, 1);
        for (const glm::dvec3& n : faces) {
            const double along = core_test::dot(n, d);
            const double t = (1 - core_test::dot(n, o - centre)) / along;
            if (along < 0 && t > enter) {
                enter = t;
                normal = n;
            }
            if (along > 0) {
                leave = std::min(leave, t);
            }
        }
        if (enter <= 0 || enter >= leave) {
            return core_test::surface_point{};
        }
        return core_test::surface_point{ enter, smooth_normals ? core_test::normalized(o + d * enter - centre) : normal };
    };
}

// 7.12. Mean occlusion of a convex ball of 120 flat faces: by the faces' normals none; faulty: by those of the round ball.
double facets(subject& s)
{
    ao::settings settings;
    settings.filter = 1;
    settings.bias = 0.002F;
    settings.radius = 0.1F;
    shot made = shoot({ 128, 96, 0.25, false }, faceted(s.faulty), settings);
    const auto seen = s.frame(made);
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (made.depth[i] > 0 && made.normals[i].z > 0.8F) {
            sum += 1 - static_cast<double>(seen[i]);
            ++count;
        }
    }
    return count > 500 ? sum / count : endless;
}

// 7.18 and 7.19. How much occlusion rises from one distance to the next one farther away, in a dolly from 4 to 4096 units, and
// what of it is left at the end.
double dolly_over(subject& s, double tilt, const ao::settings& settings)
{
    worst w;
    double last = -1;
    for (double distance = 4; distance <= 4096; distance *= s.thorough ? 2 : 4) {
        const solid scene = both(tilted(tilt, distance), square(0.6, distance - 0.3));
        const double now = mean_occlusion(s, shoot({ 48, 36, 0.3, false }, scene, settings));
        if (last >= 0) {
            w.add(now - last);
        }
        last = now;
    }
    w.add(last);
    return w.value();
}

ao::settings kernel_with(float bias)
{
    ao::settings settings;
    settings.filter = 1;
    settings.radius = 0.5F;
    settings.bias = bias;
    return settings;
}

double dolly(subject& s)
{
    return s.faulty ? dolly_over(s, 30, kernel_with(0.0F)) : dolly_over(s, 0, kernel_with(0.02F));
}

// A tilted plane, whose depth changes within a pixel by more than any fixed bias.
double tilted_dolly(subject& s)
{
    return dolly_over(s, 30, kernel_with(s.faulty ? 0.0F : 0.02F));
}

// By the settings to take, which measure heights over the tangent plane.
double bitmask_dolly(subject& s)
{
    return dolly_over(s, 30, s.faulty ? kernel_with(0.02F) : ao::settings_of(ao::preset::high, 0.5F));
}

// 7.20. Mean visibility at three resolutions; faulty: a radius in pixels.
double resolutions(subject& s)
{
    double low = 1;
    double high = 0;
    for (const int scale : { 2, 3, 4 }) {
        ao::settings settings;
        settings.filter = 1;
        settings.bias = 0.05F;
        settings.radius = s.faulty ? 3.0F / static_cast<float>(scale) : 1.0F;
        const double now =
            mean(s.frame(shoot({ 24 * scale, 18 * scale, 0.5, false }, both(crease(0.8), tilted(0, 7)), settings)));
        low = std::min(low, now);
        high = std::max(high, now);
    }
    return high - low;
}

// 7.21. 1 - visibility of an open plane at sizes 1 to 33.
double all_sizes(subject& s)
{
    worst w;
    const bool quick = std::string_view(s.name()).substr(0, 3) == "cpu";
    for (int width = 1; width <= 33; width += quick || s.thorough ? 1 : 8) {
        for (int height = 1; height <= 33; height += s.thorough && quick ? 1 : 8) {
            ao::settings settings;
            settings.taps = 4;
            settings.filter = 3;
            settings.bias = 0.2F;
            const viewer v{ width, height, 0.3 * std::min(1.0, static_cast<double>(height) / width), false };
            w.add(1 - least(s.frame(shoot(v, tilted(35, 4), settings))));
        }
    }
    return w.value();
}

// 7.23. Perspective of a narrow view from far away against a parallel projection, mean difference; faulty: of a wide view.
double narrow_view(subject& s)
{
    const double distance = s.faulty ? 4 : 4000;
    ao::settings settings;
    settings.filter = 1;
    settings.bias = 0.05F;
    const viewer flat{ 48, 36, 2, true };
    const solid near = both(tilted(20, 6), both(square(0.5, 5.5), sphere({ -0.8, 0.9, -5.6 }, 0.7)));
    const shot parallel = shoot(flat, near, settings);
    shot perspective = parallel;
    perspective.facts.parallel = false;
    perspective.camera = viewer{ 48, 36, 2 / distance, false }.camera();
    for (float& d : perspective.depth) {
        d += static_cast<float>(distance - 4);
    }
    const auto a = s.frame(parallel);
    const auto b = s.frame(perspective);
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])) / static_cast<double>(a.size());
    }
    return sum;
}

// 7.25. The 32 conventions: greatest mean difference from the first one with the same order of rows, and of means where rows are
// the other way round; faulty: the range of depth mistaken.
double conventions(subject& s)
{
    worst w;
    for (const bool parallel : { false, true }) {
        std::vector<float> first[2];
        for (const convention& c : all_conventions()) {
            if (c.options.parallel != parallel) {
                continue;
            }
            const auto seen = scene_in(c, 48, 33);
            shot made;
            made.settings.bias = 0.03F;
            made.settings.filter = 3;
            made.facts.width = 48;
            made.facts.height = 33;
            made.facts.parallel = parallel;
            made.facts.normal_format = ao::pixel_format::rgba32f;
            made.facts.depth = ao::depth_source::hardware;
            made.facts.depth_format = ao::pixel_format::d32f;
            made.camera.projection = projection_of(c);
            made.depth = seen.depth;
            made.normals = seen.normals;
            const stored_shot stored = store(made);
            if (s.faulty) {
                made.camera.projection.range = c.options.range == ao::depth_range::zero_to_one ? ao::depth_range::minus_one_to_one
                                                                                               : ao::depth_range::zero_to_one;
            }
            const auto visible = s.frame(made, stored);
            auto& expected = first[c.bottom_first ? 1 : 0];
            if (expected.empty()) {
                expected = visible;
            }
            double sum = 0;
            for (std::size_t i = 0; i < visible.size(); ++i) {
                sum += std::abs(static_cast<double>(visible[i]) - static_cast<double>(expected[i])) /
                       static_cast<double>(visible.size());
            }
            w.add(sum);
        }
        w.add(std::abs(mean(first[0]) - mean(first[1])));
    }
    return w.value();
}

// 7.34. Mean visibility of 8, 32 and 128 taps, per method; faulty: of different methods.
double presets(subject& s)
{
    worst w;
    for (const ao::method m : methods) {
        double low = 1;
        double high = 0;
        for (const int taps : { 8, 32, 128 }) {
            double now = 0;
            const std::uint32_t seeds = s.thorough ? 8 : 2;
            for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
                ao::settings settings;
                settings.method = s.faulty ? (taps == 8 ? ao::method::box : m) : m;
                settings.taps = taps;
                settings.bias = 0.05F;
                settings.filter = 1;
                settings.seed = seed;
                now += mean(s.frame(shoot({ 48, 36, 0.5, false }, both(crease(0.8), tilted(0, 7)), settings))) / seeds;
            }
            low = std::min(low, now);
            high = std::max(high, now);
        }
        w.add((high - low) / high);
    }
    return w.value();
}

} // namespace

std::vector<row> field_rows()
{
    return {
        { "7.5", "share of a thick wall's occlusion that the default thickness loses against infinite", 0.1, false,
          "two radii reach through all offsets but those that look along the wall from far away", domain::passes, thick_wall,
          "thickness of 0.1 radii", mark_faulty },
        { "7.9", "slope of the squared error against taps, halton, 8 to 128, over a crease", -1, false, "numerics.md 7.9",
          domain::passes, noise_slope, "16 taps at most", mark_faulty },
        { "7.10", "contrast over a jump of depth that the temporal filter of 5 loses", 0.05, false,
          "numerics.md 7.10: 95 % stays", domain::temporal, lost_contrast, "box filter of paper 1", mark_faulty },
        { "7.11", "contrast of a crevice of two pixels behind a box filter of 5, as a share", 0.3, true,
          "2 of 5 columns, and what the crevice's borders darken", domain::passes, crevice, "a filter of 15", mark_faulty },
        { "7.12", "occlusion of a convex ball of 120 flat faces by its faces' normals", 0.005, false,
          "convex: none but within half a pixel of edges, 4 % of the pixels, a tenth of the half ball", domain::passes, facets,
          "normals of the round ball", mark_faulty },
        { "7.19",
          "rise of occlusion from one distance to the next in a dolly from 4 to 4096 units facing a wall, and what is left in "
          "the end",
          0.01, false, "monotone, and open in the end", domain::passes, dolly, "bias 0, wall tilted by 30 degrees", mark_faulty },
        { "7.19t", "the same, wall tilted by 30 degrees, bias of 0.04 radii", 0.01, false, "monotone, and open in the end",
          domain::passes, tilted_dolly, "bias 0", mark_faulty, true },
        { "7.19b", "the same, wall tilted by 30 degrees, bitmask high without a bias", 0.01, false,
          "monotone, and open in the end", domain::passes, bitmask_dolly, "the kernel of 7.19t", mark_faulty },
        { "7.20", "spread of mean visibility over three resolutions", 0.01, false, "half a pixel at silhouettes", domain::passes,
          resolutions, "a radius in pixels", mark_faulty },
        { "7.21", "1 - visibility of an open plane at sizes 1 to 33", 0, false, "bias covers half a pixel", domain::passes,
          all_sizes, "reads that wrap around", plant_wrap },
        { "7.23", "a narrow view from 4000 units away against a parallel projection, mean difference", 5e-3, false,
          "1e-3 of the view's angle; taps flip by rounding", domain::passes, narrow_view, "a wide view from 4 units",
          mark_faulty },
        { "7.25", "visibility in 32 conventions, mean difference; means where rows are turned round", 5e-3, false,
          "taps flip by rounding; other rotations where rows are turned round", domain::passes, conventions,
          "ranges of depth mistaken", mark_faulty },
        { "7.34", "spread of mean visibility over 8, 32 and 128 taps, relative, each method", 0.01, false, "numerics.md 7.34",
          domain::passes, presets, "a box kernel in place of the first", mark_faulty },
    };
}

} // namespace stability
