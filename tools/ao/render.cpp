#include "ao/render.hpp"

#include "ao/result_files.hpp"
#include "ao/runs.hpp"
#include "scene/courtyard.hpp"
#include "scene/error.hpp"
#include "scene/files.hpp"
#include "scene/gbuffer.hpp"
#include "scene/load.hpp"
#include "scene/metrics.hpp"
#include "scene/signals.hpp"
#include "scene/truth.hpp"

#include <glm/geometric.hpp>

#include <cstdio>
#include <limits>

namespace ao::tools {
namespace {

void stop_if_interrupted()
{
    if (interrupted())
        throw error("interrupted");
}

bool bundled(const std::string& name)
{
    return name == "courtyard";
}

camera choose_camera(const render_options& o, const bounds& b)
{
    const float aspect = static_cast<float>(o.size.width) / static_cast<float>(o.size.height);
    camera c;
    if (o.eye) {
        c.eye = *o.eye;
        c.yaw = o.yaw;
        c.pitch = o.pitch;
        c.fov = o.fov.value_or(c.fov);
    }
    else if (bundled(o.scene)) {
        c = courtyard_camera();
        c.fov = o.fov.value_or(c.fov);
    }
    else {
        c = o.fov ? frame(b, aspect, *o.fov) : frame(b, aspect);
    }
    return c;
}

frustum choose_frustum(const render_options& o, const camera& c, const bounds& b)
{
    const float aspect = static_cast<float>(o.size.width) / static_cast<float>(o.size.height);
    depth_range range = clip_range(b, c);
    if (!o.projection.options.parallel) {
        if (o.projection.infinite)
            range.far = std::numeric_limits<float>::infinity();
        return perspective(c, aspect, range);
    }
    const float distance = glm::length((b.low + b.high) / 2.0f - c.eye);
    return orthographic(c, aspect, std::max(distance, range.near), range);
}

run_inputs make_inputs(const render_options& o, const frustum& f, const gbuffer& g)
{
    run_inputs in;
    in.settings = o.settings;
    in.facts = o.inputs;
    in.frames = o.frames;
    const auto wide = [](float x) { return static_cast<double>(x); };
    in.camera.projection = make_projection(
        { wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) }, o.projection.options);
    if (const auto planned = make_plan(in.settings, in.facts, in.camera); !planned)
        throw error(std::string(planned.error().reason()));
    in.depth = pack_depth(g.depth, g.width, g.height, in.facts.depth, in.facts.depth_format, in.camera.projection);
    if (in.facts.normals != normal_source::from_depth)
        in.normal = pack_normals(g.normal, g.width, g.height, in.facts.normals, in.facts.normal_format);
    return in;
}

} // namespace

void render(const render_options& o)
{
    // What can fail at once fails before the work.
    if (!o.out.empty())
        make_directory(o.out);
    if (!o.json.empty())
        check_writable(o.json);

    const scene s = bundled(o.scene) ? courtyard() : load_model(o.scene);
    const ray_tree tree(s);
    const bounds b = bounds_of(s);
    const camera c = choose_camera(o, b);
    const frustum f = choose_frustum(o, c, b);
    stop_if_interrupted();

    render_result result{
        o, s.triangles.size(), tree.degenerate_count(), c, f, trace_gbuffer(s, tree, c, f, o.size.width, o.size.height), {}, {}
    };
    const run_inputs in = make_inputs(o, f, result.g);
    stop_if_interrupted();
    result.runs = run_all(o, in);
    if (o.reference > 0) {
        progress_line progress("truth", o.progress);
        result.truth = trace_truth(s, tree, c, result.g, { o.settings.radius, o.reference, o.settings.seed }, &interrupted(),
                                   [&](double share) { progress.update(share); });
    }
    stop_if_interrupted();

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
