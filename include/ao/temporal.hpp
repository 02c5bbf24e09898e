// Temporal ambient occlusion as plain data (paper 2): the passes that a program is prepared for, and for each frame which of them
// run. What camera and scene do not need is not run: no reprojection where both stand still, nothing at all once every pixel has
// converged. No API: a temporal backend executes it (ao/temporal_backend.hpp).
#pragma once

#include "ao/temporal_settings.hpp"
#include "ao/temporal_taps.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace ao {

// Options of the pass bodies, in the order of their specialisation constants. A pass reads those that its body names.
struct temporal_options {
    int most_samples = 0;
    int contribution = 0;
    int history_format = 0;
    int invalidation = 0;
    bool reproject = false;
    bool use_motion = false; // reads the motion picture
    bool cubic = false;
    int normal_source = 0;
    bool rotate_normals = false;
    bool parallel = false;
    bool limit_thickness = false;
    int filter_radius = 0; // resolve: that of the filter behind it, or 0
    bool affine = false;   // linearize
    int slice_taps = 1;    // of one slice (bitmask)

    friend constexpr bool operator==(const temporal_options&, const temporal_options&) = default;
};

enum class temporal_pass_type {
    linearize,  // ao_linearize_pass: depth -> the program's own eye depth (r32f)
    accumulate, // ao_accumulate_pass: eye depth, normal, motion, the last history -> this frame's history
    resolve,    // ao_temporal_resolve_pass: history -> visibility
    // Need to run only in tiles, of any size, in which ao_to_be_filtered holds somewhere; the result is the same.
    filter_rows,    // ao_temporal_rows_pass: history, eye depth -> the program's own row values (r32f)
    filter_columns, // ao_temporal_columns_pass: history, eye depth, row values -> visibility
};

using temporal_constants = temporal_pass<float, no_resources>::ao_temporal_constants;
using temporal_filter_constants = temporal_filter_pass<float, no_resources>::ao_temporal_filter_constants;
static_assert(sizeof(temporal_constants) == 272 && sizeof(temporal_filter_constants) == 64);

struct temporal_step {
    temporal_pass_type type{};
    temporal_options options;
    // The shared constants struct of the pass, as bytes: 32 (linearize), 272 (accumulate) or 64.
    std::array<std::byte, 272> constants{};
    std::size_t constants_size = 0;
};

struct temporal_plan {
    temporal_settings settings;
    temporal_facts facts;
    inline_vector<temporal_step, 6> steps; // all that any frame may run: what a program is prepared for
    bool linearize = false;                // else the host's depth picture is eye depth
};

// Whether a program prepared for `a` executes `b`: they differ in nothing but what next_frame puts into constants, and in the
// formats of pictures that are read.
constexpr bool same_program(const temporal_plan& a, const temporal_plan& b)
{
    const facts& f = a.facts.frame;
    const facts& g = b.facts.frame;
    bool same = f.width == g.width && f.height == g.height && f.depth == g.depth && f.output_format == g.output_format &&
                a.settings.period == b.settings.period && a.settings.density == b.settings.density &&
                a.settings.seed == b.settings.seed && a.settings.slice_taps == b.settings.slice_taps &&
                a.steps.size() == b.steps.size();
    for (std::size_t i = 0; same && i < a.steps.size(); ++i) {
        same = a.steps[i].type == b.steps[i].type && a.steps[i].options == b.steps[i].options;
    }
    return same;
}

// Bytes of one of the two history buffers.
constexpr std::size_t history_bytes(const temporal_plan& p)
{
    const auto words = static_cast<std::size_t>(math<float>::ao_history_words(static_cast<int>(p.settings.format)));
    return 4 * words * static_cast<std::size_t>(p.facts.frame.width) * static_cast<std::size_t>(p.facts.frame.height);
}

// A pixel's words from the content of such a buffer, pixel after pixel.
constexpr glm::uvec4 history_words(std::span<const std::uint32_t> all, history_format format, std::size_t pixel)
{
    const auto words = static_cast<std::size_t>(math<float>::ao_history_words(static_cast<int>(format)));
    const std::span<const std::uint32_t> at = all.subspan(words * pixel, words);
    return { at[0], at[1], words == 4 ? at[2] : 0, words == 4 ? at[3] : 0 };
}

