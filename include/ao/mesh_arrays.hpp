// The meshes of a scene as the arrays that a draw plan reads: one array per vertex attribute over all meshes, for rasterizers to
// upload or to read.
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/math.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace ao {

enum vertex_attribute : unsigned { position_attribute, normal_attribute, tangent_attribute, uv_attribute, previous_attribute };
inline constexpr std::size_t vertex_attribute_count = 5;
inline constexpr std::array<int, vertex_attribute_count> vertex_attribute_floats{ 3, 3, 4, 2, 3 };

// Whether any draw of the variant has normals.
constexpr bool reads_normals(const draw_variant& v, const gbuffer_facts& f)
{
    return f.normal || v.frame;
}
constexpr bool reads_tangents(const draw_variant& v)
{
    return v.normal_map || v.frame;
}
// Whether any material map is read.
constexpr bool reads_maps(const draw_variant& v)
{
    return v.alpha_map || v.normal_map;
}

struct placed_mesh {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::int32_t base_vertex = 0; // added to each index
};

struct mesh_arrays {
    // Floats by attribute; those that no variant reads are empty, others have zeros for meshes that lack them.
    std::array<std::vector<float>, vertex_attribute_count> streams;
    std::vector<std::uint32_t> indices;
    std::vector<placed_mesh> meshes; // of the scene; those that no draw uses have no indices
    bool too_large = false;          // for 31-bit vertex numbers; the arrays are cut short
};

namespace detail {

// What the draws of a plan read of each mesh.
struct mesh_use {
    bool drawn = false;
    bool unrolled = false; // three vertices a triangle, with its normal
};

template <class Vector>
void append_attribute(std::vector<float>& stream, const std::vector<std::uint32_t>& vertices, std::span<const Vector> values)
{
    constexpr auto size = static_cast<std::size_t>(Vector::length());
    if (values.empty()) {
        stream.resize(stream.size() + size * vertices.size());
        return;
    }
    for (const std::uint32_t v : vertices) {
        for (int i = 0; i < Vector::length(); ++i) {
            stream.push_back(values[v][i]);
        }
    }
}

// Triangles' own normals, counter-clockwise.
inline std::vector<glm::vec3> flat_normals(const mesh& m, const std::vector<std::uint32_t>& vertices)
{
    std::vector<glm::vec3> normals;
    normals.reserve(vertices.size());
    for (std::size_t i = 0; i + 3 <= vertices.size(); i += 3) {
        const glm::vec3 a = m.positions[vertices[i]];
        const glm::vec3 along = m.positions[vertices[i + 1]] - a;
        const glm::vec3 across = m.positions[vertices[i + 2]] - a;
        normals.insert(normals.end(), 3,
                       math<float>::ao_normalize_or(math<float>::ao_cross(along, across), glm::vec3(0.0F, 0.0F, 1.0F)));
    }
    return normals;
}

inline void append_mesh(mesh_arrays& to, const std::array<bool, vertex_attribute_count>& read, const mesh& m, bool unrolled,
                        placed_mesh& placed)
{
    std::vector<std::uint32_t> indices = drawable_indices(m);
    const std::size_t base = to.streams[position_attribute].size() / 3;
    std::vector<std::uint32_t> vertices;
    if (unrolled) {
        vertices = indices;
        std::iota(indices.begin(), indices.end(), 0U);
    }
    else {
        vertices.resize(m.positions.size());
        std::iota(vertices.begin(), vertices.end(), 0U);
    }
    placed = { static_cast<std::uint32_t>(to.indices.size()), static_cast<std::uint32_t>(indices.size()),
               static_cast<std::int32_t>(base) };
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    to.too_large = to.too_large || base + vertices.size() > most || to.indices.size() + indices.size() > most;
    to.indices.insert(to.indices.end(), indices.begin(), indices.end());

    append_attribute(to.streams[position_attribute], vertices, m.positions);
    if (read[normal_attribute] && unrolled) {
        for (const glm::vec3& n : flat_normals(m, vertices)) {
            to.streams[normal_attribute].insert(to.streams[normal_attribute].end(), { n.x, n.y, n.z });
        }
    }
    else if (read[normal_attribute]) {
        append_attribute(to.streams[normal_attribute], vertices, m.normals);
    }
    if (read[tangent_attribute]) {
        append_attribute(to.streams[tangent_attribute], vertices, m.tangents);
    }
    if (read[uv_attribute]) {
        append_attribute(to.streams[uv_attribute], vertices, m.uvs);
    }
    if (read[previous_attribute]) {
        append_attribute(to.streams[previous_attribute], vertices, m.previous_positions);
    }
}

} // namespace detail

// Precondition: the plan was made from the scene.
inline mesh_arrays gather_meshes(const scene& s, const draw_plan& p)
{
    std::array<bool, vertex_attribute_count> read{};
    for (const draw_variant& v : p.variants) {
        read[normal_attribute] = read[normal_attribute] || reads_normals(v, p.facts);
        read[tangent_attribute] = read[tangent_attribute] || reads_tangents(v);
        read[uv_attribute] = read[uv_attribute] || v.uvs;
        read[previous_attribute] = read[previous_attribute] || v.deforming;
    }
    std::vector<detail::mesh_use> uses(s.meshes.size());
    for (const draw& d : p.draws) {
        detail::mesh_use& use = uses[static_cast<std::size_t>(s.objects[static_cast<std::size_t>(d.object)].mesh)];
        use.drawn = true;
        use.unrolled = use.unrolled || p.variants[static_cast<std::size_t>(d.variant)].flat_normals;
    }
    mesh_arrays arrays;
    arrays.meshes.resize(s.meshes.size());
    for (std::size_t i = 0; i < uses.size() && !arrays.too_large; ++i) {
        if (uses[i].drawn) {
            detail::append_mesh(arrays, read, s.meshes[i], uses[i].unrolled, arrays.meshes[i]);
        }
    }
    return arrays;
}

} // namespace ao
