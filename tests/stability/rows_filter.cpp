// 4.8: the filters.
#include "stability/figure.hpp"
#include "stability/planted.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"
#include "stability/stills.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace stability {

namespace {

constexpr float endless_f = std::numeric_limits<float>::infinity();

void mark_faulty(subject& s)
{
    s.faulty = true;
}

shot busy(int filter)
{
    ao::settings settings;
    settings.filter = filter;
    settings.bias = 0.03F;
    return shoot({ 40, 30, 0.5, false }, both(both(crease(0.8), tilted(0, 7)), sphere({ -0.4, -0.6, -4 }, 0.5)), settings);
}

// Single pixels of surface in background: filtered, they keep their own value.
double isolated(subject& s)
{
    const auto lonely = [](int filter) {
        shot made = busy(filter);
        for (std::size_t i = 0; i < made.depth.size(); ++i) {
            made.depth[i] = i % 40 % 8 == 3 && i / 40 % 8 == 3 ? made.depth[i] : 0.0F;
        }
        std::fill(made.normals.begin(), made.normals.end(), glm::normalize(glm::vec3(1, 0, -0.1F)));
        return made;
    };
    return greatest_difference(s.frame(lonely(1)), s.frame(lonely(7)));
}

// The range of the filtered picture beyond that of the same picture unfiltered, within each window.
double beyond_range(subject& s)
{
    worst w;
    const auto raw = s.frame(busy(1));
    for (const int filter : { 3, 5, 15 }) {
        const auto seen = s.frame(busy(filter));
        for (int y = 0; y < 30; ++y) {
            for (int x = 0; x < 40; ++x) {
                float low = 1;
                float high = 0;
                for (int v = std::max(y - filter / 2, 0); v <= std::min(y + filter / 2, 29); ++v) {
                    for (int u = std::max(x - filter / 2, 0); u <= std::min(x + filter / 2, 39); ++u) {
                        low = std::min(low, raw[static_cast<std::size_t>(v * 40 + u)]);
                        high = std::max(high, raw[static_cast<std::size_t>(v * 40 + u)]);
                    }
                }
                // Faulty: weights that sum to 1.0001.
                const float value = seen[static_cast<std::size_t>(y * 40 + x)] * (s.faulty ? 1.0001F : 1.0F);
                w.add(std::max(static_cast<double>(low) - static_cast<double>(value),
                               static_cast<double>(value) - static_cast<double>(high)));
            }
        }
    }
    return w.value();
}

// A constant picture, closed, half open and open, filtered minus itself.
double constant_input(subject& s)
{
    worst w;
    for (const float side : { 1.0F, -1.0F }) {
        for (const int filter : { 3, 5, 31 }) {
            ao::settings settings;
            settings.filter = filter;
            settings.bias = 0;
            settings.taps = 7;
            settings.thickness = endless_f;
            shot made = shoot({ 40, 30, 0.5, false }, tilted(0, 4), settings);
            std::fill(made.normals.begin(), made.normals.end(), glm::vec3(0, 0, side));
            for (const float x : s.frame(made)) {
                w.add(std::abs(static_cast<double>(x) - (side > 0 ? 1 : 0)));
            }
        }
    }
    return w.value();
}

void halve(subject& s)
{
    s.change_visibility = [](std::vector<float>& all) {
        for (float& x : all) {
            x += 2.4e-7F * (x < 0.5F ? 1.0F : -1.0F);
        }
    };
}

// What crosses a depth jump between a closed and an open half of the picture: mean of the three columns on either side. The
// temporal filter, on the first frame; faulty: a support that spans the jump.
double leak(subject& s)
{
    temporal_test::stage stage{ .width = 32, .height = 16 };
    auto frame = temporal_test::make_frame(stage, stage);
    const auto camera_depth = [](bool left) { return left ? 2.0F : 60.0F; };
    for (std::size_t i = 0; i < frame.inputs.depth.pixels(); ++i) {
        const bool left = i % 32 < 16;
        frame.inputs.depth.set_texel(i, camera_depth(left));
        frame.inputs.normal.set_texel(i, glm::vec4(0, 0, left ? -1.0F : 1.0F, 0));
        frame.inputs.motion.set_texel(i, glm::vec4(0, 0, camera_depth(left), 0));
    }
    const auto seen_with = [&](int filter) {
        temporal_run run(s);
        run.facts = temporal_test::facts_of(stage, true);
        run.settings.filter = filter;
        run.settings.spatial = 1;
        run.settings.first_samples = 8;
        run.settings.filter_support = s.faulty ? 100.0F : 0.5F;
        run.settings.bias = 0;
        return run.start() && run.step(frame) ? run.visibility() : std::vector<float>{};
    };
    const auto raw = seen_with(1);
    const auto seen = seen_with(5);
    worst w;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const bool left = i % 32 < 16;
        double low = 1;
        double high = 0;
        for (std::size_t k = 0; k < raw.size(); ++k) { // values of this side
            if ((k % 32 < 16) == left) {
                low = std::min(low, static_cast<double>(raw[k]));
                high = std::max(high, static_cast<double>(raw[k]));
            }
        }
        w.add(std::max(low - static_cast<double>(seen[i]), static_cast<double>(seen[i]) - high));
    }
    return raw.empty() || seen.empty() ? endless : w.value();
}

