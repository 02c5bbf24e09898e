#include "ao/cpu/bake.hpp"

#if defined(AO_CPU_EMBREE)
#include "bake_embree.hpp"
#endif
#include "bake_lines.hpp"
#include "bake_rays.hpp"
#include "threads.hpp"
#include "width.hpp"

#include "ao/bake_route.hpp"

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
    switch (route) {
    case bake_route::automatic:
    case bake_route::brute:
    case bake_route::hierarchy:
    case bake_route::raster:
        return true;
    case bake_route::embree:
#if defined(AO_CPU_EMBREE)
        return true;
#endif
    default:
        return false;
    }
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
        const bake_choice choice = choose_bake_route(job, sums.last_vertex - sums.first_vertex);
        sums.route = choice.route;
        sums.reason = std::string_view(choice.why);
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
        const bool by_embree = sums.route == bake_route::embree;
        if (sums.route == bake_route::hierarchy || by_embree) {
            detail::make_bake_shooter shooter = detail::tree_shooter(kernels);
#if defined(AO_CPU_EMBREE)
            if (by_embree) {
                shooter = detail::embree_shooter();
            }
#endif
            const auto done = detail::bake_by_vertices(job, *request, shooter, *state_->workers, sums);
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
