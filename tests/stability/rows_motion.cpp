// 4.7: motion: F5, F6, F8, F9, and flicker and convergence of 1.5.
#include "stability/figure.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"
#include "stability/stills.hpp"

#include "unit/temporal_measures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

namespace stability {

namespace {

using temporal_test::rms;
using temporal_test::sight;
using temporal_test::stage;

void mark_faulty(subject& s)
{
    s.faulty = true;
}
void no_rejection(subject& s)
{
    s.change_temporal = [](ao::temporal_settings& t) {
        t.invalidation = ao::invalidation_type::none;
        t.tolerance = 1;
    };
}
void no_invalidation(subject& s)
{
    s.change_temporal = [](ao::temporal_settings& t) { t.invalidation = ao::invalidation_type::none; };
}

const temporal_test::path& named(std::string_view name)
{
    return *std::find_if(std::begin(temporal_test::paths), std::end(temporal_test::paths),
                         [&](const temporal_test::path& p) { return p.name == name; });
}

struct walk {
    double dropped = 0;  // share of what the last frame showed that began anew
    double accepted = 0; // share of what it did not show whose history outweighs its new samples
    rms steady;
    rms trail; // where a shadow left 8 frames ago
};

// A path of the unit tests by the subject.
std::optional<walk> follow(subject& s, const char* name, int frames, bool truths)
{
    const auto& path = named(name);
    temporal_run run(s);
    run.settings.period = s.thorough ? 1024 : 256;
    run.facts = temporal_test::facts_of(temporal_test::small_stage(), true);
    if (!run.start()) {
        return std::nullopt;
    }
    walk w;
    double shown = 0;
    double uncovered = 0;
    static std::vector<temporal_test::picture> truth; // of one path, for all subjects
    stage before = path.at(0);
    for (int i = 0; i < frames; ++i) {
        const stage now = path.at(i);
        auto frame = temporal_test::make_frame(now, i == 0 ? now : before);
        const auto sights = temporal_test::sights_of(frame, now, i == 0 ? now : before);
        for (std::size_t k = 0; s.faulty && k < frame.inputs.motion.pixels(); ++k) {
            auto m = frame.inputs.motion.texel<glm::vec4>(k);
            m.z *= 1.05F;
            frame.inputs.motion.set_texel(k, m);
        }
        if (!run.step(frame)) {
            return std::nullopt;
        }
        const auto all = run.histories();
        for (std::size_t k = 0; k < all.size() && i > 0; ++k) {
            const auto fresh = static_cast<float>(run.settings.first_samples);
            if (sights[k] == sight::seen_before) {
                shown += 1;
                w.dropped += all[k].weight == fresh ? 1 : 0;
            }
            else if (sights[k] == sight::uncovered) {
                uncovered += 1;
                w.accepted += all[k].weight > 2 * fresh ? 1 : 0;
            }
        }
        if (truths) {
            const auto at = static_cast<std::size_t>(i);
            if (truth.size() <= at) {
                truth.push_back(temporal_test::integral_of(frame, run.settings, run.facts));
            }
            const auto seen = run.visibility();
            for (std::size_t k = 0; k < seen.size(); ++k) {
                const float expected = truth[at].texels[k].x;
                if (i >= 10) {
                    w.steady.add(seen[k], expected);
                }
                if (i >= 16 && std::abs(expected - truth[at - 8].texels[k].x) <= 0.02F &&
                    expected - truth[at - 16].texels[k].x >= 0.05F) {
                    w.trail.add(seen[k], expected);
                }
            }
        }
        before = now;
    }
    w.dropped /= std::max(shown, 1.0);
    w.accepted /= std::max(uncovered, 1.0);
    return w;
}

double false_rejects(subject& s)
{
    worst w;
    for (const char* name : { "static", "slow pan" }) {
        const auto walked = follow(s, name, s.thorough ? 32 : 10, false);
        w.add(walked ? walked->dropped : endless);
    }
    return w.value();
}

double false_accepts(subject& s)
{
    const auto walked = follow(s, "rolling ball and pan", s.thorough ? 32 : 12, false);
    return walked ? walked->accepted : endless;
}

double trail(subject& s)
{
    const auto walked = follow(s, "rolling ball", s.thorough ? 32 : 26, true);
    return walked && walked->trail.count() > 0 ? walked->trail.value() : endless;
}

// Frames until a removed ball's shadow is fainter than 0.02 where it was: depth there agrees, visibility does not.
double ghost_length(subject& s)
{
    temporal_run run(s);
    run.settings.period = 1024;
    stage with = temporal_test::small_stage();
    stage without = with;
    without.ball = 100;
    run.facts = temporal_test::facts_of(with, true);
    if (!run.start()) {
        return endless;
    }
    const auto first = temporal_test::make_frame(with, with);
    for (int i = 0; i < 40; ++i) {
        if (!run.step(first)) {
            return endless;
        }
    }
    const auto shaded = run.visibility();
    const auto next = temporal_test::make_frame(without, without);
    const auto truth = temporal_test::integral_of(next, run.settings, run.facts);
    for (int frame = 1; frame <= 80; ++frame) {
        if (!run.step(next)) {
            return endless;
        }
        const auto seen = run.visibility();
        double imprint = 0;
        int count = 0;
        for (std::size_t k = 0; k < seen.size(); ++k) {
            const float depth = first.inputs.depth.texel<float>(k);
            const bool floor = depth == next.inputs.depth.texel<float>(k);
            if (floor && truth.texels[k].x - shaded[k] > 0.1F) {
                imprint += static_cast<double>(truth.texels[k].x) - static_cast<double>(seen[k]);
                ++count;
            }
        }
        if (count == 0) {
            return endless;
        }
        if (imprint / count < 0.02) {
            return frame;
        }
    }
    return 80;
}

// Standard deviation in pixels of what a hundred pans of half a pixel, to and fro, blurred a sharp edge of a converged history
// by.
double pan_blur(subject& s)
{
    temporal_run run(s);
    stage now = temporal_test::small_stage();
    now.ball = 100;
    run.facts = temporal_test::facts_of(now, false);
    run.settings.period = 1024;
    run.settings.filter = 1;
    run.settings.first_samples = run.settings.later_samples = 1;
    run.settings.moving_weight = run.settings.most_weight;
    const auto first = temporal_test::make_frame(now, now);
    if (!run.start() || !run.step(first)) {
        return endless;
    }
    auto all = run.histories();
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].value = i % 48 < 24 ? 0.0F : 1.0F;
        all[i].weight = 500;
    }
    if (!run.set_histories(all)) {
        return endless;
    }
    const double kept = 1 - 8.0 / 158;
    std::vector<double> profile(48);
    for (int age = 0; age <= 100; age += 2) {
        for (const double eye : { 0.5 * 3.0 * 6 / 48, 0.0 }) {
            now.eye[0] = eye;
            if (age > 0 && !run.step(temporal_test::make_frame(now, now))) {
                return endless;
            }
        }
        all = run.histories();
        const double share = (1 - kept) * (std::pow(kept, age) + (age > 0 ? std::pow(kept, age - 1) : 0));
        for (std::size_t x = 0; x < 48; ++x) {
            profile[x] +=
                share * static_cast<double>(all[4 * 48 + x].value) / std::max(static_cast<double>(all[4 * 48 + 36].value), 1e-9);
        }
    }
    const auto crossing = [&](double level) {
        std::size_t x = 12;
        while (x < 36 && profile[x + 1] < level * profile[36]) {
            ++x;
        }
        return static_cast<double>(x) + (level * profile[36] - profile[x]) / (profile[x + 1] - profile[x]);
    };
    return (crossing(0.9) - crossing(0.1)) / 2.563;
}

