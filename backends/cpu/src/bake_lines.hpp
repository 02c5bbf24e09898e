// Bakes line by line: every thread takes pairs of neighbouring lines, and all receivers with each.
#pragma once

#include "bake_kernels.hpp"
#include "threads.hpp"

#include "ao/bake.hpp"

namespace ao::cpu::detail {

// sums: route and range as wanted, all sums 0. Where progress ends the bake, sums.last_line is what was done.
void bake_by_lines(const bake_job& job, const bake_request& request, const bake_kernel_table& kernels, threads& workers,
                   bake_sums& sums);

} // namespace ao::cpu::detail
