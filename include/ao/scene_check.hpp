// What is wrong with a scene, and what its materials need of the geometry: everything that is decided once per material and
// blend node, so that the number of objects does not matter.
#pragma once

#include "ao/detail/text.hpp"
#include "ao/result.hpp"
#include "ao/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ao {

inline constexpr int max_texture_size = 16384; // pixels a side

namespace detail {

constexpr bool is_finite(float x)
{
    return x - x == 0;
}
constexpr bool is_finite(const glm::vec2& v)
{
    return is_finite(v.x) && is_finite(v.y);
}
constexpr bool is_finite(const glm::vec3& v)
{
    return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}
constexpr bool is_finite(const matrix4& m)
{
    float sum = 0;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            sum += m[c][r] - m[c][r]; // NaN as soon as one is not finite
        }
    }
    return sum == 0;
}
constexpr bool in_range(int index, std::size_t size)
{
    return index >= 0 && static_cast<std::size_t>(index) < size;
}

// Node of a child or of object::material. Precondition: child < 0.
constexpr std::size_t blend_index(int child)
{
    return static_cast<std::size_t>(-1 - child);
}

template <class... Part>
constexpr error scene_error(const Part&... parts)
{
    return error(errc::invalid_scene, reason(parts...));
}

// Children and masks in range, k in [0, 1].
constexpr std::optional<error> check_blend_nodes(std::span<const blend_node> blends, std::size_t materials, std::size_t textures)
{
    for (std::size_t i = 0; i < blends.size(); ++i) {
        for (const int child : { blends[i].first, blends[i].second }) {
            if (child >= 0 ? !in_range(child, materials) : blend_index(child) >= blends.size()) {
                return scene_error("blend ", i, ": no ", child >= 0 ? "material " : "blend ", child >= 0 ? child : -1 - child);
            }
        }
        if (blends[i].mask != no_texture && !in_range(blends[i].mask, textures)) {
            return scene_error("blend ", i, ": no texture ", blends[i].mask, " for its mask");
        }
        if (!(blends[i].k >= 0 && blends[i].k <= 1)) {
            return scene_error("blend ", i, ": k is not a number in [0, 1]");
        }
    }
    return std::nullopt;
}

// All nodes, children before parents, without recursion; the node at fault where they form a cycle.
// Precondition: children in range.
constexpr result<std::vector<std::uint32_t>> blend_order(std::span<const blend_node> blends)
{
    enum class state : unsigned char { unseen, open, done };
    std::vector<state> states(blends.size(), state::unseen);
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> stack;
    order.reserve(blends.size());
    for (std::size_t root = 0; root < blends.size(); ++root) {
        if (states[root] != state::unseen) {
            continue;
        }
        stack.push_back(static_cast<std::uint32_t>(root));
        while (!stack.empty()) {
            const std::uint32_t node = stack.back();
            if (states[node] != state::unseen) {
                stack.pop_back();
                if (states[node] == state::open) {
                    states[node] = state::done;
                    order.push_back(node);
                }
                continue;
            }
            states[node] = state::open;
            for (const int child : { blends[node].second, blends[node].first }) {
                if (child >= 0) {
                    continue;
                }
                const std::size_t below = blend_index(child);
                if (states[below] == state::open) {
                    return scene_error("blend ", below, " contains itself");
                }
                if (states[below] == state::unseen) {
                    stack.push_back(static_cast<std::uint32_t>(below));
                }
            }
        }
    }
    return order;
}

// 0 or 1 where a node always returns its first or second child, else nothing. fixed_k: k never changes.
class constant_weights {
public:
    constexpr constant_weights(const scene& s, bool fixed_k) : scene_(&s), fixed_k_(fixed_k), known_(s.textures.size(), unknown)
    {
    }
    constexpr std::optional<int> of(const blend_node& node)
    {
        if (node.mask == no_texture) {
            return !fixed_k_ ? std::nullopt : node.k == 0 ? std::optional(0) : node.k == 1 ? std::optional(1) : std::nullopt;
        }
        char& found = known_[static_cast<std::size_t>(node.mask)];
        if (found == unknown) {
            found = scan(scene_->textures[static_cast<std::size_t>(node.mask)].texels);
        }
        return found == varying ? std::nullopt : std::optional<int>(found);
    }

private:
    static constexpr char varying = 2;
    static constexpr char unknown = 3;

    static constexpr char scan(std::span<const std::uint8_t> texels)
    {
        const std::uint8_t red = texels.empty() ? std::uint8_t{ 128 } : texels[0];
        if (red != 0 && red != 255) {
            return varying;
        }
        for (std::size_t i = 0; i < texels.size(); i += 4) {
            if (texels[i] != red) {
                return varying;
            }
        }
        return red == 0 ? 0 : 1;
    }

