// Meshes split along sharp edges. Every corner takes those faces around its place whose normals are near its own face's: a tree
// of boxes around the normals, so that a place with n faces takes about n log n steps, not n^2. Sums are whole numbers: the same
// bits as one by one.
#pragma once

#include "ao/bake_normals.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ao::detail {

class normal_tree {
public:
    struct entry {
        glm::dvec3 normal; // unit
        glm::dvec3 part;   // what it adds
    };

    explicit normal_tree(std::vector<entry> entries) : entries_(std::move(entries))
    {
        if (!entries_.empty()) {
            build(0, entries_.size());
        }
    }

    // Over all entries whose normal has a scalar product with `own` of `least` or more.
    whole_vector sum_near(const glm::dvec3& own, double least) const
    {
        whole_vector sum;
        if (!nodes_.empty()) {
            add(0, own, least, sum);
        }
        return sum;
    }

private:
    static constexpr std::size_t leaf = 8;

    struct node {
        glm::dvec3 low;
        glm::dvec3 high;
        whole_vector sum;
        std::size_t first;
        std::size_t last;
        std::size_t second_child = 0; // 0: a leaf; the first child follows its parent
    };

    void build(std::size_t first, std::size_t last)
    {
        const std::size_t at = nodes_.size();
        nodes_.push_back({ entries_[first].normal, entries_[first].normal, {}, first, last });
        for (std::size_t i = first; i < last; ++i) {
            nodes_[at].low = glm::min(nodes_[at].low, entries_[i].normal);
            nodes_[at].high = glm::max(nodes_[at].high, entries_[i].normal);
            nodes_[at].sum.add(entries_[i].part);
        }
        if (last - first <= leaf) {
            return;
        }
        const glm::dvec3 size = nodes_[at].high - nodes_[at].low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = first + (last - first) / 2;
        const auto place = [&](std::size_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(place(first), place(middle), place(last),
                         [axis](const entry& a, const entry& b) { return a.normal[axis] < b.normal[axis]; });
        build(first, middle);
        nodes_[at].second_child = nodes_.size();
        build(middle, last);
    }

    void add(std::size_t at, const glm::dvec3& own, double least, whole_vector& sum) const
    {
        constexpr double rounding = 1e-12; // of scalar products
        const node& n = nodes_[at];
        const glm::dvec3 a = own * n.low;
        const glm::dvec3 b = own * n.high;
        const glm::dvec3 smallest = glm::min(a, b);
        const glm::dvec3 greatest = glm::max(a, b);
        if (greatest.x + greatest.y + greatest.z < least - rounding) {
            return;
        }
        if (smallest.x + smallest.y + smallest.z > least + rounding) {
            sum.x += n.sum.x;
            sum.y += n.sum.y;
            sum.z += n.sum.z;
            return;
        }
        if (n.second_child != 0) {
            add(at + 1, own, least, sum);
            add(n.second_child, own, least, sum);
            return;
        }
        for (std::size_t i = n.first; i < n.last; ++i) {
            if (glm::dot(own, entries_[i].normal) >= least) {
                sum.add(entries_[i].part);
            }
        }
    }

    std::vector<entry> entries_;
    std::vector<node> nodes_;
};

} // namespace ao::detail

namespace ao {

// A mesh whose vertices are split along sharp edges.
struct split_mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> source; // vertex of the input
};

// Gives every corner the mean normal of those faces at its place (welded by equal positions) that differ from its own face by
// `crease_degrees` at most, and splits vertices where corners differ: 0 splits all but flat edges, 180 none. Faces without area
// keep their corners, with normal 0.
// Precondition: every index is below positions.size(), and there are whole triangles of them.
inline split_mesh split_by_crease(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> indices,
                                  double crease_degrees)
{
    const std::size_t faces = indices.size() / 3;
    std::map<std::array<double, 3>, std::uint32_t> places;
    std::vector<std::uint32_t> place(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3& p = positions[i];
        const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        place[i] = finite ? places.try_emplace({ p.x + 0.0, p.y + 0.0, p.z + 0.0 }, static_cast<std::uint32_t>(i)).first->second
                          : static_cast<std::uint32_t>(i);
    }
    std::vector<glm::dvec3> normals(faces);
    std::vector<std::vector<std::uint32_t>> corners(positions.size());
    for (std::size_t f = 0; f < faces; ++f) {
        normals[f] = detail::face_normal(positions[indices[3 * f]], positions[indices[3 * f + 1]], positions[indices[3 * f + 2]]);
        for (std::size_t k = 0; k < 3; ++k) {
            corners[place[indices[3 * f + k]]].push_back(static_cast<std::uint32_t>(3 * f + k));
        }
    }
    const double least = std::cos(std::clamp(crease_degrees, 0.0, 180.0) * std::numbers::pi / 180) - 1e-9;
    split_mesh split;
    split.indices.resize(3 * faces);
    std::map<std::array<double, 4>, std::uint32_t> made;
    std::vector<std::optional<detail::normal_tree>> trees(positions.size());
    const auto tree_at = [&](std::uint32_t p) -> const detail::normal_tree& {
        if (!trees[p]) {
            std::vector<detail::normal_tree::entry> entries;
            for (const std::uint32_t corner : corners[p]) {
                const glm::dvec3& normal = normals[corner / 3];
                if (glm::dot(normal, normal) > 0) {
                    const std::size_t first = corner - corner % 3;
                    const glm::dvec3& at = positions[indices[corner]];
                    entries.push_back(
                        { normal, normal * detail::angle_between(positions[indices[first + (corner + 1) % 3]] - at,
                                                                 positions[indices[first + (corner + 2) % 3]] - at) });
                }
            }
            trees[p].emplace(std::move(entries));
        }
        return *trees[p];
    };
    for (std::size_t i = 0; i < 3 * faces; ++i) {
        const std::uint32_t vertex = indices[i];
        const glm::dvec3& own = normals[i / 3];
        const detail::whole_vector sum =
            glm::dot(own, own) > 0 ? tree_at(place[vertex]).sum_near(own, least) : detail::whole_vector{};
        const glm::vec3 normal(sum.direction());
        const auto next = static_cast<std::uint32_t>(split.positions.size());
        const auto [at, added] = made.try_emplace({ static_cast<double>(vertex), static_cast<double>(normal.x),
                                                    static_cast<double>(normal.y), static_cast<double>(normal.z) },
                                                  next);
        if (added) {
            split.positions.push_back(positions[vertex]);
            split.normals.push_back(normal);
            split.source.push_back(vertex);
        }
        split.indices[i] = at->second;
    }
    return split;
}

} // namespace ao
