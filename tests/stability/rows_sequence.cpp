// 4.2: Halton sequences and what carries their index.
#include "stability/figure.hpp"
#include "stability/row.hpp"
#include "stability/stills.hpp"

#include "ao/conformance/functions.hpp"
#include "ao/temporal_taps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace stability {

namespace {

using ids = ao::conformance::evaluator<float>;
constexpr std::array bases{ 2U, 3U, 5U, 7U, 11U, 13U };

// Radical inverses by the subject, in the order of the indices.
std::vector<double> inverses(subject& s, std::size_t dimension, const std::vector<std::uint32_t>& indices)
{
    std::vector<glm::vec4> halves;
    for (const std::uint32_t i : indices) {
        halves.emplace_back(static_cast<float>(i >> 16U), static_cast<float>(i & 65535U), 0.0F, 0.0F);
    }
    std::vector<double> values;
    for (const glm::vec4& v : s.evaluate(ids::ao_of_radical_inverse_2 + static_cast<int>(dimension), halves, halves)) {
        values.push_back(static_cast<double>(v.x));
    }
    return values;
}

double exact_inverse(std::uint32_t base, std::uint32_t index)
{
    std::uint64_t reversed = 0;
    std::uint64_t scale = 1;
    for (; index != 0; index /= base) {
        reversed = reversed * base + index % base;
        scale *= base;
    }
    return static_cast<double>(reversed) / static_cast<double>(scale);
}

// Digit times a running power, summed in float: as published.
void summed_digits(subject& s)
{
    s.evaluate_instead = [](int function, auto a, auto, auto out) {
        const std::uint32_t base = bases[static_cast<std::size_t>(function - ids::ao_of_radical_inverse_2)];
        for (std::size_t i = 0; i < out.size(); ++i) {
            auto index = static_cast<std::uint32_t>(a[i].x) * 65536U + static_cast<std::uint32_t>(a[i].y);
            const float step = 1.0F / static_cast<float>(base);
            float power = step;
            float sum = 0;
            for (; index != 0; index /= base) {
                sum += static_cast<float>(index % base) * power;
                power *= step;
            }
            out[i] = glm::vec4(sum, 0.0F, 0.0F, 0.0F);
        }
    };
}

// The index as a float, its digits by floor and division.
void float_digits(subject& s)
{
    s.evaluate_instead = [](int function, auto a, auto, auto out) {
        const auto base = static_cast<float>(bases[static_cast<std::size_t>(function - ids::ao_of_radical_inverse_2)]);
        const float inverse_base = 1.0F / base;
        for (std::size_t i = 0; i < out.size(); ++i) {
            float index = a[i].x * 65536.0F + a[i].y;
            double scale = 1;
            double sum = 0;
            while (index >= 1.0F) {
                const float whole = std::floor(index * inverse_base);
                scale /= static_cast<double>(base);
                sum += static_cast<double>(index - whole * base) * scale;
                index = whole;
            }
            out[i] = glm::vec4(static_cast<float>(sum), 0.0F, 0.0F, 0.0F);
        }
    };
}

double greatest_inverse(subject& s)
{
    double greatest = 0;
    ao::random_stream random(1);
    for (std::size_t d = 0; d < bases.size(); ++d) {
        std::vector<std::uint32_t> indices{ 0xffffffffU };
        for (std::uint64_t power = bases[d]; power < 0x100000000ULL; power *= bases[d]) {
            indices.push_back(static_cast<std::uint32_t>(power - 1));
        }
        for (int i = 0; i < (s.thorough ? 200000 : 10000); ++i) {
            indices.push_back(random.next());
        }
        for (const double u : inverses(s, d, indices)) {
            greatest = u >= 0 && u <= greatest ? greatest : u >= 0 ? u : endless;
        }
    }
    return 1 - greatest;
}

double inverse_error(subject& s)
{
    worst w;
    for (std::size_t d = 0; d < bases.size(); ++d) {
        std::vector<std::uint32_t> indices;
        for (std::uint32_t i = 0; i < (1U << 22U); i += s.thorough ? 7 : 211) {
            indices.push_back(i);
        }
        const auto values = inverses(s, d, indices);
        for (std::size_t i = 0; i < values.size(); ++i) {
            w.add(std::abs(values[i] - exact_inverse(bases[d], indices[i])));
        }
    }
    return w.value();
}

double multiples_error(subject& s)
{
    worst w;
    ao::random_stream random(4);
    for (std::size_t d = 0; d < bases.size(); ++d) {
        std::vector<std::uint32_t> indices;
        for (int i = 0; i < (s.thorough ? 50000 : 4000); ++i) {
            const std::uint32_t multiple = (random.next() >> random.next() % 28U) / bases[d] * bases[d];
            indices.insert(indices.end(), { multiple, multiple + 1, multiple == 0 ? 0 : multiple - 1 });
        }
        const auto values = inverses(s, d, indices);
        for (std::size_t i = 0; i < values.size(); ++i) {
            w.add(std::abs(values[i] - exact_inverse(bases[d], indices[i])));
        }
    }
    return w.value();
}

double correlation(std::uint32_t a, std::uint32_t b, std::uint32_t count)
{
    double ab = 0;
    double aa = 0;
    double bb = 0;
    double mean_a = 0;
    double mean_b = 0;
    for (std::uint32_t i = 1; i <= count; ++i) {
        mean_a += exact_inverse(a, i) / count;
        mean_b += exact_inverse(b, i) / count;
    }
    for (std::uint32_t i = 1; i <= count; ++i) {
        const double x = exact_inverse(a, i) - mean_a;
        const double y = exact_inverse(b, i) - mean_b;
        ab += x * y;
        aa += x * x;
        bb += y * y;
    }
    return std::abs(ab / std::sqrt(aa * bb));
}

// Bases 2, 3 and 5, which the methods use.
double pair_correlation(subject& s)
{
    if (s.faulty) {
        return std::max(correlation(17, 19, 16), correlation(23, 29, 16));
    }
    worst w;
    for (const std::uint32_t count : { 16U, 32U, 64U, 128U, 1024U }) {
        w.add(correlation(2, 3, count));
        w.add(correlation(2, 5, count));
        w.add(correlation(3, 5, count));
    }
    return w.value();
}

// How far any pixel's index is from where so many frames of one sample must have brought it, modulo the period.
double index_error(subject& s)
{
    still_run run(s, { 3, 2 }, true);
    run.settings.period = 3000;
    run.settings.first_samples = run.settings.later_samples = 1;
    run.settings.filter = 1;
    if (!run.start() || !run.step()) {
        return endless;
    }
    worst w;
    const int frames = s.thorough ? 1500 : 60;
    for (const int from : { 2040, 2970 }) {
        auto all = run.histories();
        for (history& h : all) {
            h.index = static_cast<float>(from);
        }
        if (!run.set_histories(all)) {
            return endless;
        }
        for (int i = 0; i < frames; ++i) {
            if (!run.step()) {
                return endless;
            }
        }
        for (const history& h : run.histories()) {
            w.add(std::abs(static_cast<double>(h.index) - static_cast<double>((from + frames) % 3000)));
        }
    }
    return w.value();
}

void half_history(subject& s)
{
    s.change_temporal = [](ao::temporal_settings& t) { t.format = ao::history_format::half_stalls; };
}

// Points that come twice, and numbers of the sequence that are not there, over two periods.
double repeats(subject& s)
{
    ao::temporal_settings t;
    std::vector<glm::vec4> taps = ao::make_temporal_taps(t);
    if (s.faulty) {
        taps[100] = taps[99];
    }
    std::vector<std::array<float, 3>> sorted;
    for (const glm::vec4& p : taps) {
        sorted.push_back({ p.x, p.y, p.z });
    }
    std::sort(sorted.begin(), sorted.end());
    std::size_t twice = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        twice += sorted[i] == sorted[i - 1] ? 1 : 0;
    }
    return static_cast<double>(twice);
}

