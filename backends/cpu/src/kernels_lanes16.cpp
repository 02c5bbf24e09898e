#include "instructions_lanes16.hpp"
#include "temporal_kernels.hpp"

namespace ao::cpu::detail {

const kernel_table& lanes16_kernels()
{
    return kernels_over<lanes<float, 16, avx512>>;
}

} // namespace ao::cpu::detail
