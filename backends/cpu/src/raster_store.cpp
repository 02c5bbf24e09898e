#include "raster_store.hpp"

#include "ao/half.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace ao::cpu {

namespace {

template <class T>
void put(const image_view& to, int x, int y, const T& value)
{
    std::memcpy(detail::texel_at(to, x, y), &value, sizeof value);
}

std::uint32_t code(float value, float top)
{
    return static_cast<std::uint32_t>(math<float>::ao_unorm_code(std::clamp(value, 0.0F, 1.0F), top));
}

// Positions and normals.
void put_vector(const image_view& to, int x, int y, const glm::vec4& v)
{
    switch (to.format) {
    case pixel_format::rgba16f:
        return put(
            to, x, y,
            std::array<std::uint16_t, 4>{ float_to_half(v.x), float_to_half(v.y), float_to_half(v.z), float_to_half(v.w) });
    case pixel_format::rgb10a2:
        return put(to, x, y, code(v.x, 1023) | code(v.y, 1023) << 10U | code(v.z, 1023) << 20U | code(v.w, 3) << 30U);
    case pixel_format::rg16:
        return put(to, x, y, code(v.x, 65535) | code(v.y, 65535) << 16U);
    default:
        return put(to, x, y, v);
    }
}

} // namespace

void store_surface(const raster_frame& frame, const gbuffer_images<image_view>& to, const raster_surface& surface,
                   const row_span& span)
{
    const gbuffer_facts& f = frame.model.facts;
    const draw_variant& v = surface.variant();
    const geometry_instance& object = surface.object().instance;
    const bool normals = reads_normals(v, f);
    const bool tangents = reads_tangents(v);
    const float side = surface.triangle()->front ? 1.0F : -1.0F;
    const int y = span.y;
    raster_pass pass = surface.pass(frame);
    for (int x = span.first; x < span.last; ++x) {
        const glm::vec3 w = surface.weights(x, y);
        const auto place = v.uvs ? surface.place(x, y, w) : raster_pass::ao_map_place{};
        const glm::vec3 normal = normals ? surface.normal(w) : glm::vec3(0.0F);
        const glm::vec4 tangent = tangents ? surface.tangent(w) : glm::vec4(0.0F);
        if (f.position) {
            put_vector(to.position, x, y, glm::vec4(surface.position(w), 1.0F));
        }
        if (f.normal) {
            put_vector(to.normal, x, y, pass.ao_geometry_normal(object.leaf, place, normal, tangent, side));
        }
        if (f.motion) {
            const glm::vec2 pixel(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            const glm::vec4 motion = raster_pass::ao_geometry_motion(frame.camera, surface.previous(w), pixel);
            if (to.motion.format == pixel_format::rgba32f) {
                put(to.motion, x, y, motion);
            }
            else {
                put(to.motion, x, y, glm::vec2(motion));
            }
        }
        if (f.ids) {
            put(to.ids, x, y, glm::uvec2(object.object, object.code));
        }
        if (f.surface) {
            put(to.surface, x, y, raster_pass::ao_geometry_surface(place, side));
        }
        if (f.frame) {
            put(to.frame, x, y, v.frame ? raster_pass::ao_geometry_frame(normal, tangent) : glm::vec4(0.0F));
        }
    }
}

void store_background(const gbuffer_facts& f, const gbuffer_images<image_view>& to, const row_span& span)
{
    const auto clear = [&](const image_view& target, bool wanted) {
        if (wanted) {
            const auto pixels = static_cast<std::size_t>(span.last - span.first);
            std::memset(detail::texel_at(target, span.first, span.y), 0,
                        pixels * static_cast<std::size_t>(bytes_per_pixel(target.format)));
        }
    };
    clear(to.position, f.position);
    clear(to.normal, f.normal);
    clear(to.motion, f.motion);
    clear(to.ids, f.ids);
    clear(to.surface, f.surface);
    clear(to.frame, f.frame);
}

void store_depth(const raster_view& view, const image_view& to, const row_span& span, const float* keys)
{
    for (int x = span.first; x < span.last; ++x) {
        const float depth = keys[x - span.first] * view.key_sign;
        if (to.format == pixel_format::d24) {
            put(to, x, span.y, static_cast<std::uint32_t>(depth));
        }
        else {
            put(to, x, span.y, depth + 0.0F); // no negative zero
        }
    }
}

} // namespace ao::cpu
