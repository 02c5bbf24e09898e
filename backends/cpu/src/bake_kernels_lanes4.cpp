#include "bake_trace.hpp"
#include "instructions_lanes4.hpp"

namespace ao::cpu::detail {

const bake_kernel_table& bake_lanes4_kernels()
{
    return bake_kernels_over<lanes<float, 4, sse2>>;
}

} // namespace ao::cpu::detail
