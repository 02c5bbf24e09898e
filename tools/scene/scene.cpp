#include "scene.hpp"

#include "error.hpp"

#include "ao/scene_check.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace ao::tools {
namespace {

bool finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_objects(const scene& s)
{
    constexpr std::uint32_t none = 0xffffffffu;
    std::vector<std::uint32_t> found(s.object_names.size(), none);
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        std::uint32_t& material = found[s.object[t]];
        if (material != none && material != s.material[t])
            throw error(s.name + ": object '" + s.object_names[s.object[t]] + "' has two materials");
        material = s.material[t];
    }
    for (std::size_t i = 0; i < s.object_material.size(); ++i) {
        const int m = s.object_material[i];
        const std::size_t index = m >= 0 ? static_cast<std::size_t>(m) : static_cast<std::size_t>(-1 - m);
        if (index >= (m >= 0 ? s.material_names.size() : s.blends.size()))
            throw error(s.name + ": object '" + s.object_names[i] + "': no " + (m >= 0 ? "material " : "blend ") +
                        std::to_string(index));
    }
}

void check_textures(const scene& s)
{
    for (const scene_texture& t : s.textures) {
        const std::string name = s.name + ": texture '" + t.name + "'";
        if (t.width < 1 || t.height < 1 || t.width > ao::max_texture_size || t.height > ao::max_texture_size)
            throw error(name + ": " + std::to_string(t.width) + " x " + std::to_string(t.height) + " pixels");
        if (t.rgba.size() != std::size_t{ 4 } * static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height))
            throw error(name + ": texels and size differ");
    }
}

} // namespace

void check(const scene& s)
{
    if (s.triangles.empty())
        throw error(s.name + ": no triangles");
    if (s.normals.size() != s.positions.size() || s.object.size() != s.triangles.size() ||
        s.material.size() != s.triangles.size())
        throw error(s.name + ": arrays of different lengths");
    const auto fits = [](std::size_t size, std::size_t count) { return size == 0 || size == count; };
    if (!fits(s.uvs.size(), s.positions.size()) || !fits(s.tangents.size(), s.positions.size()) ||
        !fits(s.object_has_uvs.size(), s.object_names.size()) || !fits(s.object_material.size(), s.object_names.size()) ||
        !fits(s.materials.size(), s.material_names.size()))
        throw error(s.name + ": arrays of different lengths");

    for (std::size_t i = 0; i < s.positions.size(); ++i) {
        const std::string vertex = s.name + ": vertex " + std::to_string(i);
        if (!finite(s.positions[i]))
            throw error(vertex + ": position is not finite");
        const glm::vec3 size = glm::abs(s.positions[i]);
        if (std::max(size.x, std::max(size.y, size.z)) > largest_coordinate)
            throw error(vertex + ": coordinate beyond 1e18");
        if (!finite(s.normals[i]))
            throw error(vertex + ": normal is not finite");
        if (std::abs(glm::length(s.normals[i]) - 1.0f) > 1.0e-3f)
            throw error(vertex + ": normal is not of unit length");
        if (!s.uvs.empty() && !(std::isfinite(s.uvs[i].x) && std::isfinite(s.uvs[i].y)))
            throw error(vertex + ": texture coordinate is not finite");
    }
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        const std::string triangle = s.name + ": triangle " + std::to_string(t);
        for (int corner = 0; corner < 3; ++corner)
            if (s.triangles[t][corner] >= s.positions.size())
                throw error(triangle + ": index " + std::to_string(s.triangles[t][corner]) + " out of range, " +
                            std::to_string(s.positions.size()) + " vertices");
        if (s.object[t] >= s.object_names.size() || s.material[t] >= s.material_names.size())
            throw error(triangle + ": object or material out of range");
    }
    check_objects(s);
    check_textures(s);
}

std::vector<int> materials_of_objects(const scene& s)
{
    if (!s.object_material.empty())
        return s.object_material;
    std::vector<int> materials(s.object_names.size());
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
        materials[s.object[t]] = static_cast<int>(s.material[t]);
    return materials;
}

bounds bounds_of(const scene& s)
{
    const glm::vec3 first = s.positions[s.triangles.front().x];
    bounds b{ first, first };
    for (const glm::uvec3& t : s.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            b.low = glm::min(b.low, s.positions[t[corner]]);
            b.high = glm::max(b.high, s.positions[t[corner]]);
        }
    return b;
}

bool degenerate(const scene& s, std::size_t triangle)
{
    const glm::uvec3 t = s.triangles[triangle];
    const glm::dvec3 a = s.positions[t.x];
    const glm::dvec3 b = s.positions[t.y];
    const glm::dvec3 c = s.positions[t.z];
    const glm::dvec3 twice_area = glm::cross(b - a, c - a);
    return !(glm::dot(twice_area, twice_area) > 0.0);
}

std::size_t count_degenerate(const scene& s)
{
    std::size_t count = 0;
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
        count += degenerate(s, t) ? 1u : 0u;
    return count;
}

} // namespace ao::tools