void bilinear(subject& s)
{
    s.change_temporal = [](ao::temporal_settings& t) { t.cubic = false; };
}

// RMSE after 16 frames over that after one, camera paused: an unlucky pattern must not freeze.
double paused_error(subject& s)
{
    still_run run(s, { 32, 24 }, false);
    run.settings.first_samples = run.settings.later_samples = 8;
    run.settings.filter = 1;
    if (s.faulty) { // every frame the same eight samples
        run.settings.period = 8;
    }
    ao::temporal_settings all = run.settings;
    all.period = 4096;
    const auto truth = temporal_test::integral_of(run.frame, all, run.facts);
    if (!run.start()) {
        return endless;
    }
    double first = 0;
    double last = 0;
    for (int i = 0; i < 16; ++i) {
        if (!run.step()) {
            return endless;
        }
        rms error;
        const auto seen = run.visibility();
        for (std::size_t k = 0; k < seen.size(); ++k) {
            error.add(seen[k], truth.texels[k].x);
        }
        (i == 0 ? first : last) = error.value();
    }
    return last / first;
}

// 99 % point of the change from frame to frame of a still view whose objects may move at any time, once converged.
double flicker(subject& s)
{
    still_run run(s, { 32, 24 }, true);
    run.settings.period = 1024;
    run.settings.most_weight = s.faulty ? 8 : 500;
    run.settings.clamped_weight = 8;
    if (!run.start()) {
        return endless;
    }
    std::vector<float> last;
    std::vector<float> changes;
    for (int i = 0; i < 80; ++i) {
        if (!run.step()) {
            return endless;
        }
        if (i >= 70) {
            const auto seen = run.visibility();
            for (std::size_t k = 0; k < last.size(); ++k) {
                changes.push_back(std::abs(seen[k] - last[k]));
            }
            last = seen;
        }
    }
    std::sort(changes.begin(), changes.end());
    return static_cast<double>(changes[changes.size() * 99 / 100]);
}

