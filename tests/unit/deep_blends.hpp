// Deep, wide and shared trees of blends through any executor of shading plans: against double, in as few targets as can be, and
// the ends of a weight.
#pragma once

#include "ao/color.hpp"
#include "unit/blend_trees.hpp"
#include "unit/shade_cases.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace shade_test {

// What a few pixels show: materials and blends as objects name them. Every pixel has another visibility.
struct pixel_row {
    std::vector<int> materials;
    std::vector<glm::vec2> uvs; // empty: 0

    ao::shade_facts facts() const
    {
        ao::shade_facts f;
        f.width = static_cast<int>(materials.size());
        f.height = 1;
        f.stored_position = true;
        f.normal_format = pixel_format::rgba32f;
        return f;
    }
    std::vector<ao::object> objects() const
    {
        std::vector<ao::object> made(materials.size());
        for (std::size_t i = 0; i < made.size(); ++i) {
            made[i].material = materials[i];
        }
        return made;
    }
    float visibility(std::size_t i) const { return static_cast<float>(i) / static_cast<float>(materials.size()); }
    ao::conformance::shade_inputs inputs() const
    {
        const auto width = static_cast<int>(materials.size());
        ao::conformance::shade_inputs in;
        in.geometry = in.normal = in.surface = in.frame = ao::picture(pixel_format::rgba32f, width, 1);
        in.ids = ao::picture(pixel_format::rg32ui, width, 1);
        in.visibility = ao::picture(pixel_format::r32f, width, 1);
        for (std::size_t i = 0; i < materials.size(); ++i) {
            in.geometry.set_texel(i, glm::vec4(0, 0, -5, 1));
            in.normal.set_texel(i, glm::vec4(0, 0, 1, 0));
            in.surface.set_texel(i, glm::vec4(uvs.empty() ? glm::vec2(0) : uvs[i], 0, 1));
            in.ids.set_texel(i, glm::uvec2(static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>(materials[i] + 1)));
            in.visibility.set_texel(i, visibility(i));
        }
        return in;
    }
};

struct shaded_row {
    ao::shade_plan plan;
    ao::picture color;

    glm::vec4 at(std::size_t i) const { return color.texel<glm::vec4>(i); }
};

// Requires the reference's bits.
inline shaded_row shade_row(const run_function& run, ao::scene s, const pixel_row& row, const ao::blend_settings& settings)
{
    const std::vector<ao::object> objects = row.objects();
    const ao::mesh none;
    s.meshes = { &none, 1 };
    s.objects = objects;
    auto plan = ao::make_shade_plan(s, row.facts(), camera(false), settings);
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap(s.textures);
    REQUIRE(heap);
    outcome made = require_bits(run, *plan, *heap, row.inputs());
    return { std::move(*plan), std::move(made.color) };
}

// Root and leaf side by side; the root's pixels within 1e-6 per blend of the definition in double.
inline ao::shade_plan check_tree(const run_function& run, blend_test::blends tree, const ao::blend_settings& settings)
{
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (ao::standard_material& m : tree.materials) {
        m.emission = { uniform(engine), uniform(engine), uniform(engine) };
        m.ambient = { uniform(engine), uniform(engine), uniform(engine) };
    }
    ao::scene s = tree.scene();
    s.ambient = ao::ambient_light(glm::vec3(0.5F, 0.25F, 1));
    const pixel_row row{ { -1, 0, -1, -1, 1, -1, -1 }, {} };
    shaded_row made = shade_row(run, s, row, settings);
    double worst = 0;
    for (std::size_t i = 0; i < row.materials.size(); ++i) {
        std::vector<glm::dvec3> leaves;
        for (const ao::standard_material& m : tree.materials) {
            leaves.push_back(glm::dvec3(m.emission) +
                             glm::dvec3(m.ambient) * glm::dvec3(0.5, 0.25, 1) * static_cast<double>(row.visibility(i)));
        }
        const glm::dvec3 exact =
            row.materials[i] < 0 ? blend_test::truth(tree.nodes, leaves)[0] : leaves[static_cast<std::size_t>(row.materials[i])];
        for (int channel = 0; channel < 3; ++channel) {
            worst = std::max(worst, std::abs(static_cast<double>(made.at(i)[channel]) - exact[channel]));
        }
        CHECK(made.at(i).w == 1);
    }
    CAPTURE(worst, tree.materials.size(), settings.registers);
    CHECK(worst <= 1e-6 * blend_test::depth_of(tree.nodes));
    return std::move(made.plan);
}

// A tree in one pass, and as in the paper: no more results at a time than Sethi and Ullman's number.
inline void check_forms(const run_function& run, const blend_test::blends& tree)
{
    const int least = blend_test::sethi_ullman(tree.nodes);
    INFO(tree.materials.size() << " leaves");
    const ao::shade_plan fused = check_tree(run, tree, {});
    CHECK(fused.targets == 0);
    CHECK(fused.passes.size() == 1);
    CHECK(fused.blends.at(0).registers == least);
    const ao::shade_plan paper = check_tree(run, tree, { 1, true });
    CHECK(paper.targets == least);
    CHECK(paper.passes.size() == 1 + tree.materials.size() + tree.nodes.size());
}

