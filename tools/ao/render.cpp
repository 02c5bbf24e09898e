#include "ao/render.hpp"

#include "ao/look.hpp"
#include "ao/outcome.hpp"
#include "ao/ray_pictures.hpp"
#include "ao/result_files.hpp"
#include "ao/runs.hpp"
#include "ao/scene_input.hpp"
#include "ao/view.hpp"
#include "scene/files.hpp"
#include "scene/gbuffer.hpp"
#include "scene/truth.hpp"

#include <cstdio>

namespace ao::tools {
namespace {

ao::shade_plan plan_shading(const render_options& o, const ao::scene& s, const ao::shade_camera& camera)
{
    auto plan = make_shade_plan(s, shade_facts_of(o), camera);
    if (!plan)
        throw error(std::string(plan.error().reason()));
    return std::move(*plan);
}

run_inputs make_inputs(const render_options& o, const scene_input& input, const tools::view& seen)
{
    run_inputs in;
    in.settings = o.settings;
    in.facts = o.inputs;
    in.frames = o.frames;
    in.view = seen;
    in.scene = input.drawn.get();
    if (o.shade)
        in.shading = plan_shading(o, in.scene, seen.shading);
    in.targets = targets_of(o, in.scene, in.shading ? &*in.shading : nullptr);
    if (o.shade || o.rays || o.reference > 0) {
        auto heap = make_texel_heap(in.scene.textures);
        if (!heap)
            throw error(std::string(heap.error().reason()));
        in.heap = std::move(*heap);
    }
    return in;
}

// The pictures of rays for all backends.
void use_rays(run_inputs& in, const scene_input& input, const render_result& r)
{
    const tools::gbuffer& g = *r.rays;
    in.pictures = pictures_of_rays(input.model, in.scene, g, r.camera, r.frustum, in.targets, in.view.effect.projection);
    if (in.facts.depth == depth_source::linear)
        in.linear_depth =
            pack_depth(g.depth, g.width, g.height, in.facts.depth, in.facts.depth_format, in.view.effect.projection);
}

void describe(render_result& r, const run_inputs& in, const scene_input& input)
{
    r.triangles = input.model.triangles.size();
    r.degenerate = count_degenerate(input.model);
    r.warnings = input.model.warnings;
    r.missing_textures = input.missing_textures();
    r.targets = in.targets;
    if (in.shading)
        r.shading = *in.shading;
    if (r.options.rays)
        return;
    const auto plan = plan_drawing(in.scene, in.targets);
    if (!plan)
        throw error(std::string(plan.error().reason()));
    r.variants = plan->variants;
}

void compute_truth(render_result& r, const scene_input& input, const ray_tree& tree)
{
    const render_options& o = r.options;
    progress_line progress("truth", o.progress);
    r.truth = trace_truth(input.model, tree, r.camera, *r.rays, { o.settings.radius, o.reference, o.settings.seed },
                          &interrupted(), [&](double share) { progress.update(share); });
    stop_if_interrupted();
}

} // namespace

void render(const render_options& o)
{
    // What can fail at once fails before the work.
    if (!o.out.empty())
        make_directory(o.out);
    if (!o.json.empty())
        check_writable(o.json);

    const scene_input input(o);
    const bounds b = bounds_of(input.model);
    render_result result;
    result.options = o;
    result.camera = choose_camera(o, b);
    result.frustum = choose_frustum(o, result.camera, clip_range(b, result.camera), distance_to_middle(result.camera, b));
    const tools::view seen = make_view(o, result.camera, result.frustum);
    run_inputs in = make_inputs(o, input, seen);
    describe(result, in, input);
    stop_if_interrupted();

    std::optional<ray_tree> tree;
    if (o.rays || o.reference > 0) {
        tree.emplace(input.model);
        result.rays = trace_gbuffer(input.model, *tree, result.camera, result.frustum, o.size.width, o.size.height);
        // So that the truth is of the normals that the effect sees.
        apply_normal_maps(*result.rays, input.model, in.scene, in.heap, result.camera, result.frustum);
        stop_if_interrupted();
    }
    if (o.rays)
        use_rays(in, input, result);
    result.outcomes = run_all(o, in);
    for (const scene_outcome& each : result.outcomes.scenes)
        result.surfaces.push_back(o.rays ? show(*result.rays) : show(each.drawn, in.targets, seen.effect.projection));
    if (result.surfaces.empty())
        result.surfaces.push_back(show(*result.rays));
    if (o.reference > 0)
        compute_truth(result, input, *tree);

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
