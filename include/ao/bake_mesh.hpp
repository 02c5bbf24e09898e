// A mesh as ambient occlusion per vertex reads it: centred and scaled to the unit of ao/shared/bake_ray.h, without what cannot
// occlude, with the start of every vertex's rays. Made once on the host, in double; the same whatever order the faces come in.
#pragma once

#include "ao/bake_normals.hpp"
#include "ao/bake_settings.hpp"
#include "ao/bake_start.hpp"
#include "ao/bake_tree.hpp"
#include "ao/detail/text.hpp"
#include "ao/result.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ao {

// Views of the host's arrays. Positions in double: those of float, and those of georeferenced models, whose offsets float loses.
struct bake_input {
    std::span<const glm::dvec3> positions;
    std::span<const glm::vec3> normals;     // per vertex, any length; or none
    std::span<const std::uint32_t> indices; // three per triangle, counter-clockwise
    std::span<const std::uint32_t> objects; // per triangle; or none: all are one object
};

// What a vertex is known for. Of `bake_unbaked` vertices the coefficients are 1, and their errors 0.
enum bake_flag : std::uint8_t {
    bake_isolated = 1,        // in no face that has an area
    bake_not_finite = 2,      // position is infinite or NaN
    bake_no_normal = 4,       // neither the input nor the faces say where outside is
    bake_computed_normal = 8, // the input's was 0 or not finite
    bake_enclosed = 16,       // surfaces that meet at the vertex leave less than half a degree: it may see through one of them
    bake_unbaked = bake_isolated | bake_not_finite | bake_no_normal,
};

struct bake_vertex {
    glm::vec3 start;  // of the rays, in units
    glm::vec3 normal; // unit, or 0 where unbaked
};

// Faces that do not occlude.
struct bake_dropped {
    std::size_t not_finite = 0;
    std::size_t no_area = 0; // as given, or when rounded to 2^-24 of the mesh
};

struct bake_mesh {
    glm::dvec3 centre{ 0.0 };                  // of the box around all faces, model units
    int exponent = 0;                          // a unit is 2^exponent model units; half the diagonal is 15/32 to 15/16 units
    double diagonal = 0;                       // of that box, units
    std::vector<glm::vec3> points;             // distinct places of the corners of triangles, units
    std::vector<bake_triangle> triangles;      // by leaves of the tree
    std::vector<std::uint32_t> objects;        // of the triangles
    std::vector<std::uint32_t> faces;          // of the input, that the triangles are
    bake_tree tree;                            // its order is 0, 1, 2 …
    std::vector<bake_vertex> vertices;         // of the input
    std::vector<std::uint8_t> flags;           // of the vertices, bake_flag
    std::vector<std::uint32_t> vertex_objects; // the least of their faces'
    std::size_t object_count = 1;              // objects with triangles; numbers may be larger
    bake_dropped dropped;

    glm::dvec3 to_units(const glm::dvec3& p) const
    {
        const glm::dvec3 offset = p - centre;
        return { std::ldexp(offset.x, -exponent), std::ldexp(offset.y, -exponent), std::ldexp(offset.z, -exponent) };
    }
};

namespace detail {

inline bool is_finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

struct place_hash {
    std::size_t operator()(const std::array<float, 3>& p) const
    {
        std::uint64_t h = 0x9e3779b97f4a7c15U;
        for (const float x : p) {
            h = (h ^ std::bit_cast<std::uint32_t>(x)) * 0xff51afd7ed558ccdU;
            h ^= h >> 32U;
        }
        return static_cast<std::size_t>(h);
    }
};

class bake_mesh_builder {
public:
    bake_mesh_builder(const bake_input& input, bool own_normals) : input_(input), own_normals_(own_normals) {}

    bake_mesh build()
    {
        find_unit();
        weld();
        order_triangles();
        list_incident();
        find_normals();
        for (std::size_t p = 0; p < mesh_.points.size(); ++p) {
            find_starts(static_cast<std::uint32_t>(p));
        }
        return std::move(mesh_);
    }

private:
    static constexpr std::uint32_t none = 0xffffffffU;

