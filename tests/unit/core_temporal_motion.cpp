// Temporal ambient occlusion in motion, against the integral of every frame.
#include "temporal_measures.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <vector>

using namespace temporal_test;

namespace {

constexpr int frames = 32;
constexpr int fresh_samples = 32;

ao::temporal_settings usual()
{
    ao::temporal_settings s;
    s.period = 1024;
    return s;
}

// As many new samples, and nothing that was known.
picture alone(const scene_frame& frame, ao::temporal_settings s, const ao::temporal_facts& f, int samples)
{
    s.first_samples = s.later_samples = samples;
    executor e = make_executor(s, f);
    return e.run(frame.inputs, frame.camera);
}

struct motion_errors {
    int frames_worse = 0; // than as many new samples alone
    rms steady;           // from frame 10 on
    rms fresh;            // likewise of 32 new samples alone
    rms uncovered;        // what the last frame did not show
    rms fresh_uncovered;  // likewise of 32 new samples alone
    rms trail;            // where a shadow was that has gone 8 frames ago or more
    int dropped = 0;      // histories of what the last frame did show
    int kept = 0;
};

motion_errors errors_of(const path& p, const ao::temporal_settings& s)
{
    const ao::temporal_facts f = facts_of(small_stage(), true);
    executor e = make_executor(s, f);
    motion_errors errors;
    std::vector<picture> truths;
    stage before = p.at(0);
    for (std::size_t i = 0; i < frames; ++i) {
        const stage now = p.at(static_cast<int>(i));
        const bool anew = i == 0 || (p.name == std::string_view("cut") && i == 16);
        const scene_frame frame = make_frame(now, anew ? now : before);
        const picture seen = e.run(frame.inputs, frame.camera, anew);
        const picture& truth = truths.emplace_back(integral_of(frame, s, f));
        const picture fresh = alone(frame, s, f, fresh_samples);
        const double best = rmse(anew ? fresh : alone(frame, s, f, s.later_samples), truth);
        errors.frames_worse += rmse(seen, truth) > best ? 1 : 0;
        const auto sights = sights_of(frame, now, anew ? now : before);
        for (std::size_t k = 0; k < sights.size(); ++k) {
            const float expected = truth.texels[k].x;
            if (i >= 10 && !anew) {
                errors.steady.add(seen.texels[k].x, expected);
                errors.fresh.add(fresh.texels[k].x, expected);
            }
            if (i >= 16 && now.eye == before.eye) {
                const float then = truths[i - 8].texels[k].x;
                const float once = truths[i - 16].texels[k].x;
                if (std::abs(expected - then) <= 0.02F && expected - once >= 0.05F) {
                    errors.trail.add(seen.texels[k].x, expected);
                }
            }
            const int x = static_cast<int>(k) % now.width;
            const int y = static_cast<int>(k) / now.width;
            if (sights[k] == sight::uncovered) {
                errors.uncovered.add(seen.texels[k].x, expected);
                errors.fresh_uncovered.add(fresh.texels[k].x, expected);
            }
            else if (sights[k] == sight::seen_before && !anew) {
                // All its samples are new ones.
                const bool dropped = e.history_of(x, y).weight == static_cast<float>(s.first_samples);
                ++(dropped ? errors.dropped : errors.kept);
            }
        }
        before = now;
    }
    return errors;
}

const path& named(std::string_view name)
{
    return *std::find_if(std::begin(paths), std::end(paths), [&](const path& p) { return p.name == name; });
}

// Standard deviation, in pixels, of what has blurred a sharp edge after a hundred pans of half a pixel, to and fro: `kept` of
// what is known after a frame comes from the history, and each frame adds the edge as it is.
double edge_blur(bool cubic, double kept)
{
    ao::temporal_settings s = usual();
    s.cubic = cubic;
    s.filter = 1;
    s.first_samples = s.later_samples = 1;
    s.moving_weight = s.most_weight;
    stage now = small_stage();
    now.ball = 100; // floor and wall alone
    executor e = make_executor(s, facts_of(now, false));
    const scene_frame first = make_frame(now, now);
    e.run(first.inputs, first.camera);
    constexpr int edge = 24;
    constexpr int row = 4; // of the wall, which is open: new samples are 0
    for (int y = 0; y < now.height; ++y) {
        for (int x = 0; x < now.width; ++x) {
            const auto at = 4 * static_cast<std::size_t>(y * now.width + x);
            e.history()[at] = std::bit_cast<std::uint32_t>(x < edge ? 0.0F : 1.0F);
            e.history()[at + 1] = std::bit_cast<std::uint32_t>(static_cast<float>(s.most_weight));
        }
    }
    // The passes are linear in what the history holds: the sum over ages of what an edge of that age has become. The camera is
    // back in every other frame; what came in between counts as if it were a frame older.
    std::vector<double> profile(static_cast<std::size_t>(now.width));
    for (int age = 0; age <= 100; age += 2) {
        if (age > 0) {
            for (const double eye : { 0.5 * 3.0 * 6 / now.width, 0.0 }) { // half a pixel at the wall's distance
                now.eye[0] = eye;
                const scene_frame frame = make_frame(now, now);
                e.run(frame.inputs, frame.camera);
            }
        }
        const auto top = static_cast<double>(e.history_of(36, row).value);
        REQUIRE(top > 0.5);
        const double share = (1 - kept) * (std::pow(kept, age) + (age > 0 ? std::pow(kept, age - 1) : 0));
        for (int x = 0; x < now.width; ++x) {
            profile[static_cast<std::size_t>(x)] += share * static_cast<double>(e.history_of(x, row).value) / top;
        }
    }
    const auto crossing = [&](double level) {
        std::size_t x = 12;
        while (profile[x + 1] < level * profile[36]) {
            ++x;
        }
        return static_cast<double>(x) + (level * profile[36] - profile[x]) / (profile[x + 1] - profile[x]);
    };
    // A normal distribution rises from a tenth to nine tenths within 2.563 standard deviations.
    return (crossing(0.9) - crossing(0.1)) / 2.563;
}

} // namespace