// Mean change of a still, converged scene's visibility while the projection is jittered by parts of a pixel.
double jitter(subject& s)
{
    temporal_run run(s);
    stage now{ .width = 32, .height = 24 };
    run.facts = temporal_test::facts_of(now, false);
    run.settings.period = 1024;
    if (s.faulty) {
        run.settings.most_weight = 8;
        run.settings.clamped_weight = 8;
    }
    if (!run.start()) {
        return endless;
    }
    std::vector<float> last;
    double sum = 0;
    double count = 0;
    const auto plain = temporal_test::make_frame(now, now);
    for (int i = 0; i < 72; ++i) {
        const double x = 0.5 * ((i * 5 % 8) / 8.0 - 0.5) * 1.2 / 32;
        const double y = 0.5 * ((i * 3 % 8) / 8.0 - 0.5) * 0.8 / 24;
        auto frame = plain;
        const auto projection =
            ao::make_projection({ -0.6 + x, 0.6 + x, -0.4 + y, 0.4 + y, 0.4, 200 }, { .rows = ao::first_row::at_ndc_plus_one });
        frame.camera.projection = projection;
        const auto p = ao::fold_projection(projection, 32, 24)->projection;
        for (std::size_t k = 0; k < frame.inputs.depth.pixels(); ++k) {
            const std::array<double, 3> ray{
                (static_cast<double>(k % 32) + 0.5) * static_cast<double>(p.slope_x) + static_cast<double>(p.offset_x),
                (static_cast<double>(k / 32) + 0.5) * static_cast<double>(p.slope_y) + static_cast<double>(p.offset_y), -1
            };
            const auto hit = temporal_test::detail::cast({ 0, 0, 0 }, ray, 0);
            frame.inputs.depth.set_texel(k, static_cast<float>(hit.t));
            frame.inputs.normal.set_texel(k, glm::vec4(static_cast<float>(hit.normal[0]), static_cast<float>(hit.normal[1]),
                                                       static_cast<float>(hit.normal[2]), 0.0F));
        }
        if (!run.step(frame)) {
            return endless;
        }
        if (i >= 64) {
            const auto seen = run.visibility();
            for (std::size_t k = 0; k < last.size(); ++k) {
                sum += std::abs(static_cast<double>(seen[k]) - static_cast<double>(last[k]));
                count += 1;
            }
            last = seen;
        }
    }
    return sum / count;
}

} // namespace

std::vector<row> motion_rows()
{
    return {
        { "F5", "share of histories dropped though the last frame showed the pixel: static, slow pan", 1e-3, false,
          "numerics.md F5", domain::temporal, false_rejects, "depths of the last frame 5 % off", mark_faulty },
        { "F5a", "share of uncovered pixels whose history outweighs their new samples: rolling ball and pan", 0.01, false,
          "numerics.md F5", domain::temporal, false_accepts, "no depth test, no invalidation", no_rejection },
        { "F6", "error where a rolling ball's shadow left 8 frames ago", 0.05, false, "docs/numerics.md, Temporal",
          domain::temporal, trail, "no invalidation", no_invalidation },
        { "F6g", "frames until a removed ball's shadow is fainter than 0.02 on the floor, whose depth agrees", 60, false,
          "weight 500 at 8 samples: 0.3 falls below 0.02 in 63 log(15) frames without any test", domain::temporal, ghost_length,
          "no invalidation: 80 or more", no_invalidation },
        { "F8", "blur of an edge by a hundred pans of half a pixel, standard deviation in pixels", 1.5, false,
          "docs/numerics.md, Temporal; (1 - a) / a v (1 - v) of numerics.md 1.5 for bilinear weights", domain::temporal, pan_blur,
          "histories by bilinear weights", bilinear },
        { "F9", "error after 16 frames of 8 samples over that after one, camera paused", 0.3, false, "numerics.md 1.5",
          domain::temporal, paused_error, "the same 8 samples in every frame", mark_faulty },
        { "F10", "99 % point of the change from frame to frame, converged", 0.01, false, "8 samples of weight 1/500",
          domain::temporal, flicker, "w_max 8: no history", mark_faulty },
        { "F11", "mean change from frame to frame of a still scene under a jittered projection", 0.012, false,
          "edge coverage: 0.25 pixel at 5 % of the pixels, and 8 new samples of 150", domain::temporal, jitter,
          "w_max 8: no history", mark_faulty },
    };
}

} // namespace stability
