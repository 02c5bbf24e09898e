#include "sweep/level_views.hpp"

#include "scene/metrics.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>

std::vector<level> levels()
{
    const char* chosen = std::getenv("AO_SCENES");
    const std::filesystem::path folder = chosen != nullptr ? chosen : AO_SCENES;
    std::ifstream file(folder / "cameras.json");
    if (!file) {
        WARN("skipped: no cameras.json in " << folder << "; AO_SCENES names another folder");
        return {};
    }
    std::vector<level> found;
    const nlohmann::json models = nlohmann::json::parse(file);
    for (const auto& [model, cameras] : models.items()) {
        if (!std::filesystem::exists(folder / model)) {
            WARN("skipped: no " << folder / model);
            continue;
        }
        level next{ folder / model, {} };
        for (const auto& c : cameras) {
            level_view v;
            v.name = c.at("name");
            v.camera.eye = { c.at("eye").at(0), c.at("eye").at(1), c.at("eye").at(2) };
            v.camera.yaw = c.at("yaw");
            v.camera.pitch = c.at("pitch");
            v.camera.fov = c.at("fov");
            v.radius = c.at("radius");
            next.views.push_back(v);
        }
        found.push_back(next);
    }
    return found;
}

level_inputs inputs_of(const ao::tools::scene& s, const ao::tools::ray_tree& tree, const level_view& view, int width, int height)
{
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const auto f = ao::tools::perspective(view.camera, aspect, ao::tools::clip_range(ao::tools::bounds_of(s), view.camera));
    level_inputs in;
    in.surfaces = ao::tools::trace_gbuffer(s, tree, view.camera, f, width, height);
    in.facts.width = width;
    in.facts.height = height;
    in.facts.depth = ao::depth_source::linear;
    in.facts.depth_format = ao::pixel_format::r32f;
    in.facts.normals = ao::normal_source::vector;
    in.facts.normal_format = ao::pixel_format::rgba16f;
    const auto wide = [](float x) { return static_cast<double>(x); };
    ao::projection_options options;
    options.rows = ao::first_row::at_ndc_plus_one;
    in.camera.projection =
        ao::make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) }, options);
    in.depth = ao::pack_depth(in.surfaces.depth, width, height, in.facts.depth, in.facts.depth_format, in.camera.projection);
    in.normal = ao::pack_normals(in.surfaces.normal, width, height, in.facts.normals, in.facts.normal_format);
    return in;
}

const char* name_of(ao::method method)
{
    return method == ao::method::box ? "box" : method == ao::method::hemisphere ? "hemisphere" : "halton";
}

std::vector<float> agreed_picture(const std::vector<ao::host::runner*>& runners, const ao::settings& s, const level_inputs& in)
{
    std::vector<float> first;
    for (ao::host::runner* r : runners) {
        INFO(r->name() << " beside " << runners.front()->name() << ": " << name_of(s.method) << ", " << s.taps
                       << " taps, thickness " << s.thickness);
        auto drawn = r->run(s, in.facts, in.camera, in.depth, in.normal);
        INFO((drawn ? std::string() : std::string(drawn.error().reason())));
        REQUIRE(drawn);
        std::vector<float> values(drawn->pixels());
        REQUIRE(drawn->bytes.size() == values.size() * sizeof(float));
        std::memcpy(values.data(), drawn->bytes.data(), drawn->bytes.size());
        if (first.empty()) {
            first = values;
            const auto [low, high] = std::minmax_element(first.begin(), first.end());
            CHECK(*low >= 0.0f);
            CHECK(*high <= 1.0f);
            CHECK(*high - *low > 0.25f);
        }
        const ao::tools::agreement same = ao::tools::agreement_of(first, values);
        CHECK(same.pixels == in.surfaces.size());
        CHECK(same.differing == 0);
    }
    return first;
}
