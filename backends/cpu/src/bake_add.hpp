// What lines contribute to the sums of receivers, N receivers side by side.
#pragma once

#include "bake_brute.hpp"

namespace ao::cpu::detail {

template <class Real>
struct bake_add {
    using w = wide<Real>;
    using pass = bake_pass<Real>;
    using reals = real_traits<Real>;
    using mask = typename w::mask;
    static constexpr std::size_t step = w::width;

    static void add_to(std::int32_t* sums, std::size_t i, Real whole) { w::store(sums + i, w::load(sums + i) + w::whole(whole)); }

    AO_BAKE_KERNEL static void add(const bake_task& task, const bake_line* lines, const bake_view* views, int count,
                                   const bake_totals& totals, std::size_t first, std::size_t last)
    {
        const bake_options& o = task.options;
        for (std::size_t i = first; i < last; i += step) {
            Real cosines[2]{ Real(0.0F), Real(0.0F) }; // 0 where the receiver does not look along the line
            Real opens[2]{ Real(1.0F), Real(1.0F) };
            for (int k = 0; k < count; ++k) {
                const bool both = lines[k].opposite > 0;
                const Real cosine = w::load(views[k].cosine + i);
                const Real open = w::load(views[k].open + i);
                const mask looks = cosine >= Real(0.0F) || mask(both);
                const mask back = cosine < Real(0.0F);
                const Real weight = reals::select(
                    Real(0.0F), pass::ao_bake_weight(Real(lines[k].weight), reals::abs(cosine), o.by_cosine), looks);
                const Real part = pass::ao_bake_part(weight, open);
                add_to(totals.parts[0], i, part);
                add_to(totals.parts[1], i, weight);
                add_to(totals.parts[3], i, reals::select(Real(0.0F), Real(1.0F), looks && cosine != Real(0.0F)));
                if (o.bent) {
                    const float d[3]{ lines[k].dx, lines[k].dy, lines[k].dz };
                    for (int axis = 0; axis < 3; ++axis) {
                        const Real along = reals::select(Real(d[axis]), Real(-d[axis]), back);
                        add_to(totals.parts[4 + axis], i, pass::ao_bake_part(part, along));
                    }
                }
                cosines[k] = reals::select(Real(0.0F), cosine, looks);
                opens[k] = open;
            }
            if (count == 2) {
                const Real change = pass::ao_bake_change(opens[0], opens[1], cosines[1], o.by_cosine);
                add_to(totals.parts[2], i, reals::select(Real(0.0F), change, cosines[0] * cosines[1] > Real(0.0F)));
            }
        }
    }
};

} // namespace ao::cpu::detail
