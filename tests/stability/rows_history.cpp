// 4.7: what the history of a pixel holds: F1 to F4, F7.
#include "stability/figure.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"
#include "stability/stills.hpp"

#include "ao/half.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

namespace stability {

namespace {

using reals = ao::math<float>;

void mark_faulty(subject& s)
{
    s.faulty = true;
}

// A pass's running mean, stored after every frame: what is left of 0.5 after 0.7 came in for `frames` frames of weight 1 / n.
double leftover(int format, float cap, int frames)
{
    float value = 0.5F;
    for (int i = 0; i < frames; ++i) {
        const float mixed = (value * (cap - 1) + 0.7F) / cap;
        const reals::ao_history stored{ mixed, cap, 1, 2 };
        value = reals::ao_unpacked_history(reals::ao_packed_history(stored, format), format).value;
    }
    return std::abs(0.7 - static_cast<double>(value));
}

double stall(subject& s)
{
    worst w;
    for (const float cap : { 16.0F, 64.0F, 256.0F }) {
        const auto frames = static_cast<int>(40 * cap);
        if (s.faulty) {
            w.add(leftover(reals::ao_history_half_stalls, cap, frames));
            continue;
        }
        w.add(leftover(reals::ao_history_precise, cap, frames));
        w.add(leftover(reals::ao_history_packed, cap, frames));
    }
    return w.value();
}

// Eight bits, as published: beside the row above.
double byte_stall(subject& s)
{
    double value = 0.5;
    for (int i = 0; i < 2560; ++i) {
        const double top = s.faulty ? 255 : 65535;
        value = std::round((value * 63 + 0.7) / 64 * top) / top;
    }
    return std::abs(0.7 - value);
}

// Mean bias of what is stored, of random contributions about 0.5 at n = 500 in a pass's running mean; faulty: half floats
// truncated.
double storage_bias(subject& s)
{
    worst w;
    for (const int format : { reals::ao_history_precise, reals::ao_history_packed }) {
        ao::random_stream random(31);
        double stored_mean = 0;
        double true_mean = 0;
        float value = 0.5F;
        double exact = 0.5;
        constexpr float cap = 500;
        for (int i = 0; i < 40000; ++i) {
            const float sample = random.uniform();
            exact = (exact * (static_cast<double>(cap) - 1) + static_cast<double>(sample)) / static_cast<double>(cap);
            const float mixed = (value * (cap - 1) + sample) / cap;
            if (s.faulty) {
                std::uint16_t code = ao::float_to_half(mixed);
                code = ao::half_to_float(code) > mixed ? static_cast<std::uint16_t>(code - 1) : code;
                value = ao::half_to_float(code);
            }
            else {
                value = reals::ao_unpacked_history(reals::ao_packed_history({ mixed, cap, 1, 2 }, format), format).value;
            }
            if (i >= 4000) {
                stored_mean += static_cast<double>(value) / 36000;
                true_mean += exact / 36000;
            }
        }
        w.add(std::abs(stored_mean - true_mean));
    }
    return w.value();
}

// How far weights leave 0 ... w_max, or are no whole numbers, over frames in which w_max goes 40, 500, 7.
double weight_cap(subject& s)
{
    worst w;
    for (const auto format : { ao::history_format::precise, ao::history_format::packed }) {
        std::vector<history> kept;
        for (const int most : { 40, 500, 7 }) {
            still_run run(s, { 8, 5 }, true);
            run.settings.format = format;
            run.settings.most_weight = most;
            run.settings.clamped_weight = std::min(most, 48);
            run.settings.first_samples = 16;
            run.settings.later_samples = 3;
            run.settings.filter = 1;
            if (!run.start() || (!kept.empty() && (!run.step() || !run.set_histories(kept)))) {
                return endless;
            }
            for (int i = 0; i < (s.thorough ? 2000 : 30); ++i) {
                if (!run.step()) {
                    return endless;
                }
            }
            kept = run.histories();
            for (const history& h : kept) {
                const double weight = static_cast<double>(h.weight);
                const double cap = s.faulty ? most - 1 : most;
                w.add(weight >= 1 && weight <= cap && weight == std::floor(weight) ? 0 : endless);
            }
        }
    }
    return w.value();
}

// Error of eight samples a frame, cap 64, against all samples of the period: a running mean's floor.
double error_floor(subject& s)
{
    worst w;
    for (const auto format : { ao::history_format::precise, ao::history_format::packed }) {
        still_run run(s, { 20, 15 }, true);
        run.settings.format = format;
        run.settings.period = 2048;
        run.settings.first_samples = run.settings.later_samples = 8;
        run.settings.most_weight = s.faulty ? 8 : 64;
        run.settings.clamped_weight = 8;
        run.settings.filter = 1;
        if (!run.start()) {
            return endless;
        }
        for (int i = 0; i < 40; ++i) {
            if (!run.step()) {
                return endless;
            }
        }
        static const auto truth = temporal_test::integral_of(run.frame, run.settings, run.facts); // the same in every run
        const auto seen = run.visibility();
        double sum = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const double e = static_cast<double>(seen[i]) - static_cast<double>(truth.texels[i].x);
            sum += e * e / static_cast<double>(seen.size());
        }
        w.add(std::sqrt(sum));
    }
    return w.value();
}

// Words of the history that differ between a run that reprojects what stands still and one that does not reproject, over sizes;
// faulty: motion off by half a pixel.
double identity(subject& s)
{
    double wrong = 0;
    for (const glm::ivec2& size : { glm::ivec2(33, 17), glm::ivec2(1, 9), glm::ivec2(20, 13) }) {
        for (const auto format : { ao::history_format::precise, ao::history_format::packed }) {
            if (!s.thorough && (size.x == 20 || (size.x == 1) != (format == ao::history_format::packed))) {
                continue;
            }
            std::vector<std::uint32_t> words[2];
            for (const bool motion : { false, true }) {
                still_run run(s, size, motion);
                run.settings.format = format;
                run.settings.first_samples = 8;
                for (std::size_t i = 0; s.faulty && i < run.frame.inputs.motion.pixels(); ++i) {
                    auto m = run.frame.inputs.motion.texel<glm::vec4>(i);
                    m.x += 0.5F;
                    run.frame.inputs.motion.set_texel(i, m);
                }
                if (!run.start()) {
                    return endless;
                }
                for (int i = 0; i < 6; ++i) {
                    if (!run.step()) {
                        return endless;
                    }
                }
                words[motion ? 1 : 0] = *run.runner().history();
            }
            for (std::size_t i = 0; i < words[0].size(); ++i) {
                wrong += words[0][i] == words[1][i] ? 0 : 1;
            }
        }
    }
    return wrong;
}

// Indices and weights that are no whole numbers, in a pan by parts of pixels.
double whole_numbers(subject& s)
{
    temporal_run run(s);
    temporal_test::stage stage{ .width = 40, .height = 24 };
    temporal_test::stage before = stage;
    run.facts = temporal_test::facts_of(stage, true);
    run.settings.first_samples = 16;
    run.settings.later_samples = 8;
    if (!run.start()) {
        return endless;
    }
    double wrong = 0;
    for (int i = 0; i < 10; ++i) {
        stage.eye[0] = 0.03 * i;
        if (!run.step(temporal_test::make_frame(stage, before))) {
            return endless;
        }
        auto all = run.histories();
        if (s.faulty) { // as a bilinear fetch leaves them
            for (std::size_t k = 1; k < all.size(); ++k) {
                all[k].index = 0.3F * all[k].index + 0.7F * all[k - 1].index;
            }
        }
        for (const history& h : all) {
            wrong += h.index == std::floor(h.index) && h.weight == std::floor(h.weight) && h.index < 4096 ? 0 : 1;
        }
        before = stage;
    }
    return wrong;
}

// Pixels whose first frame after a teleport, a new size, another field of view or a cut still holds older samples; a paused frame
// that loses its history; a matrix of NaN that is not refused.
double resets(subject& s)
{
    double wrong = 0;
    still_run run(s, { 24, 16 }, false);
    run.settings.first_samples = 8;
    run.settings.later_samples = 8;
    const auto fresh = [&] {
        double old = 0;
        for (const history& h : run.histories()) {
            old += h.weight <= 8 ? 0 : 1;
        }
        return old;
    };
    if (!run.start() || !run.step()) {
        return endless;
    }
    wrong += fresh(); // the first frame
    if (!run.step() || !run.step(!s.faulty)) {
        return endless;
    }
    wrong += fresh(); // a cut
    if (!run.step() || !run.step()) {
        return endless;
    }
    for (const history& h : run.histories()) { // paused: it goes on
        wrong += h.weight == 24 ? 0 : 1;
    }
    temporal_test::scene_frame singular = run.frame;
    singular.camera.world_to_view[1][1] = std::nanf("");
    const auto before = run.histories();
    wrong += run.temporal_run::step(singular) ? 1 : 0;
    const auto after = run.histories();
    for (std::size_t i = 0; i < after.size(); ++i) {
        wrong += std::memcmp(&before[i], &after[i], sizeof(history)) == 0 ? 0 : 1;
    }
    // Teleport, turned round: nothing of it was in the picture.
    temporal_test::stage there{ .width = 24, .height = 16 };
    there.eye = { 0, 0, 40 };
    there.yaw = 3.14159;
    wrong += run.temporal_run::step(temporal_test::make_frame(there, there)) ? fresh() : endless;
    // Another size and field of view: prepared anew.
    still_run other(s, { 17, 9 }, false);
    other.settings = run.settings;
    wrong += other.start() && other.step() ? 0 : endless;
    for (const history& h : other.histories()) {
        wrong += h.weight <= 8 ? 0 : 1;
    }
    return wrong;
}

} // namespace