    const scene* scene_;
    bool fixed_k_;
    std::vector<char> known_;
};

constexpr bool same_normal_map(const standard_material& a, const standard_material& b)
{
    return a.normal_map == b.normal_map &&
           (a.normal_map == no_texture || (a.normal_green_down == b.normal_green_down && a.repeat == b.repeat));
}

} // namespace detail

// What drawing with a material needs of the geometry.
struct material_needs {
    int geometry = 0;        // the leaf whose maps and sides the geometry takes: the material itself, or a blend's first leaf
    bool uvs = false;        // any map over uv
    bool normal_map = false; // of the geometry's leaf
    bool frame = false;      // a blend with a leaf whose normal map differs from the geometry's
};

// Of every material, then of every blend node, in linear time. Precondition: a valid scene.
class material_table {
public:
    explicit material_table(const scene& s) : materials_(s.materials.size())
    {
        for (const standard_material& m : s.materials) {
            material_needs needs;
            needs.geometry = static_cast<int>(needs_.size());
            needs.normal_map = m.normal_map != no_texture;
            needs.uvs =
                needs.normal_map || m.diffuse_map != no_texture || m.alpha_map != no_texture || m.specular_map != no_texture;
            needs_.push_back(needs);
        }
        needs_.resize(materials_ + s.blends.size());
        // Per entry: one leaf that is not pruned, and whether all those have its normal map.
        std::vector<int> leaf(needs_.size());
        std::vector<char> alike(needs_.size(), 1);
        for (std::size_t i = 0; i < materials_; ++i) {
            leaf[i] = static_cast<int>(i);
        }
        const auto material = [&](int i) -> const standard_material& { return s.materials[static_cast<std::size_t>(i)]; };
        const result<std::vector<std::uint32_t>> order = detail::blend_order(s.blends);
        detail::constant_weights constant(s, false);
        for (const std::uint32_t node : *order) {
            const blend_node& blend = s.blends[node];
            const std::size_t self = materials_ + node;
            const std::size_t first = entry(blend.first);
            const std::size_t second = entry(blend.second);
            const std::optional<int> weight = constant.of(blend);
            const std::size_t live = weight == 1 ? second : first;
            leaf[self] = leaf[live];
            alike[self] = alike[live];
            if (!weight) {
                alike[self] = alike[first] != 0 && alike[second] != 0 &&
                              detail::same_normal_map(material(leaf[first]), material(leaf[second]));
            }
            material_needs& needs = needs_[self];
            needs.geometry = needs_[first].geometry;
            needs.normal_map = needs_[first].normal_map;
            needs.uvs = needs_[first].uvs || needs_[second].uvs || blend.mask != no_texture;
            needs.frame = alike[self] == 0 || !detail::same_normal_map(material(needs.geometry), material(leaf[self]));
        }
    }
    // Of a material as objects name it: blends are negative.
    const material_needs& operator[](int material) const { return needs_[entry(material)]; }

private:
    std::size_t entry(int material) const
    {
        return material >= 0 ? static_cast<std::size_t>(material) : materials_ + detail::blend_index(material);
    }

    std::size_t materials_;
    std::vector<material_needs> needs_;
};

namespace detail {

inline std::optional<error> check_mesh(const mesh& m, std::size_t i)
{
    const std::size_t count = m.positions.size();
    const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
    if (!fits(m.normals.size()) || !fits(m.tangents.size()) || !fits(m.uvs.size()) || !fits(m.previous_positions.size())) {
        return scene_error("mesh ", i, ": arrays of different lengths");
    }
    if (m.indices.size() % 3 != 0) {
        return scene_error("mesh ", i, ": ", m.indices.size(), " indices are not three per triangle");
    }
    std::uint32_t greatest = 0;
    for (const std::uint32_t index : m.indices) {
        greatest = index > greatest ? index : greatest;
    }
    if (!m.indices.empty() && greatest >= count) {
        return scene_error("mesh ", i, ": index ", greatest, " of ", count, " vertices");
    }
    return std::nullopt;
}

inline std::optional<error> check_texture(const texture& t, std::size_t i)
{
    if (t.width < 1 || t.height < 1 || t.width > max_texture_size || t.height > max_texture_size) {
        return scene_error("texture ", i, ": ", t.width, " x ", t.height, " pixels, must have 1 to ", max_texture_size,
                           " a side");
    }
    const std::size_t bytes = std::size_t{ 4 } * static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height);
    if (t.texels.size() != bytes) {
        return scene_error("texture ", i, ": ", t.texels.size(), " bytes of texels instead of ", bytes);
    }
    return std::nullopt;
}