// Rows then columns against columns then rows, by holes that are their own transpose.
double transposed(subject& s)
{
    const auto turned = [](const shot& made) {
        shot other = made;
        for (int y = 0; y < 30; ++y) {
            for (int x = 0; x < 30; ++x) {
                other.depth[static_cast<std::size_t>(x * 30 + y)] = made.depth[static_cast<std::size_t>(y * 30 + x)];
            }
        }
        return other;
    };
    ao::settings settings;
    settings.filter = 5;
    settings.bias = 0;
    settings.thickness = endless_f;
    shot made = shoot({ 30, 30, 0.5, false }, tilted(0, 4), settings);
    // Closed or background, so that what is filtered is its own transpose: zeros and holes.
    std::fill(made.normals.begin(), made.normals.end(), glm::vec3(0, 0, -1));
    ao::random_stream random(8);
    std::vector<float> raw;
    for (float& d : made.depth) {
        d = random.next() % 3 == 0 ? 0.0F : d;
    }
    const auto a = s.frame(made);
    auto b = s.frame(turned(made));
    if (s.faulty) { // rows summed twice instead of rows and columns
        b = a;
    }
    // Offsets of a pixel differ from those of its transpose; holes do not.
    double wrong = 0;
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 30; ++x) {
            const bool hole = made.depth[static_cast<std::size_t>(y * 30 + x)] == 0;
            const float p = a[static_cast<std::size_t>(y * 30 + x)];
            const float q = b[static_cast<std::size_t>(x * 30 + y)];
            wrong += (p == 1 && hole) != (q == 1 && hole) ? 1 : 0;
        }
    }
    return wrong;
}

constexpr int wire_distance = 16; // pixels

// A wall and a floor, and before them wires as wide as a pixel, from `column` on; none where that is negative.
shot wired(int column)
{
    shot made = shoot({ 80, 60, 1, false }, both(crease(0.8), tilted(0, 4)), ao::settings_of(ao::preset::high));
    for (std::size_t i = 0; i < made.depth.size(); ++i) {
        if (column >= 0 && static_cast<int>(i % 80) % wire_distance == column) {
            made.depth[i] = 2;
            made.normals[i] = glm::vec3(0, 0, 1);
        }
    }
    return made;
}

// Mean over eight seeds of the pixels from `nearest` to `farthest` columns beside the wires from `column` on.
double beside_wires(subject& s, shot made, ao::resolution resolution, int column, int nearest, int farthest)
{
    made.settings.resolution = resolution;
    double sum = 0;
    int count = 0;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        made.settings.seed = seed;
        const auto seen = s.frame(made);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const int away = std::abs(static_cast<int>(i % 80) % wire_distance - column);
            if (away >= nearest && away <= farthest) {
                sum += static_cast<double>(seen[i]);
                ++count;
            }
        }
    }
    return sum / count;
}

