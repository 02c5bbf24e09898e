#pragma once

#include "ao/history_watch.hpp"
#include "ao/runs.hpp"
#include "ao/temporal_frames.hpp"
#include "scene/apng.hpp"
#include "scene/metrics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace ao::tools {

// A backend's frame of an animation.
struct temporal_frame_outcome {
    std::vector<timed_pass> passes; // those that ran
    double total_ms = 0;
    std::optional<double> draw_ms; // where the backend drew its own G-buffer
    frame_facts facts;
    std::optional<picture_error> error; // where there is truth
};

struct temporal_run {
    std::string label; // what file names end in
    std::string backend;
    std::string device;
    std::string route;
    double first_frame_ms = 0; // with preparing
    std::vector<temporal_frame_outcome> frames;
    std::vector<float> visibility; // of the last frame, as are these:
    std::vector<std::uint32_t> history;
    std::optional<animation> shown; // where files are asked for
};

struct temporal_outcomes {
    std::vector<temporal_run> runs;
    std::vector<std::uint8_t> cuts; // by frame: whether the history was forgotten before it
    // By frame, where there is truth and an ordinary pass that estimates the same: its error with k2 taps and no filter, from the
    // first run's pictures.
    std::vector<picture_error> alone;
    std::optional<truth_halves> truth; // of the last frame
    std::optional<picture_error> best_constant;
    std::optional<animation> truth_shown;
};

// All backends frame by frame, so that none but the last frame's pictures are held. Throws `error`.
[[nodiscard]] temporal_outcomes run_temporal(const render_options& o, temporal_frames& frames);

} // namespace ao::tools
