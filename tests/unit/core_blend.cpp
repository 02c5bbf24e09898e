// Plans of blend trees: the right value in every form, depth without recursion, what is pruned, shared and refused.
#include "unit/core_blend.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace core_test;

namespace {

double apart(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::max({ std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z) });
}

void check_against_truth(const blends& tree)
{
    const std::vector<glm::vec3> colors = random_colors(tree.materials.size(), 5);
    const std::vector<glm::dvec3> expected = truth(tree.nodes, { colors.begin(), colors.end() });
    const glm::vec3 whole = run<float>(plan(tree, 0), tree.nodes, colors);
    CHECK(apart(glm::dvec3(whole), expected[0]) <= 1e-6 * depth_of(tree.nodes));
    for (const int registers : { 1, 2, 3, 5 }) {
        const ao::blend_program cut = plan(tree, 0, { registers, true });
        CHECK(cut.registers <= std::max(registers, 2));
        CHECK(run<float>(cut, tree.nodes, colors) == whole); // the form changes no bit
    }
}

} // namespace

TEST_CASE("Chains of every depth need two results and give the value in double", "[core][blend]")
{
    const bool left = GENERATE(false, true);
    for (int depth : { 1, 2, 3, 10, 100, 1023, 1024, 4096 }) {
        const blends tree = chain(depth, left);
        const ao::blend_program p = plan(tree, 0);
        CAPTURE(depth, left);
        CHECK(p.registers == 2);
        CHECK(p.passes() == 1);
        CHECK(p.leaves == depth + 1);
        CHECK(plan(tree, 0, { 1, true }).pictures == 2);
        check_against_truth(tree);
    }
}

TEST_CASE("Balanced and random trees need the Sethi-Ullman number and give the value in double", "[core][blend]")
{
    const blends balanced = balanced_tree(4096);
    const ao::blend_program p = plan(balanced, 0);
    CHECK(p.registers == 13);
    CHECK(sethi_ullman(balanced.nodes) == 13);
    CHECK(p.fused());
    CHECK(plan(balanced, 0, { 1, true }).pictures == 13);
    CHECK(plan(balanced, 0, { 1, true }).passes() == 8191);
    CHECK(plan(balanced, 0, { 4, true }).passes() == 512 + 511); // subtrees of 8 leaves, and the blends above them
    CHECK(plan(balanced, 0, { 4, true }).pictures == 10);
    check_against_truth(balanced);
    std::mt19937 engine(11);
    for (int i = 0; i < 40; ++i) {
        const int leaves = 2 + static_cast<int>(engine() % 500);
        const blends tree =
            split_tree(leaves, [&](int count) { return 1 + static_cast<int>(engine() % static_cast<unsigned>(count - 1)); });
        CHECK(plan(tree, 0).registers == sethi_ullman(tree.nodes));
        CHECK(sethi_ullman(tree.nodes) <= static_cast<int>(std::bit_width(static_cast<unsigned>(leaves))));
        check_against_truth(tree);
    }
}

TEST_CASE("A million blends in a row are planned without recursion", "[core][blend]")
{
    const int depth = 1000000;
    blends row(2);
    for (int i = 0; i < depth; ++i) {
        row.nodes.push_back({ i + 1 < depth ? node(i + 1) : 0, 1, 0.5F, ao::no_texture });
    }
    const ao::blend_program p = plan(row, 0);
    CHECK(p.registers == 2);
    CHECK(p.mixes == depth);
    CHECK(plan(row, 0, { 1, true }).passes() == 2 * depth + 1);
}

TEST_CASE("Shared subtrees are evaluated once", "[core][blend]")
{
    const blends shared = self_shared(40);
    const ao::blend_program p = plan(shared, 0);
    CHECK(p.leaves == leaves_of(shared.nodes));
    CHECK(p.mixes == 41);
    CHECK(p.registers == 2);
    check_against_truth(shared);

    const blends rungs = ladder(60);
    const ao::blend_program q = plan(rungs, 0);
    CHECK(q.leaves == leaves_of(rungs.nodes));
    CHECK(q.mixes == 61);
    CHECK(q.registers <= 62);
    check_against_truth(rungs);
}

