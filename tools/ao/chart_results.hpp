#pragma once

#include "ao/chart_configurations.hpp"
#include "ao/chart_views.hpp"
#include "ao/facts_cost.hpp"
#include "scene/metrics.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ao::tools {

// Of one configuration in one view.
struct view_error {
    paired_error truth;      // against rays
    paired_error sampling;   // against what the method converges to; no pixels where that is not known
    double p99 = 0.0;        // of |x - truth|, with what noise the truth has
    double over_tenth = 0.0; // share of pixels with more than 0.1
    std::array<paired_error, pixel_class_count> classes{};
};

// Frames of one configuration on one backend and route. Milliseconds per megapixel.
struct route_time {
    std::size_t route = 0;            // index into chart_results::routes
    double first_frame_ms = 0.0;      // with preparing; not per megapixel
    std::vector<double> ms;           // by the device's clock, or the host's around the passes
    std::vector<double> processor_ms; // of all threads of the program
    agreement same;                   // with the cpu's picture, all views together
};

struct chart_route {
    std::string name; // "cpu", "gl compute", "gl fragment", "vk"
    std::string device;
    std::string how; // as the runner calls it
};

struct single_result {
    chart_configuration configuration;
    std::optional<pixel_cost> cost;
    std::vector<view_error> errors; // by view
    std::vector<route_time> times;  // none where it is not timed
    std::vector<double> flicker;    // by place of motion_results, where it was run there
};

struct view_facts {
    chart_place place;
    tools::camera camera;
    std::size_t triangles = 0;
    std::array<std::size_t, pixel_class_count> classes{};
    double best_constant = 0.0; // its RMSE
};

// One temporal configuration over one animation, after its frames.
struct motion_error {
    std::string view;
    std::string motion;  // "static", "pan", "orbit"
    picture_error truth; // of the last frame
    std::array<paired_error, pixel_class_count> classes{};
    double flicker = 0.0; // mean of |v - v'| of surface points seen in the frame before, last frame
    double flicker_p99 = 0.0;
    double first = 0.0; // RMSE of the first frame
};

struct chart_temporal {
    temporal_configuration configuration;
    std::optional<pixel_cost> still, moving;
    std::vector<motion_error> errors;
    std::vector<route_time> still_times, moving_times;
};

struct vertex_point {
    std::string rule;
    int directions = 0;
    double rmse = 0.0;
    double estimated = 0.0; // what the bake says of itself
    struct time {
        std::string route;
        double ms = 0.0; // median
        double low = 0.0, high = 0.0;
    };
    std::vector<time> times;
};

struct vertex_results {
    std::string model;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    int truth_directions = 0;
    std::vector<vertex_point> points;
};

struct chart_results {
    chart_options options;
    std::vector<chart_route> routes;
    std::vector<view_facts> views;
    std::vector<single_result> single;
    std::vector<chart_route> temporal_routes;
    std::vector<chart_temporal> temporal;
    std::optional<vertex_results> vertices;
};

// Each adds its part. Throw `error`, also where an exact backend's picture is not the cpu's.
void chart_single_frames(chart_results& r);
void chart_motion(chart_results& r);
void chart_vertices(chart_results& r);

[[nodiscard]] std::string json_of(const chart_results& r);
// For a terminal.
[[nodiscard]] std::string table_of(const chart_results& r);

} // namespace ao::tools
