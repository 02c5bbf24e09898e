// 4.6: poison in every input of every pass, and background.
#include "stability/figure.hpp"
#include "stability/methods.hpp"
#include "stability/planted.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"
#include "stability/stills.hpp"

#include "ao/conformance/pictures.hpp"
#include "unit/temporal_sequence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace stability {

namespace {

constexpr float endless_f = std::numeric_limits<float>::infinity();

void mark_faulty(subject& s)
{
    s.faulty = true;
}

double bad_values(const std::vector<float>& seen)
{
    double bad = 0;
    for (const float x : seen) {
        bad += x >= 0 && x <= 1 ? 0 : 1;
    }
    return bad;
}

struct normal_storage {
    ao::normal_source source;
    ao::pixel_format format;
};
constexpr std::array normal_storages{ normal_storage{ ao::normal_source::vector, ao::pixel_format::rgba32f },
                                      normal_storage{ ao::normal_source::vector, ao::pixel_format::rgba16f },
                                      normal_storage{ ao::normal_source::unorm10, ao::pixel_format::rgb10a2 },
                                      normal_storage{ ao::normal_source::octahedral, ao::pixel_format::rg16 },
                                      normal_storage{ ao::normal_source::from_depth, ao::pixel_format::rgba32f } };

// One of a series of frames of noise with a fifth of it poisoned: sizes, formats, methods and filters in turn.
std::vector<float> poisoned_frame(subject& s, int width, int height, std::uint32_t turn, std::uint32_t seed)
{
    const depth_storage& d = depth_storages[turn % depth_storages.size()];
    const normal_storage& n = normal_storages[turn / 2 % normal_storages.size()];
    const viewer v{ width, height, turn % 4 == 3 ? 3.0 : 0.6, turn % 4 == 3 };
    const auto noise = ao::conformance::make_noise(width, height, seed);
    shot made;
    made.settings.method = methods[turn % methods.size()];
    made.settings.taps = 8;
    made.settings.filter = turn % 3 == 0 ? 1 : turn % 3 == 1 ? 3 : 5;
    made.settings.thickness = turn % 5 == 0 ? endless_f : 2.0F;
    made.facts.width = width;
    made.facts.height = height;
    made.facts.parallel = v.parallel;
    made.facts.normals = n.source;
    made.facts.normal_format = n.format;
    made.depth = noise.depth;
    made.normals = noise.normals;
    made = stored_as(made, d, v, 0.1, 1000);
    stored_shot stored = store(made);
    ao::conformance::poison(stored.depth, seed + 1);
    if (!stored.normal.bytes.empty()) {
        ao::conformance::poison(stored.normal, seed + 2);
    }
    return s.frame(made, stored);
}

// Bad pixels of many poisoned frames, every one of sizes 1 to 33 among them in the long form, and 10^7 pixels in all.
double poison_fuzz(subject& s)
{
    double bad = 0;
    std::uint32_t turn = 0;
    for (int size = 1; size <= 33; size += s.thorough ? 1 : 8) {
        for (const int other : { 34 - size, 1, size }) {
            bad += bad_values(poisoned_frame(s, size, other, turn, 100 + turn));
            ++turn;
        }
    }
    const int frames = s.thorough ? 12 : 2;
    const int side = s.thorough ? 1024 : 128;
    for (int i = 0; i < frames; ++i) {
        bad += bad_values(poisoned_frame(s, side, side - i, turn + static_cast<std::uint32_t>(i), 900 + turn));
    }
    return bad;
}

// Pixels farther from one poisoned texel than kernel and filter reach, that changed.
double poison_reach(subject& s)
{
    const viewer v{ 48, 36, 0.6, false };
    ao::settings settings;
    settings.radius = 0.3F;
    settings.taps = 8;
    settings.filter = 3;
    const shot made = shoot(v, both(tilted(20, 5), sphere({ 0.3, 0, -4.5 }, 0.5)), settings);
    const auto clean = s.frame(made);
    double strayed = 0;
    const auto where = static_cast<std::size_t>(18 * 48 + 20);
    for (const float poison : { std::nanf(""), endless_f, -endless_f, 1e38F, 1e-41F, 0.0F, -1.0F }) {
        for (int channel = 0; channel < 4; ++channel) {
            stored_shot stored = store(made);
            auto n = stored.normal.texel<glm::vec4>(where);
            if (channel == 3) {
                stored.depth.set_texel(where, poison);
            }
            else {
                n[channel] = poison;
                stored.normal.set_texel(where, n);
            }
            shot changed = made;
            if (s.faulty) {
                changed.settings.filter = 31;
            }
            const auto seen = s.frame(changed, stored);
            const auto base = s.faulty ? s.frame(changed, store(made)) : clean;
            for (int i = 0; i < 48 * 36; ++i) {
                // 0.3 units at distance 3.5 are 2.6 pixels; the filter adds 1.
                const bool near = std::abs(i % 48 - 20) <= 4 && std::abs(i / 48 - 18) <= 4;
                const auto k = static_cast<std::size_t>(i);
                strayed += !near && std::memcmp(&seen[k], &base[k], sizeof(float)) != 0 ? 1 : 0;
            }
        }
    }
    return strayed;
}

// Bad histories and visibilities in the frame after the history was spoilt; faulty: in the frame itself.
double poisoned_history(subject& s)
{
    double bad = 0;
    for (const auto format : { ao::history_format::precise, ao::history_format::packed }) {
        still_run run(s, { 33, 17 }, true);
        run.settings.format = format;
        run.settings.first_samples = 8;
        if (!run.start() || !run.step() || !run.step()) {
            return endless;
        }
        for (std::uint32_t seed = 1; seed <= (s.thorough ? 40U : 6U); ++seed) {
            auto words = run.runner().history();
            if (!words) {
                return endless;
            }
            temporal_test::spoil_history(*words, seed);
            if (!run.runner().set_history(*words) || (!s.faulty && !run.step())) {
                return endless;
            }
            for (const history& h : run.histories()) {
                const bool good =
                    h.value >= 0 && h.value <= 1 && h.weight >= 0 && h.weight <= 500 && h.index >= 0 && h.index < 4096;
                bad += good ? 0 : 1;
            }
            bad += bad_values(run.visibility());
        }
    }
    return bad;
}

// Bad visibilities of a moving sequence whose depth, normals, motion and history are poisoned again and again.
double temporal_fuzz(subject& s)
{
    double bad = 0;
    for (int kind = 0; kind < (s.thorough ? 6 : 2); ++kind) {
        temporal_test::temporal_case c;
        c.poison = true;
        c.frames = s.thorough ? 26 : 14;
        c.settings.first_samples = 12;
        c.settings.later_samples = 3;
        c.settings.most_weight = 40;
        c.settings.moving_weight = 24;
        c.settings.clamped_weight = 4;
        c.settings.format = kind % 2 == 0 ? ao::history_format::precise : ao::history_format::packed;
        c.settings.cubic = kind != 2;
        c.settings.invalidation = kind == 3 ? ao::invalidation_type::clamp : ao::invalidation_type::smooth;
        c.facts = temporal_test::facts_of({ .width = s.thorough ? 96 : 32, .height = s.thorough ? 65 : 21 }, kind != 4);
        if (kind == 5) {
            c.settings.contribution = ao::contribution_type::fox_compton;
            c.settings.density = ao::sample_density::disc_area;
        }
        temporal_run run(s);
        run.settings = c.settings;
        run.facts = c.facts;
        if (!run.start()) {
            return endless;
        }
        std::uint32_t index = 0;
        for (const auto& f : temporal_test::make_sequence(c)) {
            if (f.fault) {
                auto words = run.runner().history();
                temporal_test::spoil_history(*words, index);
                if (!run.runner().set_history(*words)) {
                    return endless;
                }
            }
            if (!run.step(f.frame, f.cut)) {
                return endless;
            }
            auto seen = run.visibility();
            if (s.change_visibility) {
                s.change_visibility(seen);
            }
            bad += bad_values(seen);
            ++index;
        }
    }
    return bad;
}

void let_one_through(subject& s)
{
    s.change_visibility = [](std::vector<float>& all) { all.back() = std::nanf(""); };
}

// Background's visibility minus 1, and what it takes from a floor that runs into it.
double background(subject& s)
{
    worst w;
    for (const ao::method m : methods) {
        for (const float thickness : { 2.0F, endless_f }) {
            for (const int filter : { 1, 5 }) {
                ao::settings settings;
                settings.method = m;
                settings.thickness = thickness;
                settings.filter = filter;
                const shot some = shoot({ 24, 18, 0.6, false }, square(1, 4), settings);
                w.add(1 - least(s.frame(some)));
            }
        }
    }
    return w.value();
}

// Nothing but background, and background beyond camera::background.
double all_background(subject& s)
{
    worst w;
    ao::settings settings;
    shot none = shoot({ 24, 18, 0.6, false }, tilted(0, 4), settings);
    shot beyond = none;
    std::fill(none.depth.begin(), none.depth.end(), 0.0F);
    w.add(1 - least(s.frame(none)));
    beyond = shoot({ 24, 18, 0.6, false }, both(tilted(0, 4), square(0.6, 3.6)), settings);
    beyond.camera.background = s.faulty ? 1e30F : 3.3F;
    w.add(1 - least(s.frame(beyond)));
    return w.value();
}

// An occluded floor that ends at background: its filtered visibility against that of the same floor in a picture of its own.
double not_blurred_in(subject& s)
{
    ao::settings settings;
    settings.filter = 5;
    shot made = shoot({ 24, 18, 0.6, false }, tilted(0, 4), settings);
    std::fill(made.normals.begin(), made.normals.end(), glm::vec3(0, 0, -1)); // closed: 0 everywhere
    made.settings.bias = 0;
    made.settings.radius = 0.05F; // within the pixel: no offset lands on background
    made.settings.thickness = endless_f;
    for (std::size_t i = 0; i < made.depth.size(); ++i) {
        made.depth[i] = i % 24 < 12 ? made.depth[i] : 0.0F;
    }
    worst w;
    const auto seen = s.frame(made);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        w.add(std::abs(static_cast<double>(seen[i]) - (i % 24 < 12 ? 0 : 1)));
    }
    return w.value();
}

} // namespace