    const glm::dvec3& corner(std::size_t face, std::size_t k) const { return input_.positions[input_.indices[3 * face + k]]; }

    // Box, unit and the faces that have an area.
    void find_unit()
    {
        glm::dvec3 low(std::numeric_limits<double>::infinity());
        glm::dvec3 high(-std::numeric_limits<double>::infinity());
        for (std::size_t f = 0; f < input_.indices.size() / 3; ++f) {
            if (!is_finite(corner(f, 0)) || !is_finite(corner(f, 1)) || !is_finite(corner(f, 2))) {
                ++mesh_.dropped.not_finite;
                continue;
            }
            const glm::dvec3 normal = face_normal(corner(f, 0), corner(f, 1), corner(f, 2));
            if (!(glm::dot(normal, normal) > 0)) {
                ++mesh_.dropped.no_area;
                continue;
            }
            kept_.push_back(static_cast<std::uint32_t>(f));
            for (std::size_t k = 0; k < 3; ++k) {
                low = glm::min(low, corner(f, k));
                high = glm::max(high, corner(f, k));
            }
        }
        if (kept_.empty()) {
            return;
        }
        mesh_.centre = low * 0.5 + high * 0.5;
        const glm::dvec3 half = high * 0.5 - low * 0.5;
        const double largest = std::max({ half.x, half.y, half.z });
        mesh_.exponent = std::ilogb(largest);
        const auto radius = [&] {
            return glm::length(glm::dvec3(std::ldexp(half.x, -mesh_.exponent), std::ldexp(half.y, -mesh_.exponent),
                                          std::ldexp(half.z, -mesh_.exponent)));
        };
        while (radius() > 0.9375) {
            ++mesh_.exponent;
        }
        mesh_.diagonal = 2 * radius();
    }

    void weld()
    {
        point_of_.assign(input_.positions.size(), none);
        std::unordered_map<std::array<float, 3>, std::uint32_t, place_hash> places;
        std::vector<std::uint32_t> usable;
        for (const std::uint32_t f : kept_) {
            bake_triangle t{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = input_.indices[3 * f + k];
                if (point_of_[vertex] == none) {
                    const glm::vec3 p = glm::vec3(mesh_.to_units(input_.positions[vertex])) + 0.0F; // -0 is 0
                    const auto next = static_cast<std::uint32_t>(mesh_.points.size());
                    const auto [at, added] = places.try_emplace({ p.x, p.y, p.z }, next);
                    if (added) {
                        mesh_.points.push_back(p);
                    }
                    point_of_[vertex] = at->second;
                }
                t[k] = point_of_[vertex];
            }
            const glm::dvec3 normal =
                face_normal(glm::dvec3(mesh_.points[t[0]]), glm::dvec3(mesh_.points[t[1]]), glm::dvec3(mesh_.points[t[2]]));
            if (!(glm::dot(normal, normal) > 0)) {
                ++mesh_.dropped.no_area;
                continue;
            }
            mesh_.triangles.push_back(t);
            usable.push_back(f);
        }
        kept_ = std::move(usable);
    }

    // Triangles by leaves, points by first use: what is near in space is near in memory.
    void order_triangles()
    {
        mesh_.tree = build_bake_tree(mesh_.points, mesh_.triangles);
        std::vector<bake_triangle> triangles;
        std::vector<glm::vec3> points;
        std::vector<std::uint32_t> renamed(mesh_.points.size(), none);
        triangles.reserve(mesh_.triangles.size());
        mesh_.faces.reserve(mesh_.triangles.size());
        mesh_.objects.reserve(mesh_.triangles.size());
        std::vector<std::uint32_t> seen;
        for (const std::uint32_t i : mesh_.tree.order) {
            bake_triangle t = mesh_.triangles[i];
            for (std::uint32_t& p : t) {
                if (renamed[p] == none) {
                    renamed[p] = static_cast<std::uint32_t>(points.size());
                    points.push_back(mesh_.points[p]);
                }
                p = renamed[p];
            }
            triangles.push_back(t);
            mesh_.faces.push_back(kept_[i]);
            mesh_.objects.push_back(input_.objects.empty() ? 0 : input_.objects[kept_[i]]);
        }
        for (std::uint32_t& p : point_of_) {
            p = p == none ? none : renamed[p]; // none as well where all faces of the point were dropped
        }
        mesh_.triangles = std::move(triangles);
        mesh_.points = std::move(points);
        std::iota(mesh_.tree.order.begin(), mesh_.tree.order.end(), 0U);
        seen = mesh_.objects;
        std::sort(seen.begin(), seen.end());
        mesh_.object_count =
            std::max<std::size_t>(1, static_cast<std::size_t>(std::unique(seen.begin(), seen.end()) - seen.begin()));
    }

