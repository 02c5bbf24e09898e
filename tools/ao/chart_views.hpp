#pragma once

#include "ao/chart_options.hpp"
#include "ao/picture.hpp"
#include "ao/plan.hpp"
#include "scene/camera.hpp"
#include "scene/gbuffer.hpp"
#include "scene/paired_error.hpp"
#include "scene/pixel_classes.hpp"
#include "scene/truth.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ao::tools {

// A place to look from, as a file of scenes has it (docs/chart.md).
struct chart_place {
    std::string name;
    std::string model;                   // path, or the bundled scene's name
    std::optional<tools::camera> camera; // none: as `ao render` chooses it
    float radius = 1.0f;
};

// A JSON array of {"model", "cameras", "radius"}, or an object of cameras by models; a camera is {"name", "eye", "yaw", "pitch",
// "fov", "radius"}. Models are looked for beside the file. Throws `error`.
[[nodiscard]] std::vector<chart_place> read_places(const std::string& path);
[[nodiscard]] std::vector<chart_place> places_of(const chart_options& o);

// A model as long as places of it are charted.
struct chart_model {
    std::string path;
    tools::scene scene;
    ray_tree tree;
    explicit chart_model(const std::string& path, bool animated = false);
};

// What all configurations see from one place.
struct chart_view {
    chart_place place;
    tools::camera camera;
    tools::frustum frustum;
    ao::camera effect;
    gbuffer surfaces;
    std::vector<pixel_class> classes;
    truth_halves truth;
};
// Throws `error` when interrupted.
[[nodiscard]] chart_view look_from(const chart_place& place, const chart_model& model, const chart_options& o);
[[nodiscard]] tools::camera camera_of(const chart_place& place, const chart_model& model, const chart_options& o);
[[nodiscard]] tools::frustum frustum_of(const tools::camera& c, const chart_options& o, const depth_range& range);
[[nodiscard]] ao::camera_projection projection_of(const tools::frustum& f);

// The facts with the size of the view's pictures, and those pictures in the facts' formats.
struct chart_pictures {
    ao::facts facts;
    ao::picture depth;
    ao::picture normal; // empty where the facts want none
};
[[nodiscard]] chart_pictures pictures_of(const gbuffer& surfaces, const ao::camera_projection& projection, ao::facts facts);

// r32f or r8.
[[nodiscard]] std::vector<float> values_of(const ao::picture& visibility);

} // namespace ao::tools
