// Planning trees of blends and running the programs without any picture.
#pragma once

#include "ao/blend.hpp"
#include "unit/blend_trees.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace core_test {

using namespace blend_test;

inline ao::blend_program plan(const blends& tree, int root, const ao::blend_settings& settings = {})
{
    auto planner = ao::blend_planner::create(tree.scene(), settings);
    REQUIRE(planner);
    return planner->program(root);
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

inline std::vector<glm::vec3> random_colors(std::size_t count, std::uint32_t seed)
{
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<glm::vec3> colors(count);
    for (glm::vec3& c : colors) {
        c = { uniform(engine), uniform(engine), uniform(engine) };
    }
    return colors;
}

} // namespace core_test