    // Triangles by point, vertices by point, faces' normals.
    void list_incident()
    {
        const std::size_t points = mesh_.points.size();
        first_triangle_.assign(points + 1, 0);
        for (const bake_triangle& t : mesh_.triangles) {
            for (const std::uint32_t p : t) {
                ++first_triangle_[p + 1];
            }
            normals_.push_back(
                face_normal(glm::dvec3(mesh_.points[t[0]]), glm::dvec3(mesh_.points[t[1]]), glm::dvec3(mesh_.points[t[2]])));
        }
        first_vertex_.assign(points + 1, 0);
        for (const std::uint32_t p : point_of_) {
            if (p != none) {
                ++first_vertex_[p + 1];
            }
        }
        for (std::size_t p = 0; p < points; ++p) {
            first_triangle_[p + 1] += first_triangle_[p];
            first_vertex_[p + 1] += first_vertex_[p];
        }
        incident_.resize(3 * mesh_.triangles.size());
        std::vector<std::uint32_t> next(first_triangle_.begin(), first_triangle_.end() - (points > 0 ? 1 : 0));
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            for (const std::uint32_t p : mesh_.triangles[i]) {
                incident_[next[p]++] = static_cast<std::uint32_t>(i);
            }
        }
        vertices_.resize(first_vertex_.back());
        next.assign(first_vertex_.begin(), first_vertex_.end());
        for (std::size_t v = 0; v < point_of_.size(); ++v) {
            if (point_of_[v] != none) {
                vertices_[next[point_of_[v]]++] = static_cast<std::uint32_t>(v);
            }
        }
    }

    std::span<const std::uint32_t> triangles_of(std::uint32_t p) const
    {
        return std::span(incident_).subspan(first_triangle_[p], first_triangle_[p + 1] - first_triangle_[p]);
    }

    glm::dvec3 offset(std::uint32_t to, std::uint32_t from) const
    {
        return glm::dvec3(mesh_.points[to]) - glm::dvec3(mesh_.points[from]);
    }

