#pragma once

#include "ao/plan.hpp"
#include "ao/temporal_options.hpp"
#include "scene/camera.hpp"
#include "scene/images.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace ao::tools {

// Words of --projection, separated by commas.
struct projection_choice {
    projection_options options;
    bool infinite = false; // far plane
};

// What `ao render` was asked for, each value already known to make sense by itself.
struct render_options {
    std::string scene; // a path, or the name of the bundled scene
    bool cpu = true;
    bool gl = true;
    bool vk = true;
    bool gl_compute = true;
    bool gl_fragment = true;
    std::string device; // part of a name; empty: the software drivers
    int lanes = 0;      // of the cpu backend: 0 the widest, 1 scalar, 4, 8, 16
    ao::settings settings;
    facts inputs;      // parallel set from the projection
    bool rays = false; // where the G-buffer comes from; else each backend draws its own
    bool shade = false;
    std::string blend;              // file, empty: none
    std::string lights = "default"; // default, none, or a file
    extent size{ 1280, 720 };
    std::optional<glm::vec3> eye;
    float yaw = 0;
    float pitch = 0;
    std::optional<float> fov;
    projection_choice projection;
    unsigned reference = 0; // rays per pixel, 0: none
    int frames = 5;         // timed, or of the animation
    std::optional<temporal_choice> temporal;
    std::filesystem::path out;  // empty: no files
    std::filesystem::path json; // empty: none
    bool progress = false;
};

// Adds the subcommand's options; `read` is what they are parsed into.
struct render_arguments {
    std::string scene, backend = "all", device, route = "all", lanes = "auto", method, preset, depth;
    std::string normals = "rgba16f", size = "1280x720", eye, projection = "perspective", out, json, thickness;
    std::string gbuffer = "raster", blend, lights, resolution;
    std::optional<int> taps, slices, filter;
    std::optional<double> bias;
    int frames = 5;
    long long seed = 1, reference = 0;
    double radius = 1.0, yaw = 0.0, pitch = 0.0, fov = 0.0;
    bool has_yaw = false, has_pitch = false, has_fov = false, has_frames = false, progress = false, shade = false;
    temporal_arguments temporal;
};
void add_render_options(CLI::App& command, render_arguments& read);

// Throws `error` naming the option at fault.
[[nodiscard]] render_options check_arguments(const render_arguments& a);

} // namespace ao::tools
