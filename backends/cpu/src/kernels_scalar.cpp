#include "pass_kernels.hpp"

namespace ao::cpu::detail {

const kernel_table& scalar_kernels()
{
    return pass_kernels<float>::table;
}

} // namespace ao::cpu::detail
