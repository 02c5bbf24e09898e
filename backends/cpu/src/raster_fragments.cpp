#include "raster_fragments.hpp"

#include <algorithm>

namespace ao::cpu {

using shared = math<float>;

raster_surface::raster_surface(const raster_frame& frame, const raster_triangle& t)
    : triangle_(&t),
      object_(&frame.model.objects[t.slot]),
      variant_(&frame.model.variants[object_->variant])
{
    const raster_model_state& m = frame.model;
    const gbuffer_facts& f = m.facts;
    const geometry_camera& camera = frame.view.camera;
    const geometry_instance& instance = object_->instance;
    std::array<glm::vec4, 3> clip;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = m.vertex(*object_, t.first_index, i);
        const auto at = m.attribute<glm::vec3>(position_attribute, vertex);
        positions_[i] = shared::ao_vertex_position(camera.view, instance.model, at);
        clip[i] = shared::ao_vertex_clip(camera.clip, camera.clip_w, positions_[i]);
        if (reads_normals(*variant_, f)) {
            normals_[i] = shared::ao_vertex_normal(camera.view, instance.model, m.attribute<glm::vec3>(normal_attribute, vertex));
        }
        if (reads_tangents(*variant_)) {
            tangents_[i] = shared::ao_vertex_tangent(camera.view, instance, m.attribute<glm::vec4>(tangent_attribute, vertex));
        }
        if (variant_->uvs) {
            uvs_[i] = m.attribute<glm::vec2>(uv_attribute, vertex);
        }
        if (f.motion) {
            const auto before = variant_->deforming ? m.attribute<glm::vec3>(previous_attribute, vertex) : at;
            previous_[i] = shared::ao_vertex_position(camera.previous_view, m.previous_models[t.slot], before);
        }
    }
    planes_ = corner_weights(frame.view, clip);
}

// From `here` to what the triangle's plane has at a pixel, times `direction`.
glm::vec2 raster_surface::difference(const glm::vec2& here, int x, int y, float direction) const
{
    const glm::dvec3 w = planes_.at(x, y);
    const double total = w.x + w.y + w.z;
    // At and beyond the horizon: longer than any picture is wide, with a square that is finite.
    constexpr float far_away = 1e15F;
    if (!(total > 0)) {
        return glm::vec2(far_away);
    }
    glm::dvec2 there(0.0);
    for (int i = 0; i < 3; ++i) {
        const glm::vec2& uv = uvs_[static_cast<std::size_t>(i)];
        there.x += w[i] / total * static_cast<double>(uv.x);
        there.y += w[i] / total * static_cast<double>(uv.y);
    }
    const auto single = [](double v) { return static_cast<float>(std::clamp(v, -1e15, 1e15)); };
    return { (single(there.x) - here.x) * direction, (single(there.y) - here.y) * direction };
}

raster_pass::ao_map_place raster_surface::place(int x, int y, const glm::vec3& weights) const
{
    const glm::vec2 uv = sum(uvs_, weights);
    const glm::vec2 along_x = difference(uv, x ^ 1, y, (x & 1) != 0 ? -1.0F : 1.0F);
    const glm::vec2 along_y = difference(uv, x, y ^ 1, (y & 1) != 0 ? -1.0F : 1.0F);
    return raster_pass::ao_place_of(uv, along_x, along_y);
}

} // namespace ao::cpu
