#include "ao/cpu/bake.hpp"

#include "bake_lines.hpp"
#include "bake_rays.hpp"
#include "threads.hpp"
#include "width.hpp"

#include <string>
#include <utility>

namespace ao::cpu {

struct baker::state {
    width lanes;
    std::unique_ptr<detail::threads> workers;
};

namespace {

const detail::bake_kernel_table& bake_kernels_of(width w)
{
    switch (w) {
#if defined(AO_CPU_X86)
    case width::lanes16:
        return detail::bake_lanes16_kernels();
    case width::lanes8:
        return detail::bake_lanes8_kernels();
#endif
    case width::lanes4:
        return detail::bake_lanes4_kernels();
    default:
        return detail::bake_scalar_kernels();
    }
}

} // namespace

baker::baker(std::unique_ptr<state> s) : state_(std::move(s)) {}
baker::baker(baker&&) noexcept = default;
baker& baker::operator=(baker&&) noexcept = default;
baker::~baker() = default;

result<baker> baker::create(const options& o)
{
    const width lanes = o.lanes == width::automatic ? detail::widest() : o.lanes;
    if (!is_available(lanes)) {
        return error(errc::device, std::string("this machine or build does not have ") + std::string(name_of(lanes)));
    }
    auto workers = detail::make_threads(o);
    if (!workers) {
        return workers.error();
    }
    return baker(std::unique_ptr<state>(new state{ lanes, std::move(*workers) }));
}

width baker::lanes() const
{
    return state_->lanes;
}

int baker::threads() const
{
    return state_->workers->count();
}

bool baker::has(bake_route route)
{
    return route == bake_route::automatic || route == bake_route::raster || route == bake_route::brute ||
           route == bake_route::hierarchy;
}

result<bake_sums> baker::run(const bake_job& job, const bake_request& wanted)
{
    const auto request = checked_request(job, wanted);
    if (!request) {
        return request.error();
    }
    bake_sums sums{ request->first_vertex, request->last_vertex, request->first_line, request->last_line, {},
                    request->route,        "as asked for" };
    if (sums.route == bake_route::automatic) {
        sums.route = job.turned() ? bake_route::hierarchy : bake_route::raster;
        sums.reason = "chosen";
    }
    if (!has(sums.route)) {
        return error(errc::unsupported_format, "the CPU does not have this route");
    }
    if (job.turned() && (sums.route == bake_route::raster || sums.route == bake_route::brute)) {
        return error(errc::unsupported_format, "rules turned at each vertex are baked by rays: by the route hierarchy or embree");
    }
    try {
        sums.sums.resize(sums.last_vertex - sums.first_vertex);
        const detail::bake_kernel_table& kernels = bake_kernels_of(state_->lanes);
        if (sums.route == bake_route::hierarchy) {
            const auto done = detail::bake_by_vertices(job, *request, detail::tree_shooter(kernels), *state_->workers, sums);
            if (!done) {
                return done.error();
            }
        }
        else {
            detail::bake_by_lines(job, *request, kernels, *state_->workers, sums);
        }
    } catch (...) {
        return error(errc::out_of_memory, "there is no memory for this bake");
    }
    return sums;
}

} // namespace ao::cpu