TEST_CASE("in every frame of every motion the history helps, and eight samples a frame match thirty-two alone")
{
    for (const path& p : paths) {
        const motion_errors errors = errors_of(p, usual());
        INFO(p.name << ": rmse " << errors.steady.value() << ", 32 samples alone " << errors.fresh.value() << "; "
                    << errors.uncovered.count() << " uncovered pixels: " << errors.uncovered.value() << ", 32 samples alone "
                    << errors.fresh_uncovered.value() << "; " << errors.trail.count() << " left by a shadow: "
                    << errors.trail.value() << "; histories dropped " << errors.dropped << ", kept " << errors.kept);
        CHECK(errors.frames_worse == 0);
        CHECK(errors.steady.value() <= errors.fresh.value());
        CHECK(errors.uncovered.value() <= 1.1 * errors.fresh_uncovered.value());
        CHECK(errors.trail.value() <= 0.05);
        if (p.name == std::string_view("static") || p.name == std::string_view("slow pan")) {
            CHECK(errors.dropped * 1000 < errors.kept);
        }
    }
}

TEST_CASE("eight samples in every frame, new pixels too, match thirty-two alone in steady motion of the camera")
{
    ao::temporal_settings s = usual();
    s.first_samples = 8;
    for (const char* name : { "static", "slow pan", "orbit" }) {
        const motion_errors errors = errors_of(named(name), s);
        INFO(name << ": rmse " << errors.steady.value() << ", 32 samples alone " << errors.fresh.value());
        CHECK(errors.steady.value() <= errors.fresh.value());
    }
}

