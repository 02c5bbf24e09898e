#pragma once

#include "ao/options.hpp"
#include "ao/picture.hpp"
#include "ao/texture.hpp"
#include "ao/view.hpp"

#include <optional>
#include <string>
#include <vector>

namespace ao::tools {

// What every backend is given.
struct run_inputs {
    ao::settings settings;
    ao::facts facts;
    tools::view view;
    ao::scene scene;
    ao::gbuffer_facts targets;
    // The same bytes for all, in place of what each would draw.
    std::optional<picture_set> pictures;
    // For the effect, where it does not read the pictures above: linear depth.
    ao::picture linear_depth;
    std::optional<ao::shade_plan> shading;
    ao::texel_heap heap; // for shading, and for the normal maps that rays meet
    int frames = 1;      // timed, after one untimed
};

struct timed_pass {
    std::string name;
    double ms = 0;
};

// Times are medians over the frames. The first frame's covers preparing, binding and drawing it.
struct run_outcome {
    std::string label; // what the pictures' file names end in
    std::string backend;
    std::string device;
    std::string route;
    std::vector<timed_pass> passes;
    double total_ms = 0;
    double first_frame_ms = 0;
    std::vector<float> visibility;
    std::vector<float> bent_normal; // x, y, z, view space; empty where not asked for
    ao::picture stored;             // both, as the backend stored them
    std::size_t scene = 0;          // index of the outcome whose pictures it read
};

// What a backend's rasterizer drew and its shading made of it, with the visibility of its first run.
struct scene_outcome {
    std::string label;
    std::string backend;
    std::string device;
    std::string route;
    host::draw_counts counts;
    double draw_ms = 0; // medians
    double shade_ms = 0;
    double first_draw_ms = 0;  // with loading
    double first_shade_ms = 0; // with compiling
    picture_set drawn;         // or the pictures that were given
    ao::picture color;         // with --shade: linear
    ao::picture plain;         // everything open
    std::uint64_t clamped = 0; // weights of blends, in one frame
};

struct all_outcomes {
    std::vector<run_outcome> runs;
    std::vector<scene_outcome> scenes; // none for rays without shading
};

// Every backend and route that was asked for, one after another.
// Throws `error`: no device, what a backend refuses, or an interrupt.
[[nodiscard]] all_outcomes run_all(const render_options& o, const run_inputs& in);

} // namespace ao::tools
