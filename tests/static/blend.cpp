// Plans of small blend trees, as constant expressions.
#include "ao/blend.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace {

using ao::blend_node;

constexpr int node(int i)
{
    return -1 - i;
}

struct shape {
    bool made = false;
    int registers = 0;
    int leaves = 0;
    int mixes = 0;
    int passes = 0;
    int pictures = 0;

    friend constexpr bool operator==(const shape&, const shape&) = default;
};

template <std::size_t N>
constexpr shape plan(const std::array<blend_node, N>& blends, const ao::blend_settings& settings = {})
{
    const std::array<ao::standard_material, 8> materials{};
    ao::scene s;
    s.materials = materials;
    s.blends = blends;
    auto planner = ao::blend_planner::create(s, settings);
    if (!planner) {
        return {};
    }
    const ao::blend_program p = planner->program(0);
    return { true, p.registers, p.leaves, p.mixes, p.passes(), p.pictures };
}

// Asphalt and snow.
static_assert(plan(std::array{ blend_node{ 0, 1 } }) == shape{ true, 2, 2, 1, 1, 0 });
static_assert(plan(std::array{ blend_node{ 0, 1 } }, { 1, true }) == shape{ true, 2, 2, 1, 3, 2 });

// Chains need two results either way round.
constexpr std::array right{ blend_node{ 0, node(1) }, blend_node{ 1, node(2) }, blend_node{ 2, node(3) }, blend_node{ 3, 4 } };
constexpr std::array left{ blend_node{ node(1), 0 }, blend_node{ node(2), 1 }, blend_node{ node(3), 2 }, blend_node{ 4, 3 } };
static_assert(plan(right) == shape{ true, 2, 5, 4, 1, 0 });
static_assert(plan(left) == shape{ true, 2, 5, 4, 1, 0 });
static_assert(plan(left, { 1, true }) == shape{ true, 2, 5, 4, 9, 2 });

// A balanced tree of 8 needs four, and with two registers a pass: pairs in one pass each.
constexpr std::array balanced{ blend_node{ node(1), node(2) },
                               blend_node{ node(3), node(4) },
                               blend_node{ node(5), node(6) },
                               blend_node{ 0, 1 },
                               blend_node{ 2, 3 },
                               blend_node{ 4, 5 },
                               blend_node{ 6, 7 } };
static_assert(plan(balanced) == shape{ true, 4, 8, 7, 1, 0 });
static_assert(plan(balanced, { 2, true }) == shape{ true, 2, 8, 7, 7, 3 });
static_assert(plan(balanced, { 3, true }) == shape{ true, 3, 8, 7, 3, 2 });

// k of 0 and 1 leave one child.
static_assert(plan(std::array{ blend_node{ 0, 1, 0.0F } }) == shape{ true, 1, 1, 0, 1, 0 });
static_assert(plan(std::array{ blend_node{ node(1), 3, 1.0F }, blend_node{ 0, 1 } }) == shape{ true, 1, 1, 0, 1, 0 });
static_assert(plan(std::array{ blend_node{ 0, 1, 0.0F } }, { 16, false }) == shape{ true, 2, 2, 1, 1, 0 });

// What is shared is evaluated once.
static_assert(plan(std::array{ blend_node{ node(1), node(1) }, blend_node{ node(2), node(2) }, blend_node{ 0, 1 } }) ==
              shape{ true, 2, 2, 3, 1, 0 });

// Refused: cycles, children that do not exist, k outside [0, 1].
static_assert(!plan(std::array{ blend_node{ 0, node(0) } }).made);
static_assert(!plan(std::array{ blend_node{ 0, node(1) }, blend_node{ node(0), 1 } }).made);
static_assert(!plan(std::array{ blend_node{ 0, 8 } }).made);
static_assert(!plan(std::array{ blend_node{ 0, node(1) } }).made);
static_assert(!plan(std::array{ blend_node{ 0, 1, 1.5F } }).made);
static_assert(!plan(std::array{ blend_node{ 0, 1, -0.1F } }).made);

// Both ends of a blend return the child, whatever the other is.
static_assert(std::bit_cast<std::uint32_t>(ao::blend(glm::vec3(-0.0F), glm::vec3(3.0F), 0.0F).x) == 0x80000000U);
static_assert(std::bit_cast<std::uint32_t>(ao::blend(glm::vec3(3.0F), glm::vec3(-0.0F), 1.0F).x) == 0x80000000U);
static_assert(ao::blend(glm::vec3(0.0F), glm::vec3(1.0F), 0.25F) == glm::vec3(0.25F));
static_assert(ao::clamp_mask(-0.5F) == 0 && ao::clamp_mask(1.5F) == 1 && ao::clamp_mask(0.5F) == 0.5F);
static_assert(ao::clamp_mask(std::numeric_limits<float>::quiet_NaN()) == 0);

} // namespace
