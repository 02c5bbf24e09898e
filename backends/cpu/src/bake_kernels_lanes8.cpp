#include "bake_trace.hpp"
#include "instructions_lanes8.hpp"

namespace ao::cpu::detail {

const bake_kernel_table& bake_lanes8_kernels()
{
    return bake_kernels_over<lanes<float, 8, avx2>>;
}

} // namespace ao::cpu::detail
