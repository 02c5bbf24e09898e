#include "ao/explain.hpp"

#include "ao/result_text.hpp"
#include "ao/temporal.hpp"
#include "host/temporal_runner.hpp"
#include "scene/camera.hpp"
#include "scene/error.hpp"

#include <cstdio>
#include <limits>

namespace ao::tools {
namespace {

const char* name_of(image_id id)
{
    switch (id) {
    case image_id::depth:
        return "depth";
    case image_id::normal:
        return "normal";
    case image_id::visibility:
        return "visibility";
    case image_id::rotation:
        return "rotations";
    case image_id::linear_depth:
        return "eye depth";
    case image_id::raw_visibility:
        return "unfiltered visibility";
    case image_id::row_sums:
        return "row sums";
    default:
        return "";
    }
}

// The pass that estimates visibility.
ao::pass* occlusion_of(ao::plan& p)
{
    for (ao::pass& each : p.passes)
        if (each.type == pass_type::occlusion || each.type == pass_type::bitmask)
            return &each;
    return nullptr;
}

// Eye depth copied, as if it were stored in another form.
ao::plan with_linearize(const ao::plan& p)
{
    ao::plan full = p;
    full.passes = {};
    ao::pass copy;
    copy.type = pass_type::linearize;
    copy.options.affine = true;
    copy.inputs = { image_id::depth, image_id::none, image_id::none };
    copy.output = image_id::linear_depth;
    linearize_constants identity{};
    identity.scale = 1;
    identity.background = max_eye_depth;
    ao::detail::set_constants(copy, identity);
    full.passes.push_back(copy);
    for (ao::pass each : p.passes) {
        for (image_id& input : each.inputs)
            if (input == image_id::depth)
                input = image_id::linear_depth;
        full.passes.push_back(each);
    }
    full.transients.push_back({ image_id::linear_depth, pixel_format::r32f, p.facts.width, p.facts.height });
    return full;
}

// Windows of one pixel.
ao::plan with_filter(const ao::plan& p)
{
    ao::plan full = p;
    ao::pass& occlusion = *occlusion_of(full);
    occlusion.options.mark_background = true;
    occlusion.output = image_id::raw_visibility;
    filter_constants size{};
    size.width = static_cast<float>(p.facts.width);
    size.height = static_cast<float>(p.facts.height);
    ao::pass rows;
    rows.type = pass_type::filter_rows;
    rows.inputs = { image_id::raw_visibility, image_id::none, image_id::none };
    rows.output = image_id::row_sums;
    ao::detail::set_constants(rows, size);
    ao::pass columns = rows;
    columns.type = pass_type::filter_columns;
    columns.inputs = { image_id::row_sums, image_id::none, image_id::none };
    columns.output = image_id::visibility;
    full.passes.push_back(rows);
    full.passes.push_back(columns);
    full.transients.push_back({ image_id::raw_visibility, pixel_format::r32f, p.facts.width, p.facts.height });
    full.transients.push_back({ image_id::row_sums, pixel_format::rg32f, p.facts.width, p.facts.height });
    return full;
}

ao::plan with_thickness(const ao::plan& p)
{
    ao::plan full = p;
    ao::pass& occlusion = *occlusion_of(full);
    occlusion.options.limit_thickness = true;
    auto c = constants_of<occlusion_constants>(occlusion);
    c.thickness = std::numeric_limits<float>::infinity();
    ao::detail::set_constants(occlusion, c);
    return full;
}

ao::plan with_rotation(const ao::plan& p)
{
    ao::plan full = p;
    ao::pass& occlusion = *occlusion_of(full);
    occlusion.options.rotate_normals = true;
    auto c = constants_of<occlusion_constants>(occlusion);
    c.normal_to_view = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
    ao::detail::set_constants(occlusion, c);
    return full;
}

std::string cost_text(const std::optional<pixel_cost>& c)
{
    if (!c)
        return "cost not known without the Vulkan backend";
    char text[120];
    std::snprintf(text, sizeof text, "%g fetches, %g operations, %g bytes a pixel", c->fetches, c->operations, c->bytes);
    return text;
}

void add_pass(std::string& to, const char* name, const std::string& pictures, const std::optional<pixel_cost>& cost)
{
    char text[200];
    std::snprintf(text, sizeof text, "  %-15s %-52s %s\n", name, pictures.c_str(), cost_text(cost).c_str());
    to += text;
}

std::string plan_text(const ao::plan& p)
{
    std::string text;
    for (const ao::pass& each : p.passes) {
        std::string pictures;
        for (const image_id id : each.inputs) {
            if (id == image_id::none)
                continue;
            pictures += pictures.empty() ? "" : ", ";
            pictures += name_of(id);
        }
        pictures += " -> ";
        pictures += name_of(each.output);
        add_pass(text, pass_text(each.type), pictures, cost_of(p, each));
    }
    add_pass(text, "in all", "", cost_of(p));
    return text;
}

ao::camera any_camera(const render_options& o)
{
    tools::frustum f;
    f.orthographic = o.projection.options.parallel;
    const auto wide = [](float x) { return static_cast<double>(x); };
    ao::camera c;
    c.projection = make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) },
                                   o.projection.options);
    return c;
}

