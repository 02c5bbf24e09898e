// One faulty copy of the shared source, in a namespace of its own: `ao` is defined as its name when this is compiled, and the
// copy's directory comes first on the include path.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#define ao AO_PLANTED_NAMESPACE
#include "ao/conformance/functions.hpp"

namespace AO_PLANTED_NAMESPACE {

void evaluate(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b, std::span<glm::vec4> out)
{
    for (std::size_t i = 0; i < a.size(); ++i) {
        out[i] = conformance::evaluator<float>::ao_evaluate(function, a[i], b[i]);
    }
}

} // namespace AO_PLANTED_NAMESPACE
