// Bakes vertex by vertex: every thread takes vertices, and all lines with each.
#pragma once

#include "bake_kernels.hpp"
#include "bake_memory.hpp"
#include "threads.hpp"

#include "ao/bake.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace ao::cpu::detail {

// Shoots the rays of receivers of a group, from several threads at once.
class bake_ray_shooter {
public:
    virtual ~bake_ray_shooter() = default;
    // As bake_kernel_table::trace.
    virtual void shoot(const bake_ray_task& rays, std::size_t receiver, std::size_t first, std::size_t last,
                       const bake_view& view, float* seconds) const = 0;
};

using make_bake_shooter = std::function<result<std::unique_ptr<bake_ray_shooter>>(const bake_group&)>;

// Through the tree of boxes.
make_bake_shooter tree_shooter(const bake_kernel_table& kernels);

// sums: route and range as wanted, all sums 0. Where progress ends the bake, sums.last_vertex is what was done.
result<success> bake_by_vertices(const bake_job& job, const bake_request& request, const make_bake_shooter& make,
                                 threads& workers, bake_sums& sums);

// Adds lines first ... last - 1 of some receivers of a group to their sums.
void add_rays(const bake_job& job, const bake_group& group, const bake_kernel_table& kernels,
              const std::vector<std::uint32_t>& receivers, std::size_t first, std::size_t last, threads& workers,
              bake_sums& sums);

} // namespace ao::cpu::detail
