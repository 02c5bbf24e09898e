#include "ao/temporal_render.hpp"

#include "ao/outcome.hpp"
#include "ao/scene_input.hpp"
#include "scene/files.hpp"

#include <cstdio>

namespace ao::tools {

void render_temporal(const render_options& o)
{
    // What can fail at once fails before the work.
    if (!o.out.empty())
        make_directory(o.out);
    if (!o.json.empty())
        check_writable(o.json);

    scene_input input(o);
    temporal_frames frames(o, input);
    stop_if_interrupted();
    temporal_result result;
    result.options = o;
    result.triangles = input.model.triangles.size();
    result.degenerate = count_degenerate(input.model);
    result.warnings = input.model.warnings;
    result.missing_textures = input.missing_textures();
    result.objects_move = frames.objects_move();
    result.camera = frames.camera();
    result.frustum = frames.frustum();
    result.targets = frames.targets();
    result.outcomes = run_temporal(o, frames);

    const report_data data = tables_of(result);
    if (!o.out.empty())
        write_pictures(result, data);
    if (!o.json.empty())
        write_file(o.json, json_of(result));
    std::fputs(make_table(data).c_str(), stdout);
    if (std::fflush(stdout) != 0)
        throw error("cannot write to the standard output");
}

} // namespace ao::tools
