#include "ao/ray_pictures.hpp"

#include "ao/picture.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace ao::tools {
namespace {

using host::scene_picture;
using real = ao::math<double>;

// Weights of a triangle's second and third corner where a pixel's ray meets its plane.
class triangle_view {
public:
    triangle_view(const tools::scene& s, const glm::uvec3& t, const tools::camera& c, const tools::frustum& f, glm::ivec2 size)
        : corner_(s.positions[t.x]),
          first_(glm::dvec3(s.positions[t.y]) - corner_),
          second_(glm::dvec3(s.positions[t.z]) - corner_),
          normal_(glm::cross(first_, second_)),
          eye_(c.eye),
          to_world_(view_axes(c)),
          seen_(f),
          size_(size)
    {
    }

    glm::dvec2 weights(int x, int y) const
    {
        const pixel_ray ray = ray_through(seen_, x, y, size_.x, size_.y);
        const glm::dvec3 origin = eye_ + to_world_ * glm::dvec3(ray.origin_x, ray.origin_y, 0.0);
        const glm::dvec3 direction = direction_of(ray);
        const double t = glm::dot(normal_, corner_ - origin) / glm::dot(normal_, direction);
        const glm::dvec3 p = origin + direction * t - corner_;
        const double area = glm::dot(normal_, normal_);
        return { glm::dot(glm::cross(p, second_), normal_) / area, glm::dot(glm::cross(first_, p), normal_) / area };
    }
    bool front(int x, int y) const { return glm::dot(normal_, direction_of(ray_through(seen_, x, y, size_.x, size_.y))) < 0.0; }

private:
    glm::dvec3 direction_of(const pixel_ray& ray) const { return to_world_ * glm::dvec3(ray.x, ray.y, -1.0); }

    glm::dvec3 corner_, first_, second_, normal_, eye_;
    glm::dmat3 to_world_;
    const tools::frustum& seen_;
    glm::ivec2 size_;
};

template <class Vector>
auto interpolate(const std::vector<Vector>& all, const glm::uvec3& t, const glm::dvec2& w)
{
    using wide = glm::vec<Vector::length(), double>;
    return wide(all[t.x]) * (1.0 - w.x - w.y) + wide(all[t.y]) * w.x + wide(all[t.z]) * w.y;
}

struct place_on_map {
    glm::dvec2 uv;
    double footprint; // 0 where it is not finite
};

place_on_map place_of(const tools::scene& s, const glm::uvec3& t, const triangle_view& seen, int x, int y)
{
    const glm::dvec2 uv = interpolate(s.uvs, t, seen.weights(x, y));
    const double footprint = real::ao_footprint(interpolate(s.uvs, t, seen.weights(x + 1, y)) - uv,
                                                interpolate(s.uvs, t, seen.weights(x, y + 1)) - uv);
    return { uv, std::isfinite(footprint) ? footprint : 0.0 };
}

struct surface_texel {
    glm::vec4 surface{ 0.0f };
    glm::vec4 frame{ 0.0f };
};

surface_texel look(const tools::scene& s, const ao::scene& drawn, const ao::material_table& materials, const tools::gbuffer& g,
                   std::size_t i, const triangle_view& seen, const glm::dmat3& to_view)
{
    const int x = static_cast<int>(i % static_cast<std::size_t>(g.width));
    const int y = static_cast<int>(i / static_cast<std::size_t>(g.width));
    const glm::uvec3 t = s.triangles[g.triangle[i]];
    const glm::dvec2 here = seen.weights(x, y);
    const double side = seen.front(x, y) ? 1.0 : -1.0;
    const ao::object& object = drawn.objects[g.object[i]];
    const ao::mesh& mesh = drawn.meshes[static_cast<std::size_t>(object.mesh)];
    const ao::material_needs& needs = materials[object.material];

    surface_texel out;
    out.surface.w = static_cast<float>(side);
    if (mesh.uvs.empty())
        return out;
    const place_on_map place = place_of(s, t, seen, x, y);
    out.surface = { place.uv, place.footprint, side };
    if (mesh.tangents.empty() || !needs.frame)
        return out;
    const glm::dvec4 tangent = interpolate(s.tangents, t, here);
    const glm::dvec3 n = to_view * interpolate(s.normals, t, here);
    const glm::dvec3 along = to_view * glm::dvec3(tangent);
    const double handedness = tangent.w < 0.0 ? -1.0 : 1.0;
    out.frame = ao::math<float>::ao_packed_frame(glm::normalize(n), along, static_cast<float>(handedness));
    return out;
}

} // namespace