// How many points more or less than one lie in a box of 2^-a by 3^-b, of any 2^a 3^b consecutive ones.
double elementary_intervals(subject& s)
{
    struct box_set {
        std::uint32_t wide;
        std::uint32_t high;
        std::uint32_t start;
    };
    std::vector<box_set> sets;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t a = 0; a <= 5; ++a) {
        std::uint32_t high = 1;
        for (int b = 0; b <= 3; ++b, high *= 3) {
            const std::uint32_t count = high << a;
            for (const std::uint32_t start : { 0U, 7 * count, 1000 * count }) {
                sets.push_back({ 1U << a, high, start });
                for (std::uint32_t i = 0; i < count; ++i) {
                    indices.push_back(start + i);
                }
            }
        }
    }
    const auto x = inverses(s, 0, indices);
    const auto y = inverses(s, 1, indices);
    worst w;
    std::size_t at = 0;
    for (const box_set& boxes : sets) {
        std::vector<int> hits(boxes.wide * boxes.high);
        for (std::size_t i = 0; i < hits.size(); ++i, ++at) {
            // Off the box's lower edge, on which they would lie exactly but for rounding.
            const auto column = std::min(static_cast<std::uint32_t>((x[at] + 1e-6) * boxes.wide), boxes.wide - 1);
            const auto line = std::min(static_cast<std::uint32_t>((y[at] + 1e-6) * boxes.high), boxes.high - 1);
            ++hits[line * boxes.wide + column];
        }
        for (const int h : hits) {
            w.add(std::abs(h - 1));
        }
    }
    return w.value();
}

