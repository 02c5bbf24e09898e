#include "instructions_lanes4.hpp"
#include "temporal_kernels.hpp"

namespace ao::cpu::detail {

const kernel_table& lanes4_kernels()
{
    return kernels_over<lanes<float, 4, sse2>>;
}

} // namespace ao::cpu::detail
