#pragma once

#include "ao/options.hpp"
#include "ao/picture.hpp"

#include <string>
#include <vector>

namespace ao::tools {

// What every backend is fed, the same bytes for all.
struct run_inputs {
    ao::settings settings;
    ao::facts facts;
    ao::camera camera;
    picture depth;
    picture normal; // empty where facts::normals is from_depth
    int frames = 1; // timed, after one untimed
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
};

// Every backend and route that was asked for, one after another.
// Throws `error`: no device, what a backend refuses, or an interrupt.
[[nodiscard]] std::vector<run_outcome> run_all(const render_options& o, const run_inputs& in);

} // namespace ao::tools
