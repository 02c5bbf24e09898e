// Blend trees of many shapes, and what they come to by the definition: no code of the planner's.
#pragma once

#include "ao/scene.hpp"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace blend_test {

using ao::blend_node;

inline int node(int i)
{
    return -1 - i;
}

// A scene of nothing but blends of `leaves` materials. Node 0 is the root.
struct blends {
    std::vector<blend_node> nodes;
    std::vector<ao::standard_material> materials;
    std::vector<ao::texture> textures;

    explicit blends(std::size_t leaves) : materials(leaves) {}
    ao::scene scene() const
    {
        ao::scene s;
        s.materials = materials;
        s.blends = nodes;
        s.textures = textures;
        return s;
    }
};

// left_weight of n leaves go to the first child. Children of a node have a greater index.
inline blends split_tree(int leaves, const std::function<int(int)>& left_weight)
{
    blends made(static_cast<std::size_t>(leaves));
    std::mt19937 engine(static_cast<std::uint32_t>(leaves));
    std::uniform_real_distribution<float> k(0.05F, 0.95F);
    struct open {
        std::size_t index;
        int first;
        int count;
    };
    made.nodes.push_back({ 0, 0, k(engine), ao::no_texture });
    std::vector<open> stack{ { 0, 0, leaves } };
    while (!stack.empty()) {
        const open top = stack.back();
        stack.pop_back();
        const int left = left_weight(top.count);
        const auto child = [&](int first, int count) {
            if (count == 1) {
                return first;
            }
            made.nodes.push_back({ 0, 0, k(engine), ao::no_texture });
            stack.push_back({ made.nodes.size() - 1, first, count });
            return node(static_cast<int>(made.nodes.size()) - 1);
        };
        const int first = child(top.first, left);
        const int second = child(top.first + left, top.count - left);
        made.nodes[top.index].first = first;
        made.nodes[top.index].second = second;
    }
    return made;
}

// `depth` blends in a row, each with a leaf; the long side first or second.
inline blends chain(int depth, bool long_first)
{
    return split_tree(depth + 1, [=](int count) { return long_first ? count - 1 : 1; });
}

inline blends balanced_tree(int leaves)
{
    return split_tree(leaves, [](int count) { return count / 2; });
}

// Every node blends the next with itself: as a tree, 2^levels leaves and more.
inline blends self_shared(int levels)
{
    blends made(2);
    for (int i = 0; i < levels; ++i) {
        made.nodes.push_back({ node(i + 1), node(i + 1), 0.25F, ao::no_texture });
    }
    made.nodes.push_back({ 0, 1, 0.25F, ao::no_texture });
    return made;
}

// Each node takes the two below, so that two results stay alive; as a tree, Fibonacci's numbers of leaves.
inline blends ladder(int levels)
{
    blends made(2);
    for (int i = 0; i < levels; ++i) {
        made.nodes.push_back({ node(i + 1), i + 1 < levels ? node(i + 2) : 1, 0.5F, ao::no_texture });
    }
    made.nodes.push_back({ 0, 1, 0.75F, ao::no_texture });
    return made;
}

// By the definition, in double; children of a node have a greater index.
inline std::vector<glm::dvec3> truth(const std::vector<blend_node>& nodes, const std::vector<glm::dvec3>& leaves)
{
    std::vector<glm::dvec3> value(nodes.size());
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const auto child = [&](int c) {
            return c >= 0 ? leaves[static_cast<std::size_t>(c)] : value[static_cast<std::size_t>(-1 - c)];
        };
        const auto b = static_cast<double>(nodes[i].k);
        value[i] = child(nodes[i].first) * (1 - b) + child(nodes[i].second) * b;
    }
    return value;
}

// Mixes between a leaf and the root, at most.
inline int depth_of(const std::vector<blend_node>& nodes)
{
    std::vector<int> depth(nodes.size(), 1);
    for (std::size_t i = nodes.size(); i-- > 0;) {
        for (const int child : { nodes[i].first, nodes[i].second }) {
            if (child < 0) {
                depth[i] = std::max(depth[i], depth[static_cast<std::size_t>(-1 - child)] + 1);
            }
        }
    }
    return depth[0];
}

// Leaves, each as often as a node names it.
inline int leaves_of(const std::vector<blend_node>& nodes)
{
    int count = 0;
    for (const blend_node& n : nodes) {
        count += (n.first >= 0 ? 1 : 0) + (n.second >= 0 ? 1 : 0);
    }
    return count;
}

// Sethi and Ullman's number of a tree (JACM 17(4), 1970): two children that need as much need one more. Subtrees that need no
// more than `at_once` are done in one go and count as one.
inline int sethi_ullman(const std::vector<blend_node>& nodes, int at_once = 1)
{
    struct need {
        int whole;
        int counted;
    };
    std::vector<need> of(nodes.size());
    const auto joined = [](int a, int b) { return a == b ? a + 1 : std::max(a, b); };
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const auto child = [&](int c) { return c >= 0 ? need{ 1, 1 } : of[static_cast<std::size_t>(-1 - c)]; };
        const need a = child(nodes[i].first);
        const need b = child(nodes[i].second);
        const int whole = joined(a.whole, b.whole);
        of[i] = { whole, whole <= at_once ? 1 : joined(a.counted, b.counted) };
    }
    return of[0].counted;
}

} // namespace blend_test
