#pragma once

#include "ao/options.hpp"
#include "ao/temporal_runs.hpp"
#include "scene/report.hpp"

namespace ao::tools {

// All that one `ao render --temporal` found out.
struct temporal_result {
    render_options options;
    std::size_t triangles = 0;
    std::size_t degenerate = 0;
    std::vector<std::string> warnings;
    std::vector<std::string> missing_textures;
    bool objects_move = false;
    tools::camera camera; // of the first frame
    tools::frustum frustum;
    ao::gbuffer_facts targets;
    temporal_outcomes outcomes;
};

// The numbers; no pictures yet.
[[nodiscard]] report_data tables_of(const temporal_result& r);

// Ends in a newline.
[[nodiscard]] std::string json_of(const temporal_result& r);

// All pictures, animations and report.html. Stops between two files when interrupted. Throws `error`.
void write_pictures(const temporal_result& r, report_data tables);

// `ao render --temporal`: an animation on every backend, truth, tables, files. Throws `error`.
// Precondition: o.temporal.
void render_temporal(const render_options& o);

} // namespace ao::tools
