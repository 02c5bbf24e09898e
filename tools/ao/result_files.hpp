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
    std::vector<std::string> warnings;
    std::vector<std::string> missing_textures;
    ao::gbuffer_facts targets;
    std::vector<ao::draw_variant> variants; // in use, of raster
    std::optional<ao::shade_plan> shading;
    std::optional<gbuffer> rays; // with --gbuffer rays, or for the truth
    all_outcomes outcomes;
    std::vector<shown_surfaces> surfaces; // of each scene's outcome; one where there is none
    std::optional<truth_halves> truth;
};

// Pixels that both a run and the rays saw a surface in. Precondition: there are rays.
[[nodiscard]] std::vector<std::uint8_t> compared_pixels(const render_result& r, const run_outcome& run);

// The numbers; no pictures yet.
[[nodiscard]] report_data tables_of(const render_result& r);

// Ends in a newline.
[[nodiscard]] std::string json_of(const render_result& r);

// All pictures and report.html. Stops between two files when interrupted. Throws `error`.
void write_pictures(const render_result& r, report_data tables);

} // namespace ao::tools
