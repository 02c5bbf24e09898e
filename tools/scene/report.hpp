#pragma once

#include "chart.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ao::tools {

struct report_pass {
    std::string name;
    double ms = 0.0;
};

struct report_error {
    double rmse = 0.0;
    double bias = 0.0;
    double p99 = 0.0;
};

struct report_run {
    std::string backend;
    std::string device;
    std::string route;
    std::vector<report_pass> passes;
    double total_ms = 0.0;
    double first_frame_ms = 0.0;
    std::optional<report_error> error; // absent without a reference
};

// What a backend drew and shaded.
struct report_scene {
    std::string backend;
    std::string device;
    std::string route;
    std::optional<double> draw_ms;  // absent where it drew nothing
    std::string draws;              // objects, shaders and calls
    std::optional<double> shade_ms; // absent without shading
    std::string shading;            // passes and targets
};

struct report_agreement {
    std::string what;
    std::string a;
    std::string b;
    std::size_t pixels = 0;
    std::size_t differing = 0;
    std::optional<double> largest; // absent where a difference has no size
};

// The first row holds the columns' names.
struct report_table {
    std::string title;
    std::vector<std::vector<std::string>> rows;
};

struct report_picture {
    std::string name;
    std::string png; // the file's bytes
};

struct report_data {
    std::string title;
    std::vector<std::pair<std::string, std::string>> facts; // scene, size, camera, settings, in this order
    std::vector<report_run> runs;
    std::optional<report_error> best_constant; // the control beside the runs
    std::vector<report_scene> scenes;
    std::vector<report_table> tables;
    std::vector<report_chart> charts; // on the page only
    std::vector<report_agreement> agreements;
    std::vector<report_picture> pictures; // the first two face each other when the page opens
};

// One HTML page that needs nothing beside itself: no network, no other file.
[[nodiscard]] std::string make_report(const report_data& data);

// The same tables for a terminal, columns aligned, ending in a newline.
[[nodiscard]] std::string make_table(const report_data& data);

[[nodiscard]] std::string escape_html(const std::string& text);
[[nodiscard]] std::string to_base64(const std::string& bytes);

} // namespace ao::tools
