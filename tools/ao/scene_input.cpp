#include "ao/scene_input.hpp"

#include "ao/scene_check.hpp"
#include "scene/blend_file.hpp"
#include "scene/courtyard.hpp"
#include "scene/error.hpp"
#include "scene/lights_file.hpp"
#include "scene/load.hpp"
#include "scene/motion.hpp"
#include "scene/picture_files.hpp"

#include <algorithm>

namespace ao::tools {
namespace {

// Never sRGB: a mask holds weights.
int add_mask(tools::scene& s, const std::string& path)
{
    picture mask;
    try {
        mask = read_picture(path);
    } catch (const error& e) {
        throw error(path + ": " + e.what());
    }
    scene_texture t;
    t.name = path;
    t.width = mask.width;
    t.height = mask.height;
    t.rgba = std::move(mask.rgba);
    s.textures.push_back(std::move(t));
    return static_cast<int>(s.textures.size()) - 1;
}

void add_blends(tools::scene& s, const std::string& path)
{
    const blend_file f =
        load_blends(path, { s.object_names, s.material_names }, [&](const std::string& mask) { return add_mask(s, mask); });
    // The model may have blends of its own; the file's come behind them.
    const int before = static_cast<int>(s.blends.size());
    const auto moved = [&](int material) { return material < 0 ? material - before : material; };
    std::vector<int> used = materials_of_objects(s);
    for (std::size_t i = 0; i < used.size(); ++i) {
        const bool plain = used[i] >= 0 && static_cast<std::size_t>(used[i]) < f.of_material.size();
        const int by_material = plain ? f.of_material[static_cast<std::size_t>(used[i])] : blend_file::as_is;
        const int chosen = f.of_object[i] != blend_file::as_is ? f.of_object[i] : by_material;
        used[i] = chosen != blend_file::as_is ? moved(chosen) : used[i];
    }
    s.object_material = std::move(used);
    for (ao::blend_node node : f.nodes) {
        node.first = moved(node.first);
        node.second = moved(node.second);
        s.blends.push_back(node);
    }
}

tools::scene load(const render_options& o)
{
    const bool animated = o.temporal && moves_courtyard(o.temporal->motion);
    tools::scene s = bundled(o.scene) ? courtyard(animated) : load_model(o.scene);
    if (!o.blend.empty())
        add_blends(s, o.blend);
    return s;
}

} // namespace

bool bundled(const std::string& name)
{
    return name == "courtyard";
}

scene_input::scene_input(const render_options& o) : model(load(o)), drawn(model)
{
    if (o.shade) {
        scene_lights lights = choose_lights(o.lights);
        drawn.set_lights(std::move(lights.lights), lights.ambient);
    }
    if (const auto wrong = ao::validate(drawn.get()))
        throw error(o.scene + ": " + one_line(std::string(wrong->reason())));
}

std::vector<std::string> scene_input::missing_textures() const
{
    std::vector<std::string> names;
    for (const scene_texture& t : model.textures)
        if (t.missing && std::find(names.begin(), names.end(), t.name) == names.end())
            names.push_back(t.name);
    return names;
}

} // namespace ao::tools
