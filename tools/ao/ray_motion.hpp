#pragma once

#include "ao/picture.hpp"
#include "ao/projection.hpp"
#include "scene/camera.hpp"
#include "scene/gbuffer.hpp"
#include "scene/motion.hpp"

namespace ao::tools {

// What a geometry pass would have drawn as motion of what rays saw in this frame: rgba32f, xy where the point was minus where it
// is, in pixels, z its eye depth in the last frame or 0 behind the eye. `before`: the last frame's.
struct ray_view {
    tools::camera camera;
    ao::projection_constants projection;
};
[[nodiscard]] ao::picture motion_of_rays(const tools::gbuffer& g, const ray_view& now, const ray_view& before,
                                         const motion& moves, int frame);

} // namespace ao::tools
