#include "ao/facts.hpp"

#include "ao/look.hpp"
#include "ao/outcome.hpp"
#include "ao/result_text.hpp"
#include "ao/scene_input.hpp"
#include "scene/files.hpp"
#include "scene/gbuffer.hpp"
#include "scene/motion.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace ao::tools {
namespace {

// Materials of a tree of blends are used, too: all of the scene's count where there are blends.
void look_at_materials(scene_facts& f, const tools::scene& s)
{
    std::vector<int> used = materials_of_objects(s);
    f.objects = used.size();
    f.blends = s.blends.size();
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::size_t i = 0; i < s.materials.size(); ++i) {
        if (s.blends.empty() && !std::binary_search(used.begin(), used.end(), static_cast<int>(i)))
            continue;
        const ao::standard_material& m = s.materials[i];
        ++f.materials;
        f.alpha_maps += m.alpha_map >= 0 ? 1u : 0u;
        f.normal_maps += m.normal_map >= 0 ? 1u : 0u;
        f.reflection_maps += m.reflection_map >= 0 ? 1u : 0u;
    }
}

void look_at_motion(scene_facts& f, const render_options& o, const tools::scene& s, const tools::camera& c)
{
    f.motion = "none";
    if (!o.temporal)
        return;
    const motion moves = choose_motion(
        o.temporal->motion, { s, c, bundled(o.scene) && moves_courtyard(o.temporal->motion), o.frames, o.size.height });
    f.motion = o.temporal->motion;
    f.moves_camera = moves.moves_camera();
    f.moves_objects = moves.moves_objects();
}

} // namespace

scene_facts facts_of(const render_options& o)
{
    const scene_input input(o);
    const bounds b = bounds_of(input.model);
    const tools::camera c = choose_camera(o, b);
    const tools::frustum frustum = choose_frustum(o, c, clip_range(b, c), distance_to_middle(c, b));
    const ray_tree tree(input.model);
    const gbuffer g = trace_gbuffer(input.model, tree, c, frustum, o.size.width, o.size.height);
    stop_if_interrupted();

    scene_facts f;
    f.triangles = input.model.triangles.size();
    look_at_materials(f, input.model);
    look_at_motion(f, o, input.model, c);
    f.pixels = g.size();
    const class_settings settings{ o.settings.radius, focal_of(frustum, o.size.width), frustum.orthographic };
    const std::vector<pixel_class> classes = classify(g, settings);
    f.classes = count_classes(classes);
    f.jumps = count_jumps(g, settings);
    for (std::size_t i = 0; i < g.size(); ++i) {
        if (g.hit[i] == 0)
            continue;
        f.nearest = f.nearest == 0.0f ? g.depth[i] : std::min(f.nearest, g.depth[i]);
        f.farthest = std::max(f.farthest, g.depth[i]);
    }
    if (f.farthest > 0.0f) {
        const auto pixels = [&](float depth) {
            return o.settings.radius * settings.focal / (frustum.orthographic ? 1.0f : depth);
        };
        f.least_radius = pixels(f.farthest);
        f.greatest_radius = pixels(f.nearest);
    }
    return f;
}

std::string text_of(const scene_facts& f)
{
    std::string text;
    const auto line = [&](const char* name, const std::string& value) {
        char row[160];
        std::snprintf(row, sizeof row, "%-18s %s\n", name, value.c_str());
        text += row;
    };
    const auto number = [](std::size_t n) { return std::to_string(n); };
    const auto share = [&](std::size_t n) {
        char row[64];
        std::snprintf(row, sizeof row, "%.2f %%", 100.0 * static_cast<double>(n) / static_cast<double>(f.pixels));
        return std::string(row);
    };
    line("triangles", number(f.triangles));
    line("objects", number(f.objects));
    line("materials", number(f.materials) + " (" + number(f.alpha_maps) + " with alpha maps, " + number(f.normal_maps) +
                          " with normal maps, " + number(f.reflection_maps) + " with reflection maps), " + number(f.blends) +
                          " blends");
    line("motion", f.motion + (f.motion == "none" ? ""
                                                  : std::string(f.moves_camera ? ", camera" : ", camera stands") +
                                                        (f.moves_objects ? ", objects" : ", objects stand")));
    if (f.farthest > 0.0f) {
        line("eye depth", tools::text(f.nearest) + " to " + tools::text(f.farthest));
        line("radius", tools::text(f.least_radius) + " to " + tools::text(f.greatest_radius) + " pixels");
    }
    line("depth jumps", share(f.jumps));
    for (std::size_t i = 0; i < f.classes.size(); ++i)
        if (static_cast<pixel_class>(i) != pixel_class::disoccluded)
            line(name_of(static_cast<pixel_class>(i)), share(f.classes[i]));
    return text;
}

std::string json_of(const scene_facts& f, const render_options& o)
{
    nlohmann::ordered_json j = { { "scene", o.scene },
                                 { "size", { o.size.width, o.size.height } },
                                 { "radius", o.settings.radius },
                                 { "triangles", f.triangles },
                                 { "objects", f.objects },
                                 { "materials", f.materials },
                                 { "alpha_maps", f.alpha_maps },
                                 { "normal_maps", f.normal_maps },
                                 { "reflection_maps", f.reflection_maps },
                                 { "blends", f.blends },
                                 { "motion", f.motion },
                                 { "moves_camera", f.moves_camera },
                                 { "moves_objects", f.moves_objects },
                                 { "pixels", f.pixels },
                                 { "eye_depth", { f.nearest, f.farthest } },
                                 { "radius_pixels", { f.least_radius, f.greatest_radius } },
                                 { "jump_pixels", f.jumps } };
    for (std::size_t i = 0; i < f.classes.size(); ++i)
        if (static_cast<pixel_class>(i) != pixel_class::disoccluded)
            j["class_pixels"][name_of(static_cast<pixel_class>(i))] = f.classes[i];
    return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void print_facts(const render_options& o)
{
    if (!o.json.empty())
        check_writable(o.json);
    const scene_facts f = facts_of(o);
    if (!o.json.empty())
        write_file(o.json, json_of(f, o));
    std::fputs(text_of(f).c_str(), stdout);
    if (std::fflush(stdout) != 0)
        throw error("cannot write to the standard output");
}

} // namespace ao::tools
