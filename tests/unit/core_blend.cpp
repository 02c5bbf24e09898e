// Plans of blend trees: as few results at a time as brute force finds, the right value, depth without recursion.
#include "ao/blend.hpp"
#include "unit/blend_trees.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace blend_test;

ao::blend_program plan(const blends& tree, int root, const ao::blend_settings& settings = {})
{
    auto planner = ao::blend_planner::create(tree.scene(), settings);
    REQUIRE(planner);
    return planner->program(root);
}

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

// The value of a program by running it: registers and pictures that hold more than they should are found here.
template <class Real>
glm::vec<3, Real> run(const ao::blend_program& p, const std::vector<blend_node>& nodes, const std::vector<glm::vec3>& leaves)
{
    using vec3 = glm::vec<3, Real>;
    std::vector<vec3> pictures(static_cast<std::size_t>(p.pictures));
    vec3 result(0);
    for (const ao::blend_segment& segment : p.segments) {
        std::vector<vec3> registers(static_cast<std::size_t>(p.registers), vec3(std::nanf("")));
        for (std::size_t i = segment.first; i < segment.first + segment.count; ++i) {
            const ao::blend_instruction& each = p.instructions[i];
            vec3& target = registers.at(static_cast<std::size_t>(each.target));
            const auto source = static_cast<std::size_t>(each.source);
            if (each.operation == ao::blend_operation::leaf) {
                target = vec3(leaves[source]);
            }
            else if (each.operation == ao::blend_operation::fetch) {
                target = pictures.at(source);
            }
            else {
                target = ao::blend(registers.at(static_cast<std::size_t>(each.first)),
                                   registers.at(static_cast<std::size_t>(each.second)), Real(nodes[source].k));
            }
            result = target;
        }
        if (segment.output != ao::blend_result) {
            pictures.at(static_cast<std::size_t>(segment.output)) = result;
        }
    }
    return result;
}

std::vector<glm::vec3> random_colors(std::size_t count, std::uint32_t seed)
{
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<glm::vec3> colors(count);
    for (glm::vec3& c : colors) {
        c = { uniform(engine), uniform(engine), uniform(engine) };
    }
    return colors;
}

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
