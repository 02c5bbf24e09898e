// Visibility of receivers along one line by the shared predicate for every triangle, N triangles side by side.
#pragma once

#include "bake_raster.hpp"

namespace ao::cpu::detail {

template <class Real>
struct bake_brute {
    using w = wide<Real>;
    using pass = bake_pass<Real>;
    using mask = typename w::mask;
    static constexpr std::size_t step = w::width;

    static void expand(const bake_task& task, const bake_brute_memory& m)
    {
        const bake_occluder_arrays& o = task.occluders;
        for (std::size_t i = 0; i < o.triangle_count; i += step) {
            for (int k = 0; k < 3; ++k) {
                const auto corner = w::load(o.corners[k] + i);
                w::store(m.corners[3 * k] + i, w::gather(m.points.u, corner));
                w::store(m.corners[3 * k + 1] + i, w::gather(m.points.w, corner));
                w::store(m.corners[3 * k + 2] + i, w::gather(m.points.d, corner));
            }
        }
    }

    static float open(const bake_task& task, const bake_brute_memory& m, const typename pass::ao_bake_point& start, bool along)
    {
        const Real reach(task.options.reach);
        const std::size_t count = task.occluders.triangle_count;
        float least = 1e30F;
        for (std::size_t i = 0; i < count; i += step) {
            const auto corner = [&](int k) {
                return typename pass::ao_bake_point{ w::load(m.corners[3 * k] + i), w::load(m.corners[3 * k + 1] + i),
                                                     w::load(m.corners[3 * k + 2] + i) };
            };
            const auto crossing = pass::ao_bake_crossing_of(start, corner(0), corner(1), corner(2));
            mask hit = along ? pass::ao_bake_ahead(crossing, reach) : pass::ao_bake_behind(crossing, reach);
            if (task.options.front) {
                hit = hit && (along ? crossing.turned : !crossing.turned);
            }
            unsigned lanes = w::packed(hit) & (count - i >= step ? ~0U : (1U << (count - i)) - 1U);
            if (lanes == 0) {
                continue;
            }
            if (task.options.falloff == 0) {
                return 0;
            }
            float distances[step];
            w::store(distances, pass::ao_bake_distance(crossing));
            for (; lanes != 0; lanes &= lanes - 1) {
                const float distance = distances[__builtin_ctz(lanes)];
                least = distance < least ? distance : least;
            }
        }
        if (least >= 1e30F) {
            return 1;
        }
        float lanes[step];
        w::store(lanes, pass::ao_bake_openness(Real(least), reach, task.options.falloff));
        return lanes[0];
    }

    AO_BAKE_KERNEL static void brute(const bake_task& task, const bake_line& line, bake_brute_memory& m, const bake_view& view,
                                     std::size_t first, std::size_t last, bake_second* seconds, std::size_t& second_count)
    {
        bake_raster_grid<Real>::see(line, task.occluders.points, task.occluders.point_count, m.points);
        expand(task, m);
        const auto l = wide_line<Real>(line);
        const bake_receiver_arrays& r = task.receivers;
        second_count = 0;
        for (std::size_t i = first; i < last; ++i) {
            const auto start =
                pass::ao_bake_seen(l, typename pass::vec3(Real(r.starts.x[i]), Real(r.starts.y[i]), Real(r.starts.z[i])));
            float cosines[step];
            w::store(cosines, pass::ao_bake_cosine(
                                  l, typename pass::vec3(Real(r.normals.x[i]), Real(r.normals.y[i]), Real(r.normals.z[i]))));
            const float cosine = cosines[0];
            const bool both = line.opposite > 0;
            view.cosine[i] = cosine;
            view.open[i] = 1;
            if (cosine >= 0 || both) {
                view.open[i] = open(task, m, start, cosine >= 0);
            }
            if (cosine == 0 && both) {
                seconds[second_count++] = { static_cast<std::uint32_t>(i), open(task, m, start, false) };
            }
        }
    }
};

} // namespace ao::cpu::detail