inline void check_deep_blends(const run_function& run)
{
    for (const int depth : { 1, 2, 16, 1024 }) {
        check_forms(run, blend_test::chain(depth, true));
        check_forms(run, blend_test::chain(depth, false));
    }
    const blend_test::blends balanced = blend_test::balanced_tree(4096);
    check_forms(run, balanced);
    const ao::shade_plan cut = check_tree(run, balanced, { 4, true });
    CHECK(cut.targets == blend_test::sethi_ullman(balanced.nodes, 4));
    CHECK(cut.blends.at(0).registers == 4);
}

// As trees these have up to 2^41 leaves.
inline void check_shared_blends(const run_function& run)
{
    for (const int registers : { 16, 1 }) {
        for (const blend_test::blends& tree : { blend_test::self_shared(40), blend_test::ladder(12) }) {
            const ao::shade_plan plan = check_tree(run, tree, { registers, true });
            CHECK(plan.blends.at(0).leaves == blend_test::leaves_of(tree.nodes));
            CHECK(plan.blends.at(0).mixes == static_cast<int>(tree.nodes.size()));
        }
    }
}

// Weights of 0 and 1, as k and in masks, pruned and not: the child's bits, even if the other child is infinite.
inline void check_blend_ends(const run_function& run)
{
    const std::array<std::uint8_t, 16> black{};
    const std::array<std::uint8_t, 16> both{ 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255 };
    const std::array<std::uint8_t, 16> white{ 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255 };
    std::array<ao::texture, 3> textures;
    textures[0].texels = black;
    textures[1].texels = both;
    textures[2].texels = white;
    for (ao::texture& t : textures) {
        t.width = 4;
        t.height = 1;
    }
    std::array<ao::standard_material, 2> materials;
    materials[0].emission = { 0.1F, 0.2F, 1e-42F };
    materials[1].emission = { 0.7F, 3e38F, 3e38F };
    materials[1].ambient = { 0.3F, 0.9F, 3e38F };
    const float unused = 0.5F;
    const std::array<ao::blend_node, 7> nodes{ {
        { 0, 1, 0, ao::no_texture },
        { 0, 1, 1, ao::no_texture },
        { 0, 1, unused, 0 },
        { 0, 1, unused, 2 },
        { 0, 1, unused, 1 },  // 0, 0, 1, 1
        { -5, 1, unused, 1 }, // the same again
        { 1, -5, 0.25F, ao::no_texture },
    } };
    ao::scene s;
    s.textures = textures;
    s.materials = materials;
    s.blends = nodes;
    s.ambient = ao::ambient_light(glm::vec3(3)); // the second material is infinitely bright
    // Centres of texels, far from both ends of the texture's repetition where it changes.
    const float dark = 0.375F;
    const float light = 0.625F;
    const pixel_row blends{ { -1, -2, -3, -4, -5, -5, -6, -6 },
                            { { dark, 0.5F },
                              { dark, 0.5F },
                              { light, 0.5F },
                              { dark, 0.5F },
                              { dark, 0.5F },
                              { light, 0.5F },
                              { dark, 0.5F },
                              { light, 0.5F } } };
    const pixel_row children{ { 0, 1, 0, 1, 0, 1, 0, 1 }, blends.uvs };
    const shaded_row expected = shade_row(run, s, children, {});
    CHECK(std::isinf(expected.at(1).z));
    CHECK(expected.at(2).x != expected.at(3).x);
    for (const ao::blend_settings& settings : { ao::blend_settings{ 16, true }, { 16, false }, { 1, true }, { 1, false } }) {
        INFO("registers " << settings.registers << ", fixed k " << settings.fixed_k);
        CHECK(differing(shade_row(run, s, blends, settings).color, expected.color) == 0);
    }
    // Between the ends it is neither child.
    const pixel_row between{ { -7, 1, 0 }, { { dark, 0.5F }, { dark, 0.5F }, { dark, 0.5F } } };
    const shaded_row made = shade_row(run, s, between, {});
    CHECK(made.at(0).x != made.at(1).x);
    CHECK(made.at(0).x != made.at(2).x);
}

// Black and white pictures of sRGB at 0.5 are half the light of white, which is code 188.
inline void check_linear_light(const run_function& run)
{
    const std::array<std::uint8_t, 4> black{ 0, 0, 0, 255 };
    const std::array<std::uint8_t, 4> white{ 255, 255, 255, 255 };
    std::array<ao::texture, 2> textures;
    textures[0].texels = black;
    textures[1].texels = white;
    std::array<ao::standard_material, 2> materials;
    for (std::size_t i = 0; i < 2; ++i) {
        textures[i].width = textures[i].height = 1;
        textures[i].srgb = true;
        materials[i].diffuse_map = static_cast<int>(i);
    }
    const std::array<ao::blend_node, 1> half{ { { 0, 1, 0.5F, ao::no_texture } } };
    ao::scene s;
    s.textures = textures;
    s.materials = materials;
    s.blends = half;
    // The two pixels' visibility is 0 and 1/2.
    s.ambient = ao::ambient_light(glm::vec3(2));
    const shaded_row made = shade_row(run, s, { { -1, -1 }, {} }, {});
    CHECK(ao::display_code(made.at(1).x) == 188);
    CHECK(ao::display_code(made.at(1).y) == 188);
    CHECK(ao::display_code(made.at(1).z) == 188);
    CHECK(ao::display_code(made.at(0).x) == 0);
}

} // namespace shade_test
