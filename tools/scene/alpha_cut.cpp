#include "alpha_cut.hpp"

#include "error.hpp"

#include "ao/scene_check.hpp"

#include <map>
#include <string>
#include <utility>

namespace ao::tools {

alpha_cut::alpha_cut(const scene& s) : rules(s.object_names.size(), none)
{
    if (s.materials.empty() || s.uvs.empty())
        return;
    ao::scene blends;
    blends.blends = s.blends;
    std::vector<ao::texture> textures;
    std::map<int, int> numbers;
    std::map<int, std::uint32_t> by_material;
    const std::vector<int> materials = materials_of_objects(s);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const int leaf = ao::geometry_material(blends, materials[i]);
        const ao::standard_material& m = s.materials[static_cast<std::size_t>(leaf)];
        if (m.alpha_map == ao::no_texture || (!s.object_has_uvs.empty() && s.object_has_uvs[i] == 0))
            continue;
        const auto [number, new_map] = numbers.try_emplace(m.alpha_map, static_cast<int>(textures.size()));
        if (new_map) {
            const scene_texture& t = s.textures.at(static_cast<std::size_t>(m.alpha_map));
            textures.push_back({ t.width, t.height, t.srgb, t.wrap_u, t.wrap_v, t.rgba });
        }
        const auto [rule, new_rule] = by_material.try_emplace(leaf, static_cast<std::uint32_t>(maps.size()));
        if (new_rule)
            maps.push_back({ number->second, m.repeat, m.alpha_cutoff, m.alpha_from_red });
        rules[i] = rule->second;
    }
    if (textures.empty())
        return;
    auto made = ao::make_texel_heap(textures);
    if (!made)
        throw error(s.name + ": alpha maps: " + std::string(made.error().reason()));
    heap = std::move(*made);
}

void alpha_cut::add(const scene& s, std::uint32_t triangle)
{
    const glm::uvec3 t = s.triangles[triangle];
    triangles.push_back({ { s.uvs[t.x], s.uvs[t.y], s.uvs[t.z] }, rules[s.object[triangle]] });
}

bool alpha_cut::hole(std::uint32_t number, float u, float v) const
{
    const cut_triangle& t = triangles[number];
    const map& m = maps[t.rule];
    const glm::vec2 uv = ((1.0f - u - v) * t.uvs[0] + u * t.uvs[1] + v * t.uvs[2]) * m.repeat;
    const glm::vec4 texel = ao::sample<float>(heap, m.texture, uv, 0.0f);
    return (m.red ? texel.x : texel.w) < m.cutoff;
}

} // namespace ao::tools