picture_set pictures_of_rays(const tools::scene& s, const ao::scene& drawn, const tools::gbuffer& g, const tools::camera& c,
                             const tools::frustum& seen, const ao::gbuffer_facts& f, const ao::camera_projection& projection)
{
    picture_set p;
    p[scene_picture::depth] = pack_depth(g.depth, g.width, g.height, depth_source::hardware, f.depth_format, projection);
    if (f.position)
        p[scene_picture::position] =
            pack_depth(g.depth, g.width, g.height, depth_source::position, f.position_format, projection);
    ao::picture& ids = p[scene_picture::ids] = ao::picture(pixel_format::rg32ui, g.width, g.height);
    ao::picture& surface = p[scene_picture::surface];
    ao::picture& frame = p[scene_picture::frame];
    if (f.surface)
        surface = ao::picture(pixel_format::rgba32f, g.width, g.height);
    if (f.frame)
        frame = ao::picture(pixel_format::rgba32f, g.width, g.height);

    const ao::material_table materials(drawn);
    const glm::dmat3 to_view = glm::transpose(view_axes(c));
    for (std::size_t i = 0; i < g.size(); ++i) {
        if (g.hit[i] == 0)
            continue;
        const triangle_view triangle(s, s.triangles[g.triangle[i]], c, seen, { g.width, g.height });
        const surface_texel texel = look(s, drawn, materials, g, i, triangle, to_view);
        const auto material = static_cast<std::uint32_t>(drawn.objects[g.object[i]].material + 1);
        ids.set_texel(i, glm::uvec2(g.object[i] + 1, material));
        if (f.surface)
            surface.set_texel(i, texel.surface);
        if (f.frame)
            frame.set_texel(i, texel.frame);
    }
    if (f.normal)
        p[scene_picture::normal] = pack_normals(g.normal, g.width, g.height, f.normals, f.normal_format);
    return p;
}

void apply_normal_maps(tools::gbuffer& g, const tools::scene& s, const ao::scene& drawn, const ao::texel_heap& heap,
                       const tools::camera& c, const tools::frustum& seen)
{
    const ao::material_table materials(drawn);
    const glm::dmat3 to_view = glm::transpose(view_axes(c));
    for (std::size_t i = 0; i < g.size(); ++i) {
        if (g.hit[i] == 0)
            continue;
        const ao::object& object = drawn.objects[g.object[i]];
        const ao::mesh& mesh = drawn.meshes[static_cast<std::size_t>(object.mesh)];
        const ao::material_needs& needs = materials[object.material];
        if (!needs.normal_map || mesh.uvs.empty() || mesh.tangents.empty())
            continue;
        const glm::uvec3 t = s.triangles[g.triangle[i]];
        const triangle_view triangle(s, t, c, seen, { g.width, g.height });
        const int x = static_cast<int>(i % static_cast<std::size_t>(g.width));
        const int y = static_cast<int>(i / static_cast<std::size_t>(g.width));
        const glm::dvec2 here = triangle.weights(x, y);
        const glm::dvec4 tangent = interpolate(s.tangents, t, here);
        const ao::standard_material& m = drawn.materials[static_cast<std::size_t>(needs.geometry)];
        const glm::dvec2 repeat(m.repeat);
        const place_on_map place = place_of(s, t, triangle, x, y);
        const glm::dvec4 texel = ao::sample<double>(heap, m.normal_map, place.uv * repeat,
                                                    place.footprint * std::max(repeat.x * repeat.x, repeat.y * repeat.y));
        const glm::dvec3 mapped =
            real::ao_mapped_normal(to_view * interpolate(s.normals, t, here), to_view * glm::dvec3(tangent),
                                   tangent.w < 0.0 ? -1.0 : 1.0, glm::dvec3(texel), m.normal_green_down ? -1.0 : 1.0);
        g.normal[i] = real::ao_facing_normal(mapped, triangle.front(x, y) ? 1.0 : -1.0);
    }
}

} // namespace ao::tools
