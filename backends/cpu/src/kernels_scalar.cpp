#include "temporal_kernels.hpp"

namespace ao::cpu::detail {

const kernel_table& scalar_kernels()
{
    return kernels_over<float>;
}

} // namespace ao::cpu::detail
