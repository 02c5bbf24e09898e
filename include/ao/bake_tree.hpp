// A tree of boxes over triangles, split where the surface area heuristic is least over 16 bins (I. Wald, "On fast construction of
// SAH-based bounding volume hierarchies", 2007). The same tree whatever order the triangles come in but for equal centres.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace ao {

// 32 bytes, as shaders read them.
struct bake_node {
    glm::vec3 low{ std::numeric_limits<float>::max() };
    std::uint32_t first = 0; // triangle of a leaf, or the left child; the right one follows it
    glm::vec3 high{ -std::numeric_limits<float>::max() };
    std::uint32_t count = 0; // triangles, 0 for inner nodes
};

using bake_triangle = std::array<std::uint32_t, 3>; // points

struct bake_tree {
    static constexpr int max_depth = 64;
    std::vector<bake_node> nodes;     // the root first; empty without triangles
    std::vector<std::uint32_t> order; // triangles by leaves
    int depth = 0;                    // nodes on the longest way to a leaf
};

namespace detail {

class bake_tree_builder {
public:
    bake_tree_builder(std::span<const glm::vec3> points, std::span<const bake_triangle> triangles)
    {
        tree_.order.resize(triangles.size());
        std::iota(tree_.order.begin(), tree_.order.end(), 0U);
        boxes_.reserve(triangles.size());
        for (const bake_triangle& t : triangles) {
            box b;
            for (const std::uint32_t p : t) {
                b.include(points[p]);
            }
            boxes_.push_back(b);
        }
    }

    bake_tree build()
    {
        if (boxes_.empty()) {
            return {};
        }
        tree_.nodes.reserve(2 * boxes_.size());
        tree_.nodes.emplace_back();
        std::vector<task> tasks{ { 0, 0, static_cast<std::uint32_t>(boxes_.size()), 1 } };
        while (!tasks.empty()) {
            const task t = tasks.back();
            tasks.pop_back();
            tree_.depth = std::max(tree_.depth, t.depth);
            const std::uint32_t middle = split(t);
            if (middle == 0) {
                continue;
            }
            const auto left = static_cast<std::uint32_t>(tree_.nodes.size());
            tree_.nodes[t.node].first = left;
            tree_.nodes.resize(tree_.nodes.size() + 2);
            tasks.push_back({ left + 1, middle, t.last, t.depth + 1 });
            tasks.push_back({ left, t.first, middle, t.depth + 1 });
        }
        return std::move(tree_);
    }

private:
    static constexpr int bins = 16;
    static constexpr std::uint32_t leaf_size = 4;

    struct box {
        glm::vec3 low{ std::numeric_limits<float>::max() };
        glm::vec3 high{ -std::numeric_limits<float>::max() };

        void include(const glm::vec3& p)
        {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        void include(const box& b)
        {
            low = glm::min(low, b.low);
            high = glm::max(high, b.high);
        }
        glm::vec3 centre() const { return (low + high) * 0.5F; }
        float half_area() const
        {
            const glm::vec3 size = high - low;
            return size.x * size.y + size.y * size.z + size.z * size.x;
        }
    };

    struct task {
        std::uint32_t node;
        std::uint32_t first;
        std::uint32_t last;
        int depth;
    };

    // The first triangle of the right half; 0 for a leaf. Orders the triangles of the task.
    std::uint32_t split(const task& t)
    {
        box all;
        box centres;
        for (std::uint32_t i = t.first; i < t.last; ++i) {
            all.include(boxes_[tree_.order[i]]);
            centres.include(boxes_[tree_.order[i]].centre());
        }
        bake_node& node = tree_.nodes[t.node];
        node.low = all.low;
        node.high = all.high;
        const std::uint32_t count = t.last - t.first;
        const glm::vec3 size = centres.high - centres.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        if (count <= leaf_size || t.depth == bake_tree::max_depth) {
            node.first = t.first;
            node.count = count;
            return 0;
        }
        const auto begin = tree_.order.begin() + static_cast<std::ptrdiff_t>(t.first);
        const auto end = tree_.order.begin() + static_cast<std::ptrdiff_t>(t.last);
        if (!(size[axis] > 0)) {
            return t.first + count / 2;
        }
        // Deep trees come of centres far apart; halves by number end that.
        if (t.depth > bake_tree::max_depth / 2) {
            std::nth_element(begin, begin + count / 2, end, [&](std::uint32_t a, std::uint32_t b) {
                const float left = boxes_[a].centre()[axis];
                const float right = boxes_[b].centre()[axis];
                return left < right || (left == right && a < b);
            });
            return t.first + count / 2;
        }
        const float to_bin = static_cast<float>(bins) / size[axis] * 0.9999F;
        const auto bin_of = [&](std::uint32_t triangle) {
            return std::min(bins - 1, static_cast<int>((boxes_[triangle].centre()[axis] - centres.low[axis]) * to_bin));
        };
        std::array<box, bins> contents;
        std::array<std::uint32_t, bins> counts{};
        for (std::uint32_t i = t.first; i < t.last; ++i) {
            const auto bin = static_cast<std::size_t>(bin_of(tree_.order[i]));
            contents[bin].include(boxes_[tree_.order[i]]);
            ++counts[bin];
        }
        std::array<float, bins> right_cost{};
        box right;
        std::uint32_t right_count = 0;
        for (std::size_t i = bins - 1; i > 0; --i) {
            right.include(contents[i]);
            right_count += counts[i];
            right_cost[i] = right_count == 0 ? 0 : right.half_area() * static_cast<float>(right_count);
        }
        box left;
        std::uint32_t left_count = 0;
        float least = std::numeric_limits<float>::infinity();
        int best = 1;
        for (std::size_t i = 0; i + 1 < bins; ++i) {
            left.include(contents[i]);
            left_count += counts[i];
            const float cost = (left_count == 0 ? 0 : left.half_area() * static_cast<float>(left_count)) + right_cost[i + 1];
            if (left_count > 0 && left_count < count && cost < least) {
                least = cost;
                best = static_cast<int>(i) + 1;
            }
        }
        const auto middle = std::stable_partition(begin, end, [&](std::uint32_t triangle) { return bin_of(triangle) < best; });
        const auto first_right = static_cast<std::uint32_t>(middle - tree_.order.begin());
        return first_right > t.first && first_right < t.last ? first_right : t.first + count / 2;
    }

    std::vector<box> boxes_;
    bake_tree tree_;
};

} // namespace detail

inline bake_tree build_bake_tree(std::span<const glm::vec3> points, std::span<const bake_triangle> triangles)
{
    return detail::bake_tree_builder(points, triangles).build();
}

// Calls visit(triangle) for every triangle whose box is within `distance` of p along each axis.
template <class Visit>
void for_triangles_near(const bake_tree& tree, const glm::vec3& p, float distance, const Visit& visit)
{
    if (tree.nodes.empty()) {
        return;
    }
    std::array<std::uint32_t, bake_tree::max_depth + 1> stack{};
    std::size_t top = 1;
    while (top > 0) {
        const bake_node& node = tree.nodes[stack[--top]];
        bool apart = false;
        for (int axis = 0; axis < 3; ++axis) {
            apart = apart || p[axis] < node.low[axis] - distance || p[axis] > node.high[axis] + distance;
        }
        if (apart) {
            continue;
        }
        if (node.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                visit(tree.order[i]);
            }
            continue;
        }
        stack[top++] = node.first + 1;
        stack[top++] = node.first;
    }
}

} // namespace ao
