// Visibility of one receiver along N lines at once, by rays through the tree of boxes.
#pragma once

#include "bake_add.hpp"

namespace ao::cpu::detail {

template <class Real>
struct bake_tracer {
    using w = wide<Real>;
    using pass = bake_pass<Real>;
    using mask = typename w::mask;
    using reals = real_traits<Real>;
    static constexpr std::size_t step = w::width;

    struct resources {
        const bake_ray_task& rays;
        const bake_occluder_arrays& occluders;

        template <class Box>
        Box box(int node) const
        {
            const bake_node& n = rays.nodes[node];
            using vec3 = typename pass::vec3;
            return { vec3(Real(n.low.x), Real(n.low.y), Real(n.low.z)), vec3(Real(n.high.x), Real(n.high.y), Real(n.high.z)),
                     static_cast<int>(n.first), static_cast<int>(n.count) };
        }
        typename pass::vec3 corner(int triangle, int k) const
        {
            const std::int32_t p = occluders.corners[k][triangle];
            return { Real(occluders.points.x[p]), Real(occluders.points.y[p]), Real(occluders.points.z[p]) };
        }
    };

    using trace_pass = bake_trace_pass<Real, resources>;
    using line = typename trace_pass::ao_bake_line;

    static line load(const bake_ray_task& rays, std::size_t i)
    {
        const auto& f = rays.lines;
        line l{ w::load(f[0] + i), w::load(f[1] + i), w::load(f[2] + i), w::load(f[3] + i), w::load(f[4] + i),  w::load(f[5] + i),
                w::load(f[6] + i), w::load(f[7] + i), w::load(f[8] + i), w::load(f[9] + i), w::load(f[10] + i), Real(0.0F) };
        if (rays.turn == nullptr) {
            return l;
        }
        const float* t = rays.turn;
        const typename trace_pass::ao_rotation turn{ Real(t[0]), Real(t[1]), Real(t[2]), Real(0.0F), Real(t[3]), Real(t[4]),
                                                     Real(t[5]), Real(0.0F), Real(t[6]), Real(t[7]), Real(t[8]), Real(0.0F) };
        return trace_pass::ao_bake_turned(turn, l);
    }

    static Real open(const bake_task& task, trace_pass& p, const line& l, Real sign, const typename pass::vec3& start,
                     mask active)
    {
        const bake_options& o = task.options;
        const Real reach(o.reach);
        Real open(1.0F);
        if (task.occluders.triangle_count > 0) {
            const Real nearest = p.ao_bake_trace(l, sign, start, reach, active);
            open = reals::select(open, pass::ao_bake_openness(nearest, reach, o.falloff), nearest >= Real(0.0F));
        }
        if (o.ground) {
            const typename pass::vec4 plane(Real(o.ground_plane[0]), Real(o.ground_plane[1]), Real(o.ground_plane[2]),
                                            Real(o.ground_plane[3]));
            const typename pass::ao_bake_line as_pass{ l.ux, l.uy, l.uz, l.wx,     l.wy,       l.wz,
                                                       l.dx, l.dy, l.dz, l.weight, l.opposite, l.reserved };
            const Real distance = pass::ao_bake_ground(plane, as_pass, start, sign);
            const Real over = pass::ao_bake_openness(distance, reach, o.falloff);
            open = reals::select(open, reals::min(open, over), distance >= Real(0.0F) && distance <= reach);
        }
        return open;
    }

    AO_BAKE_KERNEL static void trace(const bake_task& task, const bake_ray_task& rays, std::size_t receiver, std::size_t first,
                                     std::size_t last, const bake_view& view, float* seconds)
    {
        trace_pass p{ .resources = { rays, task.occluders },
                      .ao_front_only = task.options.front,
                      .ao_find_nearest = task.options.falloff != 0 };
        const bake_receiver_arrays& r = task.receivers;
        const typename pass::vec3 start(Real(r.starts.x[receiver]), Real(r.starts.y[receiver]), Real(r.starts.z[receiver]));
        const typename pass::vec3 normal(Real(r.normals.x[receiver]), Real(r.normals.y[receiver]), Real(r.normals.z[receiver]));
        for (std::size_t i = first; i < last; i += step) {
            const line l = load(rays, i);
            const typename pass::ao_bake_line for_cosine{ l.ux, l.uy, l.uz, l.wx,     l.wy,       l.wz,
                                                          l.dx, l.dy, l.dz, l.weight, l.opposite, l.reserved };
            const Real cosine = pass::ao_bake_cosine(for_cosine, normal);
            const mask both = l.opposite > Real(0.0F);
            const mask looks = (cosine >= Real(0.0F) || both) && l.weight != Real(0.0F);
            const Real sign = reals::select(Real(1.0F), Real(-1.0F), cosine < Real(0.0F));
            w::store(view.cosine + i, cosine);
            w::store(view.open + i, open(task, p, l, sign, start, looks));
            const mask across = cosine == Real(0.0F) && both;
            if (w::packed(across) != 0) {
                w::store(seconds + i, open(task, p, l, Real(-1.0F), start, across));
            }
        }
    }
};

template <class Real>
inline constexpr bake_kernel_table bake_kernels_over{ bake_raster<Real>::raster, bake_brute<Real>::brute, bake_add<Real>::add,
                                                      bake_tracer<Real>::trace };

} // namespace ao::cpu::detail