// Base 3 asked for, base 2 given: every coordinate the same.
void shared_dimension(subject& s)
{
    subject plain(s);
    s.evaluate_instead = [plain](int, auto a, auto b, auto out) mutable {
        const auto made = plain.evaluate(ids::ao_of_radical_inverse_2, { a.begin(), a.end() }, { b.begin(), b.end() });
        std::copy(made.begin(), made.end(), out.begin());
    };
}

void scale_off(subject& s)
{
    subject plain(s);
    s.evaluate_instead = [plain](int function, auto a, auto b, auto out) mutable {
        const auto made = plain.evaluate(function, { a.begin(), a.end() }, { b.begin(), b.end() });
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = made[i] * 1.000001F;
        }
    };
}

void mark_faulty(subject& s)
{
    s.faulty = true;
}

} // namespace

std::vector<row> sequence_rows()
{
    return {
        { "H1", "1 - greatest radical inverse, bases 2 to 13: all digits greatest, random 32-bit indices", 5.96e-8, true,
          "2^-24, the greatest float below 1", domain::passes, greatest_inverse, "digits summed in float", summed_digits },
        { "H2", "index of a pixel's sequence against frames times samples modulo 3000, frames in motion", 0, false,
          "whole numbers below 2^16 are exact in the history", domain::temporal, index_error,
          "half-float history: sticks at 2048", half_history },
        { "H3", "radical inverse against double, bases 2 to 13, indices below 2^22", 5e-7, false, "numerics.md H3",
          domain::passes, inverse_error, "scale off by 1e-6", scale_off },
        { "H4", "correlation of pairs of the bases in use (2, 3, 5), 16 to 1024 points", 0.35, false, "numerics.md H4",
          domain::core, pair_correlation, "bases 17, 19 and 23, 29 at 16 points", mark_faulty },
        { "H5", "offsets of the 4096 of a period that come twice", 0, false, "a sequence without repeats; H2 counts its gaps",
          domain::core, repeats, "one offset repeated", mark_faulty },
        { "H6", "points off one in boxes of 2^-a by 3^-b, a to 5, b to 3, any 2^a 3^b consecutive", 0, false,
          "elementary intervals of a Halton sequence", domain::passes, elementary_intervals, "one base for both axes",
          shared_dimension },
        { "H7", "radical inverse against double at multiples of the base and their neighbours, any 32-bit index", 5e-7, false,
          "integer digits; numerics.md H7", domain::passes, multiples_error, "index as a float, digits by floor", float_digits },
    };
}

} // namespace stability
