// What a user of temporal ambient occlusion chooses (paper 2) and what stays the same from frame to frame, and whether it makes
// sense.
#pragma once

#include "ao/plan.hpp"
#include "ao/temporal_passes.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace ao {

namespace detail {
using temporal_names = temporal_pass<float, no_resources>;
}

// What a sample contributes (systems.md B7), and `bitmask`, whose samples are the taps of whole slices (shared/slice_taps.h).
enum class contribution_type {
    ritschel = detail::temporal_names::ao_ritschel, // offsets in the hemisphere, held against depth; fall-off by their density
    fox_compton = detail::temporal_names::ao_fox_compton, // surface patches around the pixel: strength cos / distance
    bitmask = detail::temporal_names::ao_bitmask,         // sectors of a slice that its taps block
};

// Where offsets lie. hemisphere: (14) corrected, cosine-weighted directions, linear in the distance; for ritschel.
// disc_area and disc_linear: (13) with r = sqrt(z) and r = z; for fox_compton. slices: for bitmask, azimuths by Halton's
// sequence.
enum class sample_density { hemisphere, disc_area, disc_linear, slices };

// What a change in the neighbourhood of a pixel does to what its history weighs.
enum class invalidation_type {
    none = detail::temporal_names::ao_keep_weight,
    smooth = detail::temporal_names::ao_smooth_weight, // times the least 1 / (1 + S delta / R) over the samples
    clamp = detail::temporal_names::ao_clamp_weight,   // down to clamped_weight where that is below 1/2
};

enum class history_format {
    precise = detail::temporal_names::ao_history_precise,         // 16 bytes a pixel
    packed = detail::temporal_names::ao_history_packed,           // 8 bytes a pixel
    half_stalls = detail::temporal_names::ao_history_half_stalls, // 8 bytes; as printed, for comparison: it stops converging
};

struct temporal_settings {
    contribution_type contribution = contribution_type::ritschel;
    sample_density density = sample_density::hemisphere;
    float radius = 1.0F;    // scene units, (0, 1e15]
    float bias = 0.02F;     // scene units, [0, 1e15]
    float thickness = 2.0F; // radii, as in ao::settings; ritschel and bitmask
    int period = 4096;      // samples before a pixel's sequence starts again, 1 to 65536
    int first_samples = 32; // k1, 1 to period: a frame's samples while conv < adaptive
    int later_samples = 8;  // k2, 1 to period
    int most_weight = 500;  // w_max, samples, 1 to 4095; precise histories up to 2^20
    // w_max of pixels that move on the picture, samples, 1 or more: what a kernel sees there changes with the view, and every
    // fetch between pixels loses a little.
    int moving_weight = 150;
    float adaptive = 0.2F; // c_adaptive, [0, 1]
    float spatial = 0.3F;  // c_spatial, [0, 1]: convergence from which on nothing is filtered
    float rotation = 0.5F; // c_rot, [0, 1]: the pattern is turned from pixel to pixel while conv is less
    invalidation_type invalidation = invalidation_type::smooth;
    float smoothness = 30.0F;    // S, [0, 1e6]; the paper: 15 to 30
    int clamped_weight = 48;     // samples, 0 to w_max
    float tolerance = 0.01F;     // eps of the depth test, a share of the depth, [0, 1]; precision and slope add to it
    int filter = 5;              // pixels a side, odd, 1 (none) ... max_filter
    float filter_support = 0.5F; // of the filter in the world before anything has converged, radii, (0, 100]
    bool cubic = true;           // histories between pixels by Catmull-Rom, else bilinear
    history_format format = history_format::precise;
    std::uint32_t seed = 1; // of the rotations
    int slice_taps = 8;     // bitmask: taps of one slice, 1 to max_taps; first_samples, later_samples and period are multiples
    // fox_compton:
    float strength = 0.25F;       // radii: what a patch at distance d and cosine 1 darkens is strength / d, (0, 1e6]
    float least_distance = 0.05F; // radii, (0, 1]
    float largest = 1.0F;         // of one sample, (0, 1]
};

enum class motion_unit { pixels, uv, ndc };

// A host's motion picture: how far a surface point moved on the picture since the last frame.
struct motion_convention {
    motion_unit unit = motion_unit::pixels;
    bool from_previous = false; // now minus before; else before minus now, as gbuffer_facts::motion
    bool y_up = false;          // +y points to the first row in memory
    bool jittered = true;       // the difference of jittered positions
};

struct temporal_facts {
    ao::facts frame;     // pictures of a frame
    bool motion = false; // objects move, and there is a motion picture: xy, and in the formats of four z = eye depth in the last
                         // frame, or 0
    pixel_format motion_format = pixel_format::rg32f; // rg32f, rgba16f or rgba32f
    motion_convention convention{};
};

