#pragma once

#include "scene/images.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ao::tools {

// What `ao chart` was asked for.
struct chart_options {
    std::string scenes; // file of views beside the bundled scene's; empty: none
    bool bundled = true;
    std::vector<std::string> methods; // empty: all
    std::vector<std::string> backends{ "cpu", "gl", "vk" };
    std::vector<int> taps{ 4, 8, 16, 32, 64 };
    extent size{ 1280, 720 };
    unsigned rays = 64; // of the truth, per pixel
    int rounds = 2;     // timed frames of each configuration, backend and view
    int frames = 20;    // of the animations; 0: none
    bool vertices = true;
    std::string device; // as of `ao render`
    std::filesystem::path out;
    std::filesystem::path json;
    bool progress = false;
};

struct chart_arguments {
    std::string scenes, methods, backends = "all", taps, size = "1280x720", device, out, json, parts = "frames,motion,vertices";
    int rays = 64, rounds = 2, frames = 20;
    bool no_bundled = false, progress = false;
};
void add_chart_options(CLI::App& command, chart_arguments& read);

// Throws `error` naming the option at fault.
[[nodiscard]] chart_options check_arguments(const chart_arguments& a);

} // namespace ao::tools
