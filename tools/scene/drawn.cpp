#include "drawn.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace ao::tools {
namespace {

// Triangles of each object, in the scene's order; those of object i are from first[i] to first[i + 1].
struct grouping {
    std::vector<std::size_t> first;
    std::vector<std::uint32_t> triangles;
};

grouping by_object(const scene& s)
{
    grouping g{ std::vector<std::size_t>(s.object_names.size() + 1), std::vector<std::uint32_t>(s.triangles.size()) };
    for (const std::uint32_t object : s.object)
        ++g.first[object + 1];
    for (std::size_t i = 1; i < g.first.size(); ++i)
        g.first[i] += g.first[i - 1];
    std::vector<std::size_t> next(g.first.begin(), g.first.end());
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        g.triangles[next[s.object[t]]++] = t;
    return g;
}

} // namespace

scene_view::scene_view(const tools::scene& s) : indices(3 * s.triangles.size()), materials(s.materials), blends(s.blends)
{
    const grouping g = by_object(s);
    const std::vector<int> material = materials_of_objects(s);
    for (std::size_t i = 0; i < s.object_names.size(); ++i) {
        const std::span<const std::uint32_t> triangles(g.triangles.data() + g.first[i], g.first[i + 1] - g.first[i]);
        std::uint32_t low = std::numeric_limits<std::uint32_t>::max(), high = 0;
        for (const std::uint32_t t : triangles)
            for (int corner = 0; corner < 3; ++corner) {
                low = std::min(low, s.triangles[t][corner]);
                high = std::max(high, s.triangles[t][corner]);
            }
        ao::object& o = drawn.emplace_back();
        o.mesh = static_cast<int>(i);
        o.material = material[i];
        ao::mesh& m = meshes.emplace_back();
        if (triangles.empty())
            continue;

        std::uint32_t* to = indices.data() + 3 * g.first[i];
        m.indices = { to, 3 * triangles.size() };
        for (const std::uint32_t t : triangles)
            for (int corner = 0; corner < 3; ++corner)
                *to++ = s.triangles[t][corner] - low;
        const std::size_t count = high - low + std::size_t{ 1 };
        const auto part = [&](const auto& all) { return std::span(all).subspan(low, count); };
        m.positions = part(s.positions);
        m.normals = part(s.normals);
        if (!s.uvs.empty() && (s.object_has_uvs.empty() || s.object_has_uvs[i] != 0)) {
            m.uvs = part(s.uvs);
            if (!s.tangents.empty())
                m.tangents = part(s.tangents);
        }
    }
    if (materials.empty())
        materials.resize(s.material_names.size());
    for (const scene_texture& t : s.textures)
        textures.push_back({ t.width, t.height, t.srgb, t.wrap_u, t.wrap_v, t.rgba });
}

ao::scene scene_view::get() const
{
    return { meshes, textures, materials, blends, drawn, lights, ambient };
}

void scene_view::set_lights(std::vector<ao::light> to, const ao::ambient_light& ambient_to)
{
    lights = std::move(to);
    ambient = ambient_to;
}

} // namespace ao::tools