TEST_CASE("every pixel's sequence goes on with the sample after the last one")
{
    ao::temporal_settings s = usual();
    s.filter = 1;
    const ao::temporal_facts f = facts_of(small_stage(), true);
    const path& p = named("rolling ball and pan");
    executor e = make_executor(s, f);
    executor last = e;
    stage before = p.at(0);
    std::size_t wrong = 0;
    for (int i = 0; i < frames; ++i) {
        const stage now = p.at(i);
        const scene_frame frame = make_frame(now, before);
        e.run(frame.inputs, frame.camera);
        for (int y = 0; y < now.height && i > 0; ++y) {
            for (int x = 0; x < now.width; ++x) {
                const auto motion = frame.inputs.motion.texel<glm::vec4>(static_cast<std::size_t>(y * now.width + x));
                const float column = static_cast<float>(x) + 0.5F + motion.x;
                const float row = static_cast<float>(y) + 0.5F + motion.y;
                const auto h = e.history_of(x, y);
                float from = 0; // where nothing is known, the sequence begins
                if (column >= 0 && column < static_cast<float>(now.width) && row >= 0 && row < static_cast<float>(now.height)) {
                    from = last.history_of(static_cast<int>(column), static_cast<int>(row)).index;
                }
                const float taken = std::fmod(h.index - from + 1024.0F, 1024.0F);
                wrong += taken == static_cast<float>(s.later_samples) || taken == static_cast<float>(s.first_samples) ? 0 : 1;
            }
        }
        last = e;
        before = now;
    }
    CHECK(wrong == 0);
}

TEST_CASE("without invalidation a shadow trails and what is uncovered shows a ghost")
{
    ao::temporal_settings s = usual();
    s.invalidation = ao::invalidation_type::none;
    const motion_errors trailing = errors_of(named("rolling ball"), s);
    INFO("left by a shadow: " << trailing.trail.value() << ", frames worse " << trailing.frames_worse);
    CHECK(trailing.trail.value() > 0.05);
    CHECK(trailing.frames_worse > 0);
    s = usual();
    s.invalidation = ao::invalidation_type::none;
    s.tolerance = 1; // keeps everything
    const motion_errors ghosts = errors_of(named("rolling ball and pan"), s);
    INFO("uncovered: " << ghosts.uncovered.value() << ", 32 samples alone " << ghosts.fresh_uncovered.value());
    CHECK(ghosts.uncovered.value() > 1.1 * ghosts.fresh_uncovered.value());
}

TEST_CASE("what has converged does not flicker while new samples still come")
{
    const scene_frame frame = make_frame(small_stage(), small_stage());
    executor e = make_executor(usual(), facts_of(small_stage(), true)); // objects may move at any time
    for (int i = 0; i < 64; ++i) {
        e.run(frame.inputs, frame.camera);
    }
    picture last = e.run(frame.inputs, frame.camera);
    std::vector<float> changes;
    for (int i = 0; i < 16; ++i) {
        const picture next = e.run(frame.inputs, frame.camera);
        for (std::size_t k = 0; k < next.texels.size(); ++k) {
            changes.push_back(std::abs(next.texels[k].x - last.texels[k].x));
        }
        last = next;
    }
    std::sort(changes.begin(), changes.end());
    const float percentile_99 = changes[changes.size() * 99 / 100];
    INFO("p99 " << percentile_99);
    CHECK(percentile_99 > 0);
    CHECK(percentile_99 <= 0.01F);
}

TEST_CASE("a hundred pans of half a pixel blur an edge by less than one and a half pixels; by bilinear weights it would be more")
{
    const ao::temporal_settings s = usual();
    const double kept = 1 - static_cast<double>(s.later_samples) / static_cast<double>(s.moving_weight + s.later_samples);
    const double cubic = edge_blur(true, kept);
    const double linear = edge_blur(false, kept);
    INFO("pixels: " << cubic << ", bilinear " << linear);
    CHECK(cubic <= 1.5);
    CHECK(linear > 1.5);
}