// Half against full resolution on the wires themselves.
double thin_at_half(subject& s)
{
    const int column = s.faulty ? 9 : 8;
    const shot made = wired(column);
    return std::abs(beside_wires(s, made, ao::resolution::half, column, 0, 0) -
                    beside_wires(s, made, ao::resolution::full, column, 0, 0));
}

// What wires change up to four pixels beside them, at half minus at full resolution; faulty: the picture blurred across them.
double halo_at_half(subject& s)
{
    const auto change = [&](ao::resolution r) {
        return beside_wires(s, wired(8), r, 8, 1, 4) - beside_wires(s, wired(-1), r, 8, 1, 4);
    };
    const double full = change(ao::resolution::full);
    if (s.faulty) {
        s.change_visibility = [](std::vector<float>& all) {
            const std::vector<float> before = all;
            for (std::size_t i = 4; i + 4 < all.size(); ++i) {
                float sum = 0;
                for (std::size_t k = i - 4; k <= i + 4; ++k) {
                    sum += before[k];
                }
                all[i] = sum / 9;
            }
        };
    }
    return std::abs(change(ao::resolution::half) - full);
}

// Settings that are no filter: accepted ones.
double bad_settings(subject& s)
{
    double accepted = 0;
    for (const int filter : { -3, 0, 2, 4, 32, 33, 1000000 }) {
        ao::settings settings;
        settings.filter = s.faulty ? 3 : filter;
        accepted += ao::validate(settings) ? 0 : 1;
    }
    for (const float support : { 0.0F, -1.0F, 101.0F, endless_f, std::nanf("") }) {
        ao::temporal_settings settings;
        settings.filter_support = s.faulty ? 0.5F : support;
        accepted += ao::validate(settings) ? 0 : 1;
    }
    return accepted;
}

} // namespace

std::vector<row> filter_rows()
{
    return {
        { "B1", "single pixels in background, filtered over 7x7 minus unfiltered", 0, false, "only the centre counts",
          domain::passes, isolated, "background marks taken for visibilities", plant_blur },
        { "B3", "a constant picture, 0 and 1, filtered over 3, 5 and 31 pixels minus itself", 0, false,
          "sums of equal whole numbers; n / n is exact", domain::passes, constant_input, "two units in the last place off",
          halve },
        { "B4", "filtered values beyond the range of their window, 3 to 15 pixels", 1.2e-7, false,
          "a sum's rounding: one unit in the last place", domain::passes, beyond_range, "weights that sum to 1.0001",
          mark_faulty },
        { "B5", "what the temporal filter carries over a jump of depth from 2 to 60", 1.0 / 255, false, "numerics.md B5",
          domain::temporal, leak, "a support of 100 units, which spans the jump", mark_faulty },
        { "B6", "pixels whose filtered value is open in a picture and not in its transpose", 0, false,
          "rows then columns equal columns then rows", domain::passes, transposed, "not transposed", mark_faulty },
        { "B7", "bitmask at half resolution on wires a pixel wide, minus full resolution", 0.005, false,
          "five times the mean's deviation: 2400 pixels of eight seeds with 0.05 each", domain::passes, thin_at_half,
          "wires on odd columns, of which no pixel is estimated", mark_faulty },
        { "7.22", "what wires a pixel wide change up to four pixels beside them, at half minus at full resolution", 0.005, false,
          "as B7", domain::passes, halo_at_half, "a blur that knows no depth", mark_faulty },
        { "B8", "filters of even, negative or huge size, supports 0, negative, infinite or NaN that are accepted", 0, false,
          "refused with a reason", domain::core, bad_settings, "valid ones in their place", mark_faulty },
    };
}

} // namespace stability
