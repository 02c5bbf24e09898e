#include "bake_model.hpp"
#include "error.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cstddef>

namespace ao::tools {
namespace {

// Twice the area of a corner, seen along the polygon's normal; the plane's two axes are enough.
struct flat_polygon {
    std::vector<glm::dvec2> places;

    flat_polygon(const bake_model& m, std::span<const std::uint32_t> of)
    {
        const glm::dvec3 origin = m.positions[of[0]];
        glm::dvec3 normal(0.0);
        for (std::size_t i = 1; i + 1 < of.size(); ++i)
            normal += glm::cross(m.positions[of[i]] - origin, m.positions[of[i + 1]] - origin);
        const glm::dvec3 size = glm::abs(normal);
        const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        const bool turned = normal[drop] < 0.0;
        const int u = (drop + (turned ? 2 : 1)) % 3, v = (drop + (turned ? 1 : 2)) % 3;
        for (const std::uint32_t c : of)
            places.emplace_back(m.positions[c][u] - origin[u], m.positions[c][v] - origin[v]);
    }
    [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const
    {
        const glm::dvec2 p = places[b] - places[a], q = places[c] - places[a];
        return p.x * q.y - p.y * q.x;
    }
    // Where every triangle of the fan from the first corner turns the right way.
    [[nodiscard]] bool fan() const
    {
        for (std::size_t i = 1; i + 1 < places.size(); ++i)
            if (!(area(0, i, i + 1) > 0.0))
                return false;
        return true;
    }
};

void cut_ears(const flat_polygon& flat, std::span<const std::uint32_t> of, std::vector<std::uint32_t>& indices)
{
    std::vector<std::size_t> left(of.size());
    for (std::size_t i = 0; i < left.size(); ++i)
        left[i] = i;
    const auto is_ear = [&](std::size_t at) {
        const std::size_t n = left.size();
        const std::size_t a = left[(at + n - 1) % n], b = left[at], c = left[(at + 1) % n];
        if (!(flat.area(a, b, c) > 0.0))
            return false;
        return std::none_of(left.begin(), left.end(), [&](std::size_t p) {
            return p != a && p != b && p != c && flat.area(a, b, p) >= 0.0 && flat.area(b, c, p) >= 0.0 &&
                   flat.area(c, a, p) >= 0.0;
        });
    };
    while (left.size() > 2) {
        std::size_t at = 0;
        while (at < left.size() && !is_ear(at))
            ++at;
        at = at < left.size() ? at : 0; // crossing or without area: any corner
        const std::size_t n = left.size();
        for (const std::size_t c : { left[(at + n - 1) % n], left[at], left[(at + 1) % n] })
            indices.push_back(of[c]);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
}

} // namespace

void bake_model::add_polygon(std::span<const std::uint32_t> of, std::uint32_t of_object)
{
    if (of.size() < 3)
        return;
    if (corners.size() + of.size() > 0xffffffffU)
        throw error("more than 4294967295 corners");
    if (first_corner.empty())
        first_corner.push_back(0);
    corners.insert(corners.end(), of.begin(), of.end());
    first_corner.push_back(static_cast<std::uint32_t>(corners.size()));
    object.push_back(of_object);
}

bake_triangles triangles_of(const bake_model& model)
{
    bake_triangles t;
    t.indices.reserve(model.corners.size());
    t.objects.reserve(model.polygons());
    for (std::size_t i = 0; i < model.polygons(); ++i) {
        const std::span<const std::uint32_t> of = model.polygon(i);
        if (of.size() == 3) {
            t.indices.insert(t.indices.end(), of.begin(), of.end());
        }
        else if (const flat_polygon flat(model, of); flat.fan() || of.size() > 4096) {
            for (std::size_t k = 1; k + 1 < of.size(); ++k)
                for (const std::size_t c : { std::size_t{ 0 }, k, k + 1 })
                    t.indices.push_back(of[c]);
        }
        else {
            cut_ears(flat, of, t.indices);
        }
        t.objects.resize(t.indices.size() / 3, model.object[i]);
    }
    return t;
}

} // namespace ao::tools
