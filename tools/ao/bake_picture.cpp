#include "ao/bake_results.hpp"
#include "scene/camera.hpp"
#include "scene/gbuffer.hpp"
#include "scene/images.hpp"
#include "scene/ray_tree.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace ao::tools {
namespace {

bool finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// The model about the origin, its largest side 2: any coordinates become good floats.
scene scene_of(const bake_model& m)
{
    scene s;
    s.name = m.name;
    glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
    const bake_triangles t = triangles_of(m);
    for (const std::uint32_t c : t.indices)
        if (finite(m.positions[c])) {
            low = glm::min(low, m.positions[c]);
            high = glm::max(high, m.positions[c]);
        }
    const glm::dvec3 centre = low * 0.5 + high * 0.5, half = high * 0.5 - low * 0.5;
    const double scale = 1.0 / std::max({ half.x, half.y, half.z, 1e-300 });
    for (const glm::dvec3& p : m.positions)
        s.positions.push_back(finite(p) ? glm::vec3(glm::clamp((p - centre) * scale, -4.0, 4.0)) : glm::vec3(0.0f));
    s.normals.assign(s.positions.size(), glm::vec3(0.0f, 1.0f, 0.0f));
    for (std::size_t i = 0; i < t.indices.size(); i += 3) {
        const glm::uvec3 corners(t.indices[i], t.indices[i + 1], t.indices[i + 2]);
        if (finite(m.positions[corners.x]) && finite(m.positions[corners.y]) && finite(m.positions[corners.z]))
            s.triangles.push_back(corners);
    }
    s.object.assign(s.triangles.size(), 0);
    s.material.assign(s.triangles.size(), 0);
    s.object_names = { "model" };
    s.material_names = { "model" };
    return s;
}

// Weights of the corners at a point of the triangle.
glm::dvec3 weights_at(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double whole = glm::dot(normal, normal);
    const double of_b = glm::dot(glm::cross(p - a, c - a), normal) / whole;
    const double of_c = glm::dot(glm::cross(b - a, p - a), normal) / whole;
    return glm::clamp(glm::dvec3(1.0 - of_b - of_c, of_b, of_c), 0.0, 1.0);
}

constexpr int fine = 3; // samples a side of a pixel
constexpr int band = 32;
constexpr glm::vec3 background(0.16f, 0.18f, 0.22f);

// What the camera sees of the scene and no more, but for a margin and the aspect. Precondition: the scene is before the camera.
frustum fitted(const scene& s, const camera& c, float aspect, depth_range range)
{
    const glm::mat4 to_view = view_matrix(c);
    glm::vec2 low(HUGE_VALF), high(-HUGE_VALF);
    for (const glm::uvec3& t : s.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::vec4 p = to_view * glm::vec4(s.positions[t[k]], 1.0f);
            low = glm::min(low, glm::vec2(p) / -p.z);
            high = glm::max(high, glm::vec2(p) / -p.z);
        }
    const glm::vec2 middle = (low + high) * 0.5f, half = (high - low) * 0.53f;
    const float height = std::max({ half.y, half.x / aspect, 1e-6f });
    frustum f;
    f.left = middle.x - height * aspect;
    f.right = middle.x + height * aspect;
    f.bottom = middle.y - height;
    f.top = middle.y + height;
    f.near = range.near;
    f.far = range.far;
    return f;
}

frustum band_of(frustum f, int row, int rows, int height)
{
    const float step = (f.top - f.bottom) / static_cast<float>(height);
    f.bottom = f.top - step * static_cast<float>(row + rows);
    f.top -= step * static_cast<float>(row);
    return f;
}

// Sums over the samples of each pixel, row by row behind those that are there.
void add_band(const gbuffer& g, const scene& s, const std::vector<glm::vec3>& colors, int width, std::vector<glm::vec3>& sums)
{
    const std::size_t first = sums.size();
    sums.resize(first + g.size() / (fine * fine), glm::vec3(0.0f));
    for (std::size_t i = 0; i < g.size(); ++i) {
        const auto row = static_cast<std::size_t>(g.width), x = i % row / fine, y = i / row / fine;
        glm::vec3& sum = sums[first + y * static_cast<std::size_t>(width) + x];
        if (g.hit[i] == 0) {
            sum += background;
            continue;
        }
        const glm::uvec3 t = s.triangles[g.triangle[i]];
        const glm::dvec3 w = weights_at(g.world[i], s.positions[t.x], s.positions[t.y], s.positions[t.z]);
        sum += glm::vec3(w.x * glm::dvec3(colors[t.x]) + w.y * glm::dvec3(colors[t.y]) + w.z * glm::dvec3(colors[t.z]));
    }
}

} // namespace

std::string picture_of(const bake_model& m, const std::vector<glm::vec3>& colors, picture_size size)
{
    const scene s = scene_of(m);
    const ray_tree tree(s);
    const bounds b = bounds_of(s);
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    const camera c = frame(b, aspect, 40.0f);
    const frustum whole = fitted(s, c, aspect, clip_range(b, c));
    std::vector<glm::vec3> sums;
    sums.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    // By bands of rows: samples take a hundred bytes each.
    for (int row = 0; row < size.height; row += band) {
        const int rows = std::min(band, size.height - row);
        const gbuffer g = trace_gbuffer(s, tree, c, band_of(whole, row, rows, size.height), size.width * fine, rows * fine);
        add_band(g, s, colors, size.width, sums);
    }
    std::vector<float> values;
    for (const glm::vec3& sum : sums)
        for (int k = 0; k < 3; ++k)
            values.push_back(sum[k] / static_cast<float>(fine * fine));
    return encode_png({ size.width, size.height }, 3, to_bytes(values));
}

} // namespace ao::tools