std::string explain_single(const render_options& o)
{
    const auto plan = make_plan(o.settings, o.inputs, any_camera(o));
    if (!plan)
        throw error(std::string(plan.error().reason()));
    std::string text = "Passes, " + size_text(o.size) + ":\n" + plan_text(*plan) + "Left out, without changing a bit:\n";
    const std::vector<elimination> all = eliminations_of(*plan);
    for (const elimination& each : all)
        text += "  " + each.what + ": " + each.reason + "; saves " + cost_text(each.saved) + "\n";
    if (all.empty())
        text += "  nothing: these settings and facts need it all\n";
    return text;
}

std::string steps_text(const temporal_plan& p, const temporal_frame& frame, int samples)
{
    std::string text;
    for (const std::size_t& step : frame.steps)
        add_pass(text, host::name(p.steps[step].type), p.steps[step].options.reproject ? "with reprojection" : "",
                 cost_of(p, { &step, 1 }, samples));
    if (frame.steps.empty())
        text += "  nothing\n";
    return text;
}

std::string explain_temporal(const render_options& o)
{
    temporal_facts f;
    f.frame = o.inputs;
    auto plan = make_temporal_plan(o.temporal->settings, f);
    if (!plan)
        throw error(std::string(plan.error().reason()));
    const temporal_settings& s = plan->settings;
    temporal_camera camera;
    camera.projection = any_camera(o).projection;
    for (int i = 0; i < 3; ++i)
        camera.world_to_view[i][i] = 1.0f;
    temporal_state state;
    temporal_frame frame = *next_frame(*plan, state, camera);
    std::string text = "First frame:\n" + steps_text(*plan, frame, s.first_samples);
    for (int i = 1; i + 1 < frames_to_converge(s); ++i)
        frame = *next_frame(*plan, state, camera);
    text +=
        "Once nothing has moved for long (no reprojection: every point is where it was; no filter: every pixel knows enough):\n" +
        steps_text(*plan, frame, s.later_samples);
    for (int i = 0; i < 3; ++i)
        frame = *next_frame(*plan, state, camera);
    text += "Once every pixel has " + std::to_string(s.most_weight) + " samples and nothing moves:\n" +
            steps_text(*plan, frame, s.later_samples);
    camera.eye[0] += 1.0;
    frame = *next_frame(*plan, state, camera);
    text += "When the camera moves (no motion picture, no test of neighbours: objects stand):\n" +
            steps_text(*plan, frame, s.later_samples);
    f.motion = true;
    plan = make_temporal_plan(o.temporal->settings, f);
    state = {};
    (void)*next_frame(*plan, state, camera);
    frame = *next_frame(*plan, state, camera);
    text += "When objects may move:\n" + steps_text(*plan, frame, s.later_samples);
    return text;
}

} // namespace

std::vector<elimination> eliminations_of(const ao::plan& p)
{
    std::vector<elimination> all;
    const std::optional<pixel_cost> cost = cost_of(p);
    const auto add = [&](const char* what, const char* reason, const ao::plan& full) {
        elimination e{ what, reason, full, cost_of(full) };
        if (e.saved && cost) {
            e.saved->passes -= cost->passes;
            e.saved->fetches -= cost->fetches;
            e.saved->operations -= cost->operations;
            e.saved->bytes -= cost->bytes;
        }
        all.push_back(std::move(e));
    };
    ao::plan copy = p;
    const ao::pass* const occlusion = occlusion_of(copy);
    if (p.facts.depth == depth_source::linear)
        add("pass linearize", "depth is eye depth already", with_linearize(p));
    if (occlusion == nullptr)
        return all;
    const bool kernel = occlusion->type == pass_type::occlusion;
    if (kernel && p.settings.filter == 1)
        add("passes filter rows and columns", "a window of one pixel is that pixel", with_filter(p));
    if (kernel && !occlusion->options.limit_thickness)
        add("far test of every tap", "nothing lies farther behind than an infinite thickness", with_thickness(p));
    if (!occlusion->options.rotate_normals && p.facts.normals != normal_source::from_depth)
        add("rotation of normals", "they are stored in view space", with_rotation(p));
    return all;
}

std::string explain(const render_options& o)
{
    return o.temporal ? explain_temporal(o) : explain_single(o);
}

} // namespace ao::tools
