#pragma once

#include "ao/options.hpp"
#include "scene/camera.hpp"

namespace ao::tools {

// Where the options put the camera; without them where all of the scene is in view.
[[nodiscard]] camera choose_camera(const render_options& o, const bounds& b);

// `distance`: where a parallel projection shows what perspective would.
[[nodiscard]] frustum choose_frustum(const render_options& o, const camera& c, depth_range range, float distance);

// From the eye to the middle of the scene.
[[nodiscard]] float distance_to_middle(const camera& c, const bounds& b);

} // namespace ao::tools
