#pragma once

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

// All throw `error`: no device, what the backend refuses, or an interrupt.
// `lanes`: 0 the widest, 1 scalar, 4, 8, 16.
[[nodiscard]] run_outcome run_cpu(const run_inputs& in, int lanes);
// `device` is part of a name; empty: OSMesa and lavapipe.
[[nodiscard]] run_outcome run_gl(const run_inputs& in, const std::string& device, bool fragment);
[[nodiscard]] run_outcome run_vk(const run_inputs& in, const std::string& device);

} // namespace ao::tools
