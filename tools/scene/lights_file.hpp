#pragma once

#include "ao/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace ao::tools {

struct scene_lights {
    std::vector<ao::light> lights;
    ao::ambient_light ambient;
};

// A sun from behind the viewer's left shoulder as scenes with Y up have it, and a bluish sky.
[[nodiscard]] scene_lights default_lights();
// Ambient light alone, white from everywhere: what is seen is material and visibility.
[[nodiscard]] scene_lights no_lights();

// Ambient light of the equirectangular picture at this path; throws `error`.
using environment_loader = std::function<ao::ambient_light(const std::string& path)>;

// A file of lights (docs/scenes.md). `name` is what errors begin with; a picture is named relative to its directory. Throws
// `error` with line, column and path.
[[nodiscard]] scene_lights parse_lights(const std::string& name, const std::string& text, const environment_loader& load);

// What --lights names: "default", "none", or a file.
[[nodiscard]] scene_lights choose_lights(const std::string& words);

} // namespace ao::tools