std::vector<row> history_rows()
{
    return {
        { "F1", "left of a step from 0.5 to 0.7 after 40 n frames of weight 1 / n, n = 16, 64, 256; precise and packed", 2.5e-3,
          false, "half a step of 16 bits times n: 256 / 131070", domain::core, stall, "half floats", mark_faulty },
        { "F1b", "the same at n = 64 by 16 bits", 6e-4, false, "64 / 131070", domain::core, byte_stall, "8-bit history",
          mark_faulty },
        { "F2", "mean bias of stored values at n = 500, random contributions; precise and packed", 1e-3, false, "numerics.md F2",
          domain::core, storage_bias, "half floats truncated, as drivers store them", mark_faulty },
        { "F3", "weights that are no whole number from 1 to w_max, w_max 40, 500, 7", 0, false, "exact", domain::temporal,
          weight_cap, "held against w_max - 1", mark_faulty },
        { "F3l", "error of 8 samples a frame at w_max 64 against the whole period, 20x15", 0.02, false,
          "numerics.md F3: 0.0139 on a harder integrand, plus sampling", domain::temporal, error_floor, "w_max 8: no history",
          mark_faulty },
        { "F4", "words of histories that reprojection changes where nothing moves, odd sizes, both formats", 0, false, "exact",
          domain::temporal, identity, "motion off by half a pixel", mark_faulty },
        { "F4w", "indices and weights that are no whole numbers in a pan", 0, false, "fetched at the nearest centre",
          domain::temporal, whole_numbers, "as a bilinear fetch gives them", mark_faulty },
        { "F7", "pixels that keep or lose a history wrongly: first frame, cut, pause, NaN camera, teleport, new size", 0, false,
          "as documented in docs/integrating.md", domain::temporal, resets, "a cut not announced", mark_faulty },
    };
}

} // namespace stability