// A frame's camera. The eye is in double, and only differences of eyes are used: scenes may be anywhere.
struct temporal_camera {
    camera_projection projection; // with its jitter, if there is any
    matrix3 world_to_view;        // a rotation
    std::array<double, 3> eye{};  // world space
    float jitter_x = 0;           // what the projection shifts this frame's picture by, pixels along columns and rows in memory;
    float jitter_y = 0;           // used where motion_convention::jittered is false
    matrix3 normal_to_view{};     // where facts::world_normals
    float background = max_eye_depth;

    friend constexpr bool same_view(const temporal_camera& a, const temporal_camera& b)
    {
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                if (a.projection.matrix[column][row] != b.projection.matrix[column][row] ||
                    (column < 3 && row < 3 && a.world_to_view[column][row] != b.world_to_view[column][row])) {
                    return false;
                }
            }
        }
        return a.eye == b.eye && a.background == b.background && a.projection.range == b.projection.range &&
               a.projection.rows == b.projection.rows;
    }
};

// What carries over from frame to frame; one per program. Plain data: copy it to go back.
struct temporal_state {
    bool started = false; // there is a history
    temporal_camera previous;
    int still_frames = 0; // since camera and scene last moved
    int latest = 0;       // which of the two history buffers holds it
};

// What a frame runs: steps in order.
struct temporal_frame {
    inline_vector<std::size_t, 5> steps;
    int read = 0;  // history buffer of the last frame
    int write = 0; // of this frame; where steps is empty, the one that stays
};

namespace detail {

constexpr bool is_rotation(const matrix3& m)
{
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            double sum = 0;
            for (int i = 0; i < 3; ++i) {
                sum += static_cast<double>(m[a][i]) * static_cast<double>(m[b][i]);
            }
            if (!(sum - (a == b ? 1 : 0) < 1e-3 && sum - (a == b ? 1 : 0) > -1e-3)) {
                return false;
            }
        }
    }
    return true;
}

// The map from this frame's view space to the last one's, of what stands still in the world, row by row.
constexpr std::array<float, 12> to_previous_rows(const temporal_camera& now, const temporal_camera& before)
{
    std::array<float, 12> rows{};
    for (int row = 0; row < 3; ++row) {
        double shift = 0;
        for (int column = 0; column < 3; ++column) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) {
                sum += static_cast<double>(before.world_to_view[k][row]) * static_cast<double>(now.world_to_view[k][column]);
            }
            const auto axis = static_cast<std::size_t>(column);
            rows[static_cast<std::size_t>(4 * row + column)] = static_cast<float>(sum);
            shift += static_cast<double>(before.world_to_view[column][row]) * (now.eye[axis] - before.eye[axis]);
        }
        rows[static_cast<std::size_t>(4 * row + 3)] = static_cast<float>(shift);
    }
    return rows;
}

constexpr std::optional<error> check_camera(const temporal_plan& p, const temporal_camera& view, projection_constants& folded)
{
    const facts& f = p.facts.frame;
    if (!(view.background > 0)) {
        return error(errc::invalid_projection, "background must be greater than 0");
    }
    const float background = view.background < max_eye_depth ? view.background : max_eye_depth;
    const result<projection_constants> made = fold_projection(view.projection, f.width, f.height, background);
    if (!made) {
        return made.error();
    }
    if (made->parallel != f.parallel) {
        return error(errc::invalid_projection, f.parallel ? "the plan is for a parallel projection, the camera has perspective"
                                                          : "the plan is for perspective, the camera has a parallel projection");
    }
    if (!is_rotation(view.world_to_view)) {
        return error(errc::invalid_projection, "world_to_view must be a rotation");
    }
    constexpr double far_away = 1e30;
    for (const double x : view.eye) {
        if (!(x >= -far_away && x <= far_away)) {
            return error(errc::invalid_projection, "the eye must be finite");
        }
    }
    if (!(view.jitter_x >= -65536 && view.jitter_x <= 65536 && view.jitter_y >= -65536 && view.jitter_y <= 65536)) {
        return error(errc::invalid_projection, "jitter must be at most 65536 pixels");
    }
    folded = *made;
    return std::nullopt;
}