    void find_normals()
    {
        const std::size_t count = input_.positions.size();
        mesh_.vertices.assign(count, { glm::vec3(0.0F), glm::vec3(0.0F) });
        mesh_.flags.assign(count, 0);
        mesh_.vertex_objects.assign(count, none);
        std::vector<whole_vector> sums(count);
        std::vector<bool> in_face(count, false);
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            const bake_triangle& t = mesh_.triangles[i];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = input_.indices[3 * std::size_t{ mesh_.faces[i] } + k];
                in_face[v] = true;
                mesh_.vertex_objects[v] = std::min(mesh_.vertex_objects[v], mesh_.objects[i]);
                sums[v].add(normals_[i] * angle_between(offset(t[(k + 1) % 3], t[k]), offset(t[(k + 2) % 3], t[k])));
            }
        }
        for (std::size_t v = 0; v < count; ++v) {
            std::uint8_t& flags = mesh_.flags[v];
            if (!is_finite(input_.positions[v])) {
                flags |= bake_not_finite;
            }
            else if (!in_face[v]) {
                flags |= bake_isolated;
            }
            if ((flags & bake_unbaked) != 0) {
                mesh_.vertex_objects[v] = 0;
                continue;
            }
            glm::dvec3 normal(0.0);
            const bool given = own_normals_ && !input_.normals.empty();
            if (given) {
                normal = glm::dvec3(input_.normals[v]);
                const double length = glm::length(normal);
                normal = std::isfinite(length) && length > 0 ? normal / length : glm::dvec3(0.0);
            }
            if (!(glm::dot(normal, normal) > 0)) {
                normal = sums[v].direction();
                flags |= given ? bake_computed_normal : 0;
            }
            if (!(glm::dot(normal, normal) > 0)) {
                flags |= bake_no_normal;
            }
            mesh_.vertices[v].normal = glm::vec3(normal);
        }
    }

    // Of all vertices at a point.
    void find_starts(std::uint32_t p)
    {
        arcs_.clear();
        const auto add = [&](std::uint32_t triangle) {
            const bake_triangle& t = mesh_.triangles[triangle];
            append_arcs({ offset(t[0], p), offset(t[1], p), offset(t[2], p) }, arcs_);
        };
        for_triangles_near(mesh_.tree, mesh_.points[p], static_cast<float>(bake_clearance), add);
        for (std::uint32_t i = first_vertex_[p]; i < first_vertex_[p + 1]; ++i) {
            const std::uint32_t v = vertices_[i];
            if ((mesh_.flags[v] & bake_unbaked) != 0) {
                continue;
            }
            const auto normal = glm::dvec3(mesh_.vertices[v].normal);
            corners_.clear();
            for (const std::uint32_t triangle : triangles_of(p)) {
                add_corner(v, p, triangle, normal);
            }
            const bake_start start = start_of(normal, corners_, arcs_);
            mesh_.flags[v] |= start.clearance < 1.0 / 256 ? bake_enclosed : 0;
            mesh_.vertices[v].start = glm::vec3(glm::dvec3(mesh_.points[p]) + start.direction * lift_of(start));
        }
    }

    void add_corner(std::uint32_t v, std::uint32_t p, std::uint32_t triangle, const glm::dvec3& normal)
    {
        const bake_triangle& t = mesh_.triangles[triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] != p || input_.indices[3 * std::size_t{ mesh_.faces[triangle] } + k] != v) {
                continue;
            }
            const glm::dvec3 middle = glm::normalize(offset(t[(k + 1) % 3], p)) + glm::normalize(offset(t[(k + 2) % 3], p));
            const double length = glm::length(middle);
            const glm::dvec3& face = normals_[triangle];
            if (length > 1e-6) {
                corners_.push_back({ middle / length, glm::dot(face, normal) < 0 ? -face : face });
            }
        }
    }

    const bake_input& input_;
    bool own_normals_;
    bake_mesh mesh_;
    std::vector<std::uint32_t> kept_;     // faces
    std::vector<std::uint32_t> point_of_; // of vertices, or none
    std::vector<glm::dvec3> normals_;     // of triangles
    std::vector<std::uint32_t> first_triangle_;
    std::vector<std::uint32_t> incident_;
    std::vector<std::uint32_t> first_vertex_;
    std::vector<std::uint32_t> vertices_;
    std::vector<bake_arc> arcs_;
    std::vector<bake_corner> corners_;
};

} // namespace detail

// errc::invalid_scene: indices that are no whole triangles or out of range, arrays whose lengths do not fit.
inline result<bake_mesh> prepare_bake_mesh(const bake_input& input, bool own_normals = true)
{
    constexpr std::size_t most = std::size_t{ 1 } << 30U;
    if (input.indices.size() % 3 != 0) {
        return error(errc::invalid_scene, "the indices are no whole triangles");
    }
    if (input.positions.size() > most || input.indices.size() / 3 > most) {
        return error(errc::invalid_scene, "a mesh to bake must have at most 2^30 vertices and triangles");
    }
    if (!input.normals.empty() && input.normals.size() != input.positions.size()) {
        return error(errc::invalid_scene, "there must be a normal per vertex, or none");
    }
    if (!input.objects.empty() && input.objects.size() != input.indices.size() / 3) {
        return error(errc::invalid_scene, "there must be an object per triangle, or none");
    }
    for (std::size_t i = 0; i < input.indices.size(); ++i) {
        if (input.indices[i] >= input.positions.size()) {
            return error(errc::invalid_scene,
                         detail::reason("triangle ", i / 3, " has vertex ", input.indices[i], " of ", input.positions.size()));
        }
    }
    return detail::bake_mesh_builder(input, own_normals).build();
}

} // namespace ao