// The first thing wrong with the settings, or nothing.
constexpr std::optional<error> validate(const temporal_settings& s)
{
    const auto fail = [](const char* why) { return error(errc::invalid_settings, why); };
    const auto within = [](float x, float low, float high) { return x >= low && x <= high; };
    constexpr float limit = 1e15F;
    if (s.contribution < contribution_type::ritschel || s.contribution > contribution_type::bitmask) {
        return fail("unknown contribution");
    }
    const bool disc = s.density == sample_density::disc_area || s.density == sample_density::disc_linear;
    if ((s.contribution == contribution_type::ritschel && s.density != sample_density::hemisphere) ||
        (s.contribution == contribution_type::bitmask && s.density != sample_density::slices) ||
        (s.contribution == contribution_type::fox_compton && !disc)) {
        return fail("ritschel takes the hemisphere density, fox_compton one of the discs, bitmask slices");
    }
    if (!(s.radius > 0 && s.radius <= limit)) {
        return fail("radius must be greater than 0 and at most 1e15");
    }
    if (!within(s.bias, 0, limit)) {
        return fail("bias must be 0 to 1e15");
    }
    if (!(s.thickness > 0)) {
        return fail("thickness must be greater than 0");
    }
    if (s.period < 1 || s.period > 65536) {
        return fail("period must be 1 to 65536");
    }
    if (s.first_samples < 1 || s.first_samples > s.period || s.later_samples < 1 || s.later_samples > s.period) {
        return fail("samples of a frame must be 1 to the period");
    }
    if (s.contribution == contribution_type::bitmask) {
        if (s.slice_taps < 1 || s.slice_taps > max_taps) {
            return fail("taps of a slice must be 1 to 1024");
        }
        if (s.period % s.slice_taps != 0 || s.first_samples % s.slice_taps != 0 || s.later_samples % s.slice_taps != 0) {
            return fail("samples of a frame and the period must be multiples of a slice's taps");
        }
    }
    if (s.most_weight < 1 || s.most_weight > (s.format == history_format::precise ? 1 << 20 : 4095)) {
        return fail("greatest weight must be 1 to 4095, or to 1048576 in precise histories");
    }
    if (!within(s.adaptive, 0, 1) || !within(s.spatial, 0, 1) || !within(s.rotation, 0, 1) || !within(s.tolerance, 0, 1)) {
        return fail("thresholds of convergence and the depth tolerance must be 0 to 1");
    }
    if (s.moving_weight < 1) {
        return fail("greatest weight of moving pixels must be 1 or more");
    }
    if (s.invalidation < invalidation_type::none || s.invalidation > invalidation_type::clamp) {
        return fail("unknown invalidation");
    }
    if (!within(s.smoothness, 0, 1e6F)) {
        return fail("smoothness must be 0 to 1e6");
    }
    if (s.clamped_weight < 0 || s.clamped_weight > s.most_weight) {
        return fail("clamped weight must be 0 to the greatest weight");
    }
    if (s.filter < 1 || s.filter > max_filter || s.filter % 2 == 0) {
        return fail("filter must be odd, 1 to 31");
    }
    if (!(s.filter_support > 0 && s.filter_support <= 100)) {
        return fail("filter support must be greater than 0 and at most 100");
    }
    if (s.format < history_format::precise || s.format > history_format::half_stalls) {
        return fail("unknown history format");
    }
    if (!(s.strength > 0 && s.strength <= 1e6F) || !(s.least_distance > 0 && s.least_distance <= 1) ||
        !(s.largest > 0 && s.largest <= 1)) {
        return fail("strength, least distance and largest contribution must be greater than 0 and at most 1e6, 1 and 1");
    }
    return std::nullopt;
}

// The same slices in every frame, turned anew: what converges to the limit of many slices where nothing moves.
// Precondition: `still` is valid, with the method `bitmask`.
constexpr temporal_settings temporal_settings_of(const settings& still)
{
    temporal_settings s;
    s.contribution = contribution_type::bitmask;
    s.density = sample_density::slices;
    s.radius = still.radius;
    s.bias = still.bias;
    s.thickness = still.thickness;
    // Every pixel is estimated in every frame: the wide windows of half resolution have nothing to fill.
    s.filter = still.resolution == resolution::half ? s.filter : still.filter;
    s.seed = still.seed;
    s.slice_taps = still.taps / still.slices;
    s.period = 512 * s.slice_taps;
    s.first_samples = still.taps;
    s.later_samples = still.taps;
    s.most_weight = 64 * still.taps;
    s.moving_weight = 20 * still.taps;
    s.clamped_weight = 6 * still.taps;
    return s;
}

// The same settings; does not compile where they are not valid.
consteval temporal_settings checked(temporal_settings s)
{
    if (validate(s)) {
        throw "invalid ao::temporal_settings";
    }
    return s;
}

namespace detail {

constexpr std::optional<error> validate(const temporal_facts& f)
{
    if (const auto wrong = validate(f.frame)) {
        return wrong;
    }
    if (static_cast<std::size_t>(f.frame.width) * static_cast<std::size_t>(f.frame.height) > (std::size_t{ 1 } << 28U)) {
        return error(errc::invalid_size, "a picture with a history must have at most 2^28 pixels");
    }
    using enum pixel_format;
    if (f.motion && f.motion_format != rg32f && f.motion_format != rgba16f && f.motion_format != rgba32f) {
        return error(errc::unsupported_format, "motion must be rg32f, rgba16f or rgba32f");
    }
    return std::nullopt;
}

} // namespace detail

} // namespace ao