constexpr temporal_constants make_constants(const temporal_plan& p, const temporal_camera& now, const temporal_camera& before,
                                            const projection_constants& folded, const projection_constants& folded_before,
                                            bool believe)
{
    const temporal_settings& s = p.settings;
    const facts& f = p.facts.frame;
    temporal_constants c{};
    c.projection = std::bit_cast<decltype(c.projection)>(folded.projection);
    c.previous_projection = std::bit_cast<decltype(c.projection)>(folded_before.projection);
    c.to_previous = std::bit_cast<decltype(c.to_previous)>(to_previous_rows(now, before));
    const matrix3& turn = now.normal_to_view;
    c.normal_to_view = { turn[0][0], turn[1][0], turn[2][0], 0,          turn[0][1], turn[1][1],
                         turn[2][1], 0,          turn[0][2], turn[1][2], turn[2][2], 0 };
    const depth_error e = storage_error(f, folded);
    c.radius = s.radius;
    c.bias = s.bias + e.constant;
    c.bias_linear = e.linear;
    c.bias_quadratic = e.quadratic;
    c.thickness = s.thickness * s.radius;
    c.background = now.background < max_eye_depth ? now.background : max_eye_depth;
    c.width = static_cast<float>(f.width);
    c.height = static_cast<float>(f.height);

    const motion_convention& m = p.facts.convention;
    const float side = m.from_previous ? -1.0F : 1.0F;
    const float share = m.unit == motion_unit::ndc ? 0.5F : 1.0F;
    c.motion_scale_x = side * (m.unit == motion_unit::pixels ? 1.0F : share * c.width);
    c.motion_scale_y = side * (m.y_up ? -1.0F : 1.0F) * (m.unit == motion_unit::pixels ? 1.0F : share * c.height);
    c.motion_offset_x = m.jittered ? 0.0F : before.jitter_x - now.jitter_x;
    c.motion_offset_y = m.jittered ? 0.0F : before.jitter_y - now.jitter_y;

    const auto most = static_cast<float>(s.most_weight);
    c.tolerance = s.tolerance;
    c.tolerance_constant = e.constant;
    c.steepness = s.smoothness / s.radius;
    c.history = believe ? 1.0F : 0.0F;
    c.period = static_cast<float>(s.period);
    c.most_weight = most;
    c.first_samples = static_cast<float>(s.first_samples);
    c.later_samples = static_cast<float>(s.later_samples);
    c.adaptive_weight = s.adaptive * most;
    c.rotation_weight = s.rotation * most;
    c.clamped_weight = static_cast<float>(s.clamped_weight);
    c.strength = s.strength * s.radius;
    c.least_distance = s.least_distance * s.radius;
    c.largest = s.largest;
    c.moving_weight = static_cast<float>(s.moving_weight);
    c.motion_error = p.facts.motion && p.facts.motion_format == pixel_format::rgba16f ? 0x1p-10F : 0x1p-20F;
    return c;
}

} // namespace detail

constexpr result<temporal_plan> make_temporal_plan(const temporal_settings& s, const temporal_facts& f)
{
    if (const auto wrong = validate(s)) {
        return *wrong;
    }
    if (const auto wrong = detail::validate(f)) {
        return *wrong;
    }
    temporal_plan p{ s, f, {}, f.frame.depth != depth_source::linear };
    const auto add = [&](temporal_pass_type type) -> temporal_options& {
        temporal_step step;
        step.type = type;
        step.options.history_format = static_cast<int>(s.format);
        step.options.parallel = f.frame.parallel;
        p.steps.push_back(step);
        return p.steps[p.steps.size() - 1].options;
    };
    if (p.linearize) {
        add(temporal_pass_type::linearize).affine = f.frame.depth == depth_source::position || f.frame.parallel;
    }
    for (const bool reproject : { false, true }) {
        if (!reproject && f.motion) {
            continue; // objects may move in every frame
        }
        temporal_options& o = add(temporal_pass_type::accumulate);
        o.most_samples = s.first_samples > s.later_samples ? s.first_samples : s.later_samples;
        o.contribution = static_cast<int>(s.contribution);
        // Where nothing but the camera moves, no neighbourhood changes.
        o.invalidation = reproject && f.motion ? static_cast<int>(s.invalidation) : 0;
        o.reproject = reproject;
        o.use_motion = reproject && f.motion;
        o.cubic = reproject && s.cubic;
        o.normal_source = static_cast<int>(f.frame.normals);
        o.rotate_normals = f.frame.world_normals && f.frame.normals != normal_source::from_depth;
        o.limit_thickness = s.thickness <= std::numeric_limits<float>::max();
        o.slice_taps = s.contribution == contribution_type::bitmask ? s.slice_taps : 1;
    }
    const int filter_radius = s.spatial > 0 ? s.filter / 2 : 0;
    add(temporal_pass_type::resolve).filter_radius = filter_radius;
    if (filter_radius > 0) {
        add(temporal_pass_type::filter_rows).filter_radius = filter_radius;
        add(temporal_pass_type::filter_columns).filter_radius = filter_radius;
    }
    return p;
}

