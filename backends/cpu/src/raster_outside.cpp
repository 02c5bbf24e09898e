#include "raster_outside.hpp"

#include <algorithm>
#include <cmath>

namespace ao::cpu {

namespace {

// |m| applied to |p|, translation included.
glm::dvec3 magnitude(const affine_map& m, const glm::dvec3& p)
{
    const auto row = [&](const glm::vec4& r) {
        const glm::dvec4 d(r);
        return std::abs(d.x) * p.x + std::abs(d.y) * p.y + std::abs(d.z) * p.z + std::abs(d.w);
    };
    return { row(m.x), row(m.y), row(m.z) };
}

} // namespace

unsigned classify(const raster_view& v, const glm::vec4& c)
{
    const auto usable = [](float x) { return x >= -most_clip && x <= most_clip; };
    if (!usable(c.x) || !usable(c.y) || !usable(c.z) || !usable(c.w)) {
        return not_usable;
    }
    unsigned code = 0;
    code |= c.x < -c.w ? left_side : 0U;
    code |= c.x > c.w ? right_side : 0U;
    code |= c.y < -c.w ? lower_side : 0U;
    code |= c.y > c.w ? upper_side : 0U;
    code |= c.z < (v.zero_to_one ? 0.0F : -c.w) ? before_near : 0U;
    code |= c.z > c.w ? behind_far : 0U;
    code |= v.in_guard_band(c) ? 0U : beyond_guard;
    return code;
}

bool unseen(const raster_view& v, const geometry_instance& o, const triangle_cluster& c)
{
    glm::dvec3 size;
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = static_cast<double>(std::max(std::abs(c.low[axis]), std::abs(c.high[axis])));
    }
    const glm::dvec3 in_view = magnitude(v.camera.view, magnitude(o.model, size));
    const glm::dvec3 clip = magnitude(v.camera.clip, in_view);
    const double w =
        std::abs(static_cast<double>(v.camera.clip_w.z)) * in_view.z + std::abs(static_cast<double>(v.camera.clip_w.w));
    // Three matrices with four terms each: less than 32 roundings of 2^-24 on either side of a comparison.
    const double slack = 4e-6 * (std::max(std::max(clip.x, clip.y), clip.z) + w);
    unsigned all = ~0U;
    for (unsigned i = 0; i < 8 && all != 0; ++i) {
        const glm::vec3 corner((i & 1U) != 0 ? c.high.x : c.low.x, (i & 2U) != 0 ? c.high.y : c.low.y,
                               (i & 4U) != 0 ? c.high.z : c.low.z);
        const glm::dvec4 at(v.clip_position(o, corner));
        unsigned code = 0;
        code |= at.x < -at.w - slack ? left_side : 0U;
        code |= at.x > at.w + slack ? right_side : 0U;
        code |= at.y < -at.w - slack ? lower_side : 0U;
        code |= at.y > at.w + slack ? upper_side : 0U;
        code |= at.z < (v.zero_to_one ? 0.0 : -at.w) - slack ? before_near : 0U;
        code |= at.z > at.w + slack ? behind_far : 0U;
        all &= code;
    }
    return all != 0;
}

} // namespace ao::cpu
