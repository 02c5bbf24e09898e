#include "ao/look.hpp"

#include "ao/scene_input.hpp"
#include "scene/courtyard.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace ao::tools {

camera choose_camera(const render_options& o, const bounds& b)
{
    const float aspect = static_cast<float>(o.size.width) / static_cast<float>(o.size.height);
    camera c;
    if (o.eye) {
        c.eye = *o.eye;
        c.yaw = o.yaw;
        c.pitch = o.pitch;
        c.fov = o.fov.value_or(c.fov);
    }
    else if (bundled(o.scene)) {
        c = courtyard_camera();
        c.fov = o.fov.value_or(c.fov);
    }
    else {
        c = o.fov ? frame(b, aspect, *o.fov) : frame(b, aspect);
    }
    return c;
}

frustum choose_frustum(const render_options& o, const camera& c, depth_range range, float distance)
{
    const float aspect = static_cast<float>(o.size.width) / static_cast<float>(o.size.height);
    if (!o.projection.options.parallel) {
        if (o.projection.infinite)
            range.far = std::numeric_limits<float>::infinity();
        return perspective(c, aspect, range);
    }
    return orthographic(c, aspect, std::max(distance, range.near), range);
}

float distance_to_middle(const camera& c, const bounds& b)
{
    return glm::length((b.low + b.high) / 2.0f - c.eye);
}

} // namespace ao::tools