// Still frames after which every pixel has converged.
constexpr int frames_to_converge(const temporal_settings& s)
{
    const int fewest = s.first_samples < s.later_samples ? s.first_samples : s.later_samples;
    return (s.most_weight + fewest - 1) / fewest;
}

// The next frame: rewrites the constants of the steps it runs and the state. On an error nothing changes.
// `cut`: forget the history (a cut, a teleport, other content). A frame without steps leaves the visibility as it is.
constexpr result<temporal_frame> next_frame(temporal_plan& p, temporal_state& state, const temporal_camera& view,
                                            bool cut = false)
{
    projection_constants folded;
    if (const auto wrong = detail::check_camera(p, view, folded)) {
        return *wrong;
    }
    const bool believe = state.started && !cut;
    const temporal_camera& before = believe ? state.previous : view;
    const bool still = !p.facts.motion && same_view(view, before);
    const int still_frames = believe && still ? state.still_frames + 1 : 1;

    temporal_frame frame;
    frame.read = state.latest;
    frame.write = state.latest;
    // The frame before converged every pixel, and its visibility was not filtered.
    const int enough = frames_to_converge(p.settings);
    if (still && still_frames > enough) {
        state.previous = view;
        return frame;
    }
    frame.write = 1 - state.latest;
    projection_constants folded_before = folded;
    if (believe) {
        const float background = before.background < max_eye_depth ? before.background : max_eye_depth;
        folded_before = *fold_projection(before.projection, p.facts.frame.width, p.facts.frame.height, background);
    }
    // Whether some pixel may still be filtered.
    const auto least = static_cast<float>(still_frames) * static_cast<float>(p.settings.most_weight) / static_cast<float>(enough);
    const bool filtered = !still || least < p.settings.spatial * static_cast<float>(p.settings.most_weight);
    for (std::size_t i = 0; i < p.steps.size(); ++i) {
        temporal_step& step = p.steps[i];
        switch (step.type) {
        case temporal_pass_type::linearize:
            detail::set_constants(step, detail::make_linearize_constants(p.facts.frame, folded));
            frame.steps.push_back(i);
            break;
        case temporal_pass_type::accumulate:
            if (step.options.reproject != still) {
                detail::set_constants(step, detail::make_constants(p, view, before, folded, folded_before, believe));
                frame.steps.push_back(i);
            }
            break;
        case temporal_pass_type::resolve:
        case temporal_pass_type::filter_rows:
        case temporal_pass_type::filter_columns: {
            if (step.type == temporal_pass_type::resolve || filtered) {
                temporal_filter_constants c{};
                c.projection = std::bit_cast<decltype(c.projection)>(folded.projection);
                c.width = static_cast<float>(p.facts.frame.width);
                c.height = static_cast<float>(p.facts.frame.height);
                c.most_weight = static_cast<float>(p.settings.most_weight);
                c.c_spatial = p.settings.spatial;
                c.support = p.settings.filter_support * p.settings.radius;
                detail::set_constants(step, c);
                frame.steps.push_back(i);
            }
            break;
        }
        }
    }
    state.started = true;
    state.previous = view;
    state.still_frames = still_frames;
    state.latest = frame.write;
    return frame;
}

} // namespace ao
