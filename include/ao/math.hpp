// The shared mathematics for one Real type: float, double, lanes<float, N> or interval.
// Compile with -ffp-contract=off (ao::strict_fp) where results must equal those of the shaders.
#pragma once

#include "ao/detail/bits.hpp"
#include "ao/real.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "ao/detail/shared_begin.inc"

namespace ao {

template <class Real>
struct math {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"

namespace ao {

// The constants of a pass for another Real type: every shared constants struct consists of reals only.
// `To` and `From` are the same struct of math<> or a pass over two Real types.
template <class To, class ToReal, class From, class FromReal>
constexpr To convert_constants(const From& from)
{
    constexpr std::size_t count = sizeof(From) / sizeof(FromReal);
    static_assert(sizeof(To) == count * sizeof(ToReal));
    const auto values = std::bit_cast<std::array<FromReal, count>>(from);
    std::array<ToReal, count> converted{};
    for (std::size_t i = 0; i < count; ++i) {
        converted[i] = ToReal(values[i]);
    }
    return std::bit_cast<To>(converted);
}

} // namespace ao
