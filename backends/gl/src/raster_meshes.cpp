#include "raster_meshes.hpp"

#include <numeric>

namespace ao::gl {

namespace {

// What the draws of a plan read of each mesh.
struct mesh_use {
    bool drawn = false;
    bool unrolled = false; // three vertices a triangle, with its normal
};

template <class Vector>
void append(std::vector<float>& stream, const std::vector<std::uint32_t>& vertices, std::span<const Vector> values)
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
std::vector<glm::vec3> flat_normals(const mesh& m, const std::vector<std::uint32_t>& vertices)
{
    std::vector<glm::vec3> normals;
    normals.reserve(vertices.size());
    for (std::size_t i = 0; i + 3 <= vertices.size(); i += 3) {
        const glm::vec3 a = m.positions[vertices[i]];
        const glm::vec3 along = m.positions[vertices[i + 1]] - a;
        const glm::vec3 across = m.positions[vertices[i + 2]] - a;
        normals.insert(normals.end(), 3,
                       raster_math::ao_normalize_or(raster_math::ao_cross(along, across), glm::vec3(0.0F, 0.0F, 1.0F)));
    }
    return normals;
}

void append_mesh(mesh_arrays& to, const std::array<bool, attribute_count>& read, const mesh& m, bool unrolled,
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
    placed = { static_cast<GLuint>(to.indices.size()), static_cast<GLuint>(indices.size()), static_cast<GLint>(base) };
    constexpr std::size_t most = std::numeric_limits<GLint>::max();
    to.too_large = to.too_large || base + vertices.size() > most || to.indices.size() + indices.size() > most;
    to.indices.insert(to.indices.end(), indices.begin(), indices.end());

    append(to.streams[position_attribute], vertices, m.positions);
    if (read[normal_attribute] && unrolled) {
        for (const glm::vec3& n : flat_normals(m, vertices)) {
            to.streams[normal_attribute].insert(to.streams[normal_attribute].end(), { n.x, n.y, n.z });
        }
    }
    else if (read[normal_attribute]) {
        append(to.streams[normal_attribute], vertices, m.normals);
    }
    if (read[tangent_attribute]) {
        append(to.streams[tangent_attribute], vertices, m.tangents);
    }
    if (read[uv_attribute]) {
        append(to.streams[uv_attribute], vertices, m.uvs);
    }
    if (read[previous_attribute]) {
        append(to.streams[previous_attribute], vertices, m.previous_positions);
    }
}

} // namespace

mesh_arrays gather_meshes(const scene& s, const draw_plan& p)
{
    std::array<bool, attribute_count> read{};
    for (const draw_variant& v : p.variants) {
        read[normal_attribute] = read[normal_attribute] || p.facts.normal || v.frame;
        read[tangent_attribute] = read[tangent_attribute] || v.normal_map || v.frame;
        read[uv_attribute] = read[uv_attribute] || v.uvs;
        read[previous_attribute] = read[previous_attribute] || v.deforming;
    }
    std::vector<mesh_use> uses(s.meshes.size());
    for (const draw& d : p.draws) {
        mesh_use& use = uses[static_cast<std::size_t>(s.objects[static_cast<std::size_t>(d.object)].mesh)];
        use.drawn = true;
        use.unrolled = use.unrolled || p.variants[static_cast<std::size_t>(d.variant)].flat_normals;
    }
    mesh_arrays arrays;
    arrays.meshes.resize(s.meshes.size());
    for (std::size_t i = 0; i < uses.size() && !arrays.too_large; ++i) {
        if (uses[i].drawn) {
            append_mesh(arrays, read, s.meshes[i], uses[i].unrolled, arrays.meshes[i]);
        }
    }
    return arrays;
}

} // namespace ao::gl
