#include "ao/chart_views.hpp"

#include "ao/outcome.hpp"
#include "ao/ray_pictures.hpp"
#include "ao/texture.hpp"
#include "scene/courtyard.hpp"
#include "scene/drawn.hpp"
#include "scene/json_file.hpp"
#include "scene/load.hpp"

#include <cstring>

namespace ao::tools {
namespace {

constexpr const char* bundled_name = "courtyard";

chart_place read_camera(const json_value& v, const std::string& model, float radius)
{
    v.allow({ "name", "eye", "yaw", "pitch", "fov", "radius" });
    chart_place place;
    place.name = v.at("name").string();
    place.model = model;
    place.radius = radius;
    tools::camera c;
    const std::vector<float> eye = v.at("eye").numbers(3);
    c.eye = { eye[0], eye[1], eye[2] };
    const auto set = [&](const char* name, float& to, double low, double high) {
        if (const auto found = v.find(name))
            to = found->number(low, high);
    };
    set("yaw", c.yaw, -1e6, 1e6);
    set("pitch", c.pitch, -90, 90);
    set("fov", c.fov, 0.1, 179);
    set("radius", place.radius, 1e-6, 1e15);
    place.camera = c;
    return place;
}

void add_model(std::vector<chart_place>& all, const std::filesystem::path& folder, const std::string& model,
               const std::optional<json_value>& cameras, float radius)
{
    const std::string path = (folder / model).string();
    if (!cameras) {
        all.push_back({ std::filesystem::path(model).stem().string(), path, std::nullopt, radius });
        return;
    }
    for (const json_value& c : cameras->children())
        all.push_back(read_camera(c, path, radius));
}

// So that the truth is of the normals that the effect sees.
void apply_maps(gbuffer& g, const tools::scene& s, const tools::camera& c, const tools::frustum& f)
{
    const scene_view drawn(s);
    auto heap = make_texel_heap(drawn.get().textures);
    if (!heap)
        throw error(std::string(heap.error().reason()));
    apply_normal_maps(g, s, drawn.get(), *heap, c, f);
}

tools::scene load(const std::string& path, bool animated)
{
    return path == bundled_name ? courtyard(animated) : load_model(path);
}

} // namespace

std::vector<chart_place> read_places(const std::string& path)
{
    const json_file file(path, json_file::read(path));
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::vector<chart_place> all;
    const json_value top = file.root();
    if (top.is_object()) {
        for (const json_value& cameras : top.children())
            add_model(all, folder, cameras.key(), cameras, 1.0f);
    }
    else {
        for (const json_value& each : top.children()) {
            each.allow({ "model", "cameras", "radius" });
            const auto radius = each.find("radius");
            add_model(all, folder, each.at("model").string(), each.find("cameras"), radius ? radius->number(1e-6, 1e15) : 1.0f);
        }
    }
    if (all.empty())
        throw error(path + ": no cameras");
    return all;
}

std::vector<chart_place> places_of(const chart_options& o)
{
    std::vector<chart_place> all;
    if (o.bundled)
        all.push_back({ bundled_name, bundled_name, std::nullopt, 1.0f });
    if (!o.scenes.empty())
        for (chart_place& each : read_places(o.scenes))
            all.push_back(std::move(each));
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (all[i].name == all[j].name)
                throw error("two views are named '" + one_line(all[i].name) + "'");
    return all;
}

chart_model::chart_model(const std::string& p, bool animated) : path(p), scene(load(p, animated)), tree(scene) {}

tools::camera camera_of(const chart_place& place, const chart_model& model, const chart_options& o)
{
    if (place.camera)
        return *place.camera;
    if (model.path == bundled_name)
        return courtyard_camera();
    return frame(bounds_of(model.scene), static_cast<float>(o.size.width) / static_cast<float>(o.size.height));
}

tools::frustum frustum_of(const tools::camera& c, const chart_options& o, const depth_range& range)
{
    return perspective(c, static_cast<float>(o.size.width) / static_cast<float>(o.size.height), range);
}

ao::camera_projection projection_of(const tools::frustum& f)
{
    const auto wide = [](float x) { return static_cast<double>(x); };
    projection_options options;
    options.rows = first_row::at_ndc_plus_one;
    return make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) }, options);
}

chart_view look_from(const chart_place& place, const chart_model& model, const chart_options& o)
{
    chart_view v;
    v.place = place;
    v.camera = camera_of(place, model, o);
    v.frustum = frustum_of(v.camera, o, clip_range(bounds_of(model.scene), v.camera));
    v.effect.projection = projection_of(v.frustum);
    v.surfaces = trace_gbuffer(model.scene, model.tree, v.camera, v.frustum, o.size.width, o.size.height);
    apply_maps(v.surfaces, model.scene, v.camera, v.frustum);
    v.classes = classify(v.surfaces, { place.radius, focal_of(v.frustum, o.size.width), false });
    progress_line progress("truth of " + place.name, o.progress);
    auto truth = trace_truth(model.scene, model.tree, v.camera, v.surfaces, { place.radius, o.rays, 1 }, &interrupted(),
                             [&](double share) { progress.update(share); });
    stop_if_interrupted();
    v.truth = std::move(*truth);
    return v;
}

chart_pictures pictures_of(const gbuffer& g, const ao::camera_projection& projection, ao::facts facts)
{
    chart_pictures p;
    p.facts = facts;
    p.facts.width = g.width;
    p.facts.height = g.height;
    p.depth = pack_depth(g.depth, g.width, g.height, facts.depth, facts.depth_format, projection);
    if (facts.normals != normal_source::from_depth)
        p.normal = pack_normals(g.normal, g.width, g.height, facts.normals, facts.normal_format);
    return p;
}

std::vector<float> values_of(const ao::picture& visibility)
{
    std::vector<float> values(visibility.pixels());
    if (visibility.format == pixel_format::r8) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(visibility.texel<std::uint8_t>(i)) / 255.0f;
        return values;
    }
    std::memcpy(values.data(), visibility.bytes.data(), visibility.bytes.size());
    return values;
}

} // namespace ao::tools
