// Which widths the machine has, and their kernels.
#pragma once

#include "kernels.hpp"

#include "ao/cpu/backend.hpp"

namespace ao::cpu::detail {

width widest();

// Precondition: is_available(w), and not automatic.
const kernel_table& kernels_of(width w);

} // namespace ao::cpu::detail