std::vector<row> poison_rows()
{
    return {
        { "P1",
          "pixels outside [0, 1]: a fifth of depth and normals NaN, infinite, denormal, huge, negative or 0; all formats, "
          "methods, sizes 1 to 33",
          0, false, "exact", domain::passes, poison_fuzz, "background marks taken for visibilities", plant_blur },
        { "P1r", "pixels beyond kernel and filter that one poisoned texel changes, each channel, 7 kinds", 0, false,
          "influence ends where reads end", domain::passes, poison_reach, "a filter of 31 pixels", mark_faulty },
        { "P1h", "bad histories and visibilities one frame after a history was spoilt, precise and packed", 0, false,
          "a history is checked when it is read", domain::temporal, poisoned_history, "looked at before that frame",
          mark_faulty },
        { "P1t", "bad visibilities in motion, depth, normals, motion and history poisoned", 0, false, "exact", domain::temporal,
          temporal_fuzz, "one NaN in the last pixel of each frame", let_one_through },
        { "P2", "1 - visibility of a square and the background about it, both thicknesses, with filter and without", 0, false,
          "background is open and no occluder", domain::passes, background, "background occludes", plant_background },
        { "P2a", "1 - visibility where all is background, or beyond camera::background", 0, false, "exact", domain::passes,
          all_background, "camera::background left out", mark_faulty },
        { "P2b", "what a filter of 5 carries between a closed floor and the background beside it", 0, false, "exact",
          domain::passes, not_blurred_in, "background marks taken for visibilities", plant_blur },
    };
}

} // namespace stability