TEST_CASE("Constant masks and weights of 0 and 1 leave their child", "[core][blend]")
{
    std::vector<std::uint8_t> black(4 * 16, 0);
    std::vector<std::uint8_t> white(4 * 16, 255);
    std::vector<std::uint8_t> mixed = white;
    mixed[4 * 7] = 254;
    std::vector<std::uint8_t> grey(4 * 16, 128);
    blends tree(3);
    for (const auto* texels : { &black, &white, &mixed, &grey }) {
        ao::texture t;
        t.width = t.height = 4;
        t.texels = *texels;
        tree.textures.push_back(t);
    }
    const auto leaf_of = [&](const blend_node& n, const ao::blend_settings& settings = {}) {
        tree.nodes = { n };
        const ao::blend_program p = plan(tree, 0, settings);
        return p.instructions.size() == 1 ? p.instructions[0].source : -1;
    };
    CHECK(leaf_of({ 1, 2, 0.5F, 0 }) == 1);
    CHECK(leaf_of({ 1, 2, 0.5F, 1 }) == 2);
    CHECK(leaf_of({ 1, 2, 0.5F, 2 }) == -1);
    CHECK(leaf_of({ 1, 2, 0.5F, 3 }) == -1);
    CHECK(leaf_of({ 1, 2, 0.0F, ao::no_texture }) == 1);
    CHECK(leaf_of({ 1, 2, 1.0F, ao::no_texture }) == 2);
    CHECK(leaf_of({ 1, 2, 1.0F, ao::no_texture }, { 16, false }) == -1); // k may change
    CHECK(leaf_of({ 1, 2, 0.5F, 1 }, { 16, false }) == 2);               // a mask does not

    // A pruned branch costs nothing, however large.
    blends large = balanced_tree(1000);
    large.nodes[0].k = 0;
    const int left = large.nodes[0].first;
    const ao::blend_program p = plan(large, 0);
    CHECK(p.leaves == 500);
    CHECK(p.instructions == plan(large, -1 - left).instructions);
}

TEST_CASE("The ends of a blend are the child's bits, whatever the other child is", "[core][blend]")
{
    const float infinite = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    for (const float child : { 0.0F, -0.0F, 1.0F, 0.1F, 3e38F, 1e-42F, infinite }) {
        for (const float other : { 0.0F, 1.0F, infinite, nan, -3e38F }) {
            CHECK(bits(ao::blend(glm::vec3(child), glm::vec3(other), 0.0F).y) == bits(child));
            CHECK(bits(ao::blend(glm::vec3(other), glm::vec3(child), 1.0F).z) == bits(child));
        }
    }
    CHECK(ao::clamp_mask(nan) == 0);
    CHECK(ao::clamp_mask(infinite) == 1);
    CHECK(ao::clamp_mask(-infinite) == 0);
}

TEST_CASE("Blends that make no sense are refused with a reason", "[core][blend]")
{
    blends tree(2);
    const auto reason = [&](std::vector<blend_node> nodes) {
        tree.nodes = std::move(nodes);
        const auto planner = ao::blend_planner::create(tree.scene());
        return planner ? std::string() : std::string(planner.error().reason());
    };
    CHECK(reason({ { 0, 1, 0.5F, ao::no_texture } }).empty());
    CHECK(reason({ { 0, node(0), 0.5F, ao::no_texture } }) == "blend 0 contains itself");
    CHECK(reason({ { 0, node(1), 0.5F, ao::no_texture },
                   { node(2), 1, 0.5F, ao::no_texture },
                   { node(0), 0, 0.5F, ao::no_texture } }) == "blend 0 contains itself");
    CHECK(reason({ { 0, 2, 0.5F, ao::no_texture } }) == "blend 0: no material 2");
    CHECK(reason({ { 0, node(7), 0.5F, ao::no_texture } }) == "blend 0: no blend 7");
    CHECK(reason({ { 0, 1, 0.5F, 3 } }) == "blend 0: no texture 3 for its mask");
    CHECK(reason({ { 0, 1, std::nanf(""), ao::no_texture } }) == "blend 0: k is not a number in [0, 1]");
    CHECK(reason({ { 0, 1, 1.001F, ao::no_texture } }) == "blend 0: k is not a number in [0, 1]");
}