inline std::optional<error> check_material(const standard_material& m, std::size_t i, std::size_t textures)
{
    for (const int map : { m.diffuse_map, m.alpha_map, m.normal_map, m.specular_map, m.reflection_map }) {
        if (map != no_texture && !in_range(map, textures)) {
            return scene_error("material ", i, ": no texture ", map);
        }
    }
    if (!is_finite(m.ambient) || !is_finite(m.diffuse) || !is_finite(m.specular) || !is_finite(m.emission) ||
        !is_finite(m.repeat) || !is_finite(m.alpha_cutoff)) {
        return scene_error("material ", i, ": a number that is not finite");
    }
    if (!(m.shininess >= 0 && m.shininess <= 8192)) {
        return scene_error("material ", i, ": shininess is not in 0 to 8192");
    }
    return std::nullopt;
}

inline std::optional<error> check_object(const scene& s, const material_table& materials, std::size_t i)
{
    const object& o = s.objects[i];
    if (!in_range(o.mesh, s.meshes.size())) {
        return scene_error("object ", i, ": no mesh ", o.mesh);
    }
    if (o.material >= 0 ? !in_range(o.material, s.materials.size()) : blend_index(o.material) >= s.blends.size()) {
        return scene_error("object ", i, ": no ", o.material >= 0 ? "material " : "blend ",
                           o.material >= 0 ? o.material : -1 - o.material);
    }
    if (!is_finite(o.model) || !is_finite(o.previous_model)) {
        return scene_error("object ", i, ": a transform that is not finite");
    }
    const matrix4& m = o.model;
    const matrix4& p = o.previous_model;
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1 || p[0][3] != 0 || p[1][3] != 0 || p[2][3] != 0 ||
        p[3][3] != 1) {
        return scene_error("object ", i, ": a transform whose last row is not (0, 0, 0, 1)");
    }
    const mesh& drawn = s.meshes[static_cast<std::size_t>(o.mesh)];
    const material_needs& needs = materials[o.material];
    if (needs.uvs && drawn.uvs.empty() && !drawn.indices.empty()) {
        return scene_error("object ", i, ": its material has maps, mesh ", o.mesh, " no texture coordinates");
    }
    if ((needs.normal_map || needs.frame) && drawn.tangents.empty() && !drawn.indices.empty()) {
        return scene_error("object ", i, ": its material has a normal map, mesh ", o.mesh, " no tangents");
    }
    return std::nullopt;
}

} // namespace detail

// The first thing wrong with a scene: an index out of range, arrays of different lengths, a texture without texels, a blend
// tree with a cycle, k outside [0, 1], maps without texture coordinates or tangents, a number that is not finite where one is
// needed. Vertices may be anything: triangles that are not finite are left out, other attributes have fallbacks.
inline std::optional<error> validate(const scene& s)
{
    for (std::size_t i = 0; i < s.meshes.size(); ++i) {
        if (const auto wrong = detail::check_mesh(s.meshes[i], i)) {
            return wrong;
        }
    }
    for (std::size_t i = 0; i < s.textures.size(); ++i) {
        if (const auto wrong = detail::check_texture(s.textures[i], i)) {
            return wrong;
        }
    }
    for (std::size_t i = 0; i < s.materials.size(); ++i) {
        if (const auto wrong = detail::check_material(s.materials[i], i, s.textures.size())) {
            return wrong;
        }
    }
    if (const auto wrong = detail::check_blend_nodes(s.blends, s.materials.size(), s.textures.size())) {
        return wrong;
    }
    if (const auto order = detail::blend_order(s.blends); !order) {
        return order.error();
    }
    const material_table materials(s);
    for (std::size_t i = 0; i < s.objects.size(); ++i) {
        if (const auto wrong = detail::check_object(s, materials, i)) {
            return wrong;
        }
    }
    for (std::size_t i = 0; i < s.lights.size(); ++i) {
        const light& l = s.lights[i];
        if (!detail::is_finite(l.vector) || !detail::is_finite(l.color) || !detail::is_finite(l.attenuation)) {
            return detail::scene_error("light ", i, ": a number that is not finite");
        }
    }
    for (const glm::vec3& c : s.ambient.coefficients) {
        if (!detail::is_finite(c)) {
            return detail::scene_error("ambient light: a number that is not finite");
        }
    }
    return std::nullopt;
}

// The leaf that gives an object's geometry its maps: the material itself, or the first leaf of a blend.
// Precondition: a valid scene. For many objects material_table is quicker.
inline int geometry_material(const scene& s, int material)
{
    while (material < 0) {
        material = s.blends[detail::blend_index(material)].first;
    }
    return material;
}

} // namespace ao
