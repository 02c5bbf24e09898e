#pragma once

#include "ao/options.hpp"
#include "ao/runs.hpp"
#include "scene/gbuffer.hpp"
#include "scene/report.hpp"
#include "scene/truth.hpp"

namespace ao::tools {

// All that one `ao render` found out.
struct render_result {
    render_options options;
    std::size_t triangles = 0;
    std::size_t degenerate = 0;
    tools::camera camera;
    tools::frustum frustum;
    gbuffer g;
    std::vector<run_outcome> runs;
    std::optional<truth_halves> truth;
};

// The numbers; no pictures yet.
[[nodiscard]] report_data tables_of(const render_result& r);

// Ends in a newline.
[[nodiscard]] std::string json_of(const render_result& r);

// All pictures and report.html. Stops between two files when interrupted. Throws `error`.
void write_pictures(const render_result& r, report_data tables);

} // namespace ao::tools
