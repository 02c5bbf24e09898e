#include "bake_trace.hpp"
#include "instructions_lanes16.hpp"

namespace ao::cpu::detail {

const bake_kernel_table& bake_lanes16_kernels()
{
    return bake_kernels_over<lanes<float, 16, avx512>>;
}

} // namespace ao::cpu::detail
