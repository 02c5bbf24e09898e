// Plans of every small tree against brute force: no order of evaluation holds fewer results at a time.
#include "unit/core_blend.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace core_test;

namespace {

// Every binary tree over leaves [first, first + count), appended to nodes that are already there.
void every_tree(int first, int count, std::vector<blend_node>& nodes, const std::function<void(int)>& use)
{
    if (count == 1) {
        use(first);
        return;
    }
    for (int left = 1; left < count; ++left) {
        every_tree(first, left, nodes, [&](int a) {
            every_tree(first + left, count - left, nodes, [&](int b) {
                nodes.push_back({ a, b });
                use(node(static_cast<int>(nodes.size()) - 1));
                nodes.pop_back();
            });
        });
    }
}

// Whether `most` results at a time are enough, by trying every order, interleaved ones as well. Bits of a state: leaves held,
// then nodes held; a blend's result takes the place of one of its children.
bool enough(const std::vector<blend_node>& nodes, int leaves, int most)
{
    const auto bit = [&](int child) { return 1U << static_cast<unsigned>(child >= 0 ? child : leaves - 1 - child); };
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen; // held, leaves used
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{ { 0, 0 } };
    while (!open.empty()) {
        const auto [held, used] = open.back();
        open.pop_back();
        if (held == bit(node(static_cast<int>(nodes.size()) - 1))) {
            return true;
        }
        const auto visit = [&](std::uint32_t h, std::uint32_t u) {
            if (seen.insert({ h, u }).second) {
                open.push_back({ h, u });
            }
        };
        bool blended = false; // a blend that is possible never hurts
        for (std::size_t i = 0; i < nodes.size() && !blended; ++i) {
            const std::uint32_t both = bit(nodes[i].first) | bit(nodes[i].second);
            if ((held & both) == both) {
                visit((held & ~both) | bit(node(static_cast<int>(i))), used);
                blended = true;
            }
        }
        if (blended || std::popcount(held) == most) {
            continue;
        }
        for (int leaf = 0; leaf < leaves; ++leaf) {
            if ((used & bit(leaf)) == 0) {
                visit(held | bit(leaf), used | bit(leaf));
            }
        }
    }
    return false;
}

} // namespace

TEST_CASE("A plan holds no more results than brute force needs, for every tree of 8 leaves", "[core][blend]")
{
    blends tree(8);
    const std::vector<glm::vec3> colors = random_colors(8, 3);
    int trees = 0;
    std::map<int, int> histogram;
    every_tree(0, 8, tree.nodes, [&](int root) {
        ++trees;
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            tree.nodes[i].k = 0.125F + 0.1F * static_cast<float>(i);
        }
        const ao::blend_program p = plan(tree, -1 - root);
        ++histogram[p.registers];
        const bool least = enough(tree.nodes, 8, p.registers) && !enough(tree.nodes, 8, p.registers - 1);
        const ao::blend_program paper = plan(tree, -1 - root, { 1, true });
        const bool same_form = paper.pictures == p.registers && paper.passes() == 15 && p.fused() && p.label == p.registers;
        if (!least || !same_form || p.instructions.size() != 15) {
            CAPTURE(trees, p.registers, paper.pictures);
            FAIL_CHECK("not the least");
        }
        CHECK(run<float>(paper, tree.nodes, colors) == run<float>(p, tree.nodes, colors));
    });
    CHECK(trees == 429);
    CHECK(histogram.size() == 3); // 2, 3 and, for the balanced one, 4
    CHECK(histogram[4] == 1);
}
