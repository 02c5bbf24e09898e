#pragma once

#include "ao/options.hpp"
#include "scene/drawn.hpp"
#include "scene/scene.hpp"

namespace ao::tools {

[[nodiscard]] bool bundled(const std::string& name);

// The model or the bundled scene, with the blends and lights that were asked for. Throws `error`, also for what ao::validate
// refuses.
struct scene_input {
    explicit scene_input(const render_options& o);

    tools::scene model;
    scene_view drawn; // of `model`
    [[nodiscard]] std::vector<std::string> missing_textures() const;
};

} // namespace ao::tools
