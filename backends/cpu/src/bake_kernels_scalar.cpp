#include "bake_trace.hpp"

namespace ao::cpu::detail {

const bake_kernel_table& bake_scalar_kernels()
{
    return bake_kernels_over<float>;
}

} // namespace ao::cpu::detail
