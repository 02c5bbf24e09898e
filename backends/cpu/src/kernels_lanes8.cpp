#include "instructions_lanes8.hpp"
#include "temporal_kernels.hpp"

namespace ao::cpu::detail {

const kernel_table& lanes8_kernels()
{
    return kernels_over<lanes<float, 8, avx2>>;
}

} // namespace ao::cpu::detail
