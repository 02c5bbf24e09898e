// Visibility of all receivers along one line (the direction-major irregular raster of Aila and Laine, "Alias-free shadow maps",
// 2004, without a depth map): starts are sorted into cells of a grid across the line, and every triangle runs over the starts in
// its cells.
#pragma once

#include "bake_raster_cover.hpp"

namespace ao::cpu::detail {

template <class Real>
struct bake_raster {
    using w = wide<Real>;
    using pass = bake_pass<Real>;
    using grid = bake_raster_grid<Real>;
    using covering = bake_raster_cover<Real>;
    static constexpr std::size_t step = w::width;

    // Openness of every receiver from the bits of the samples.
    static void collect(const bake_task& task, const grid& g, bake_raster_memory& m, const bake_view& view)
    {
        for (std::size_t i = 0; i < task.receivers.count; i += step) {
            w::store(view.open + i, Real(1.0F));
        }
        const auto openness = [&](std::size_t sample) {
            if (task.options.falloff == 0) {
                return 0.0F;
            }
            float lanes[w::width];
            w::store(lanes, pass::ao_bake_openness(Real(m.distances[sample]), Real(task.options.reach), task.options.falloff));
            return lanes[0];
        };
        for (int group = 0; group < bake_groups; ++group) {
            const std::int32_t begin = m.first[group * g.group_pitch()];
            const std::int32_t end = m.first[group * g.group_pitch() + g.cells()];
            for (std::size_t word = static_cast<std::size_t>(begin) / 64; word * 64 < static_cast<std::size_t>(end); ++word) {
                for (std::uint64_t rest = m.hit[word]; rest != 0; rest &= rest - 1) {
                    const std::size_t sample = word * 64 + static_cast<std::size_t>(__builtin_ctzll(rest));
                    if (sample < static_cast<std::size_t>(begin) || sample >= static_cast<std::size_t>(end)) {
                        continue;
                    }
                    const std::int32_t receiver = m.receivers[sample];
                    const float open = openness(sample);
                    if (receiver < 0) {
                        m.seconds[-1 - receiver].open = open;
                    }
                    else {
                        view.open[receiver] = open;
                    }
                }
            }
        }
    }

    // Whether some sample is doubtful, and was not hit by anything else.
    static bool is_doubtful(const bake_raster_memory& m)
    {
        if (m.doubtful_count > bake_most_doubtful) {
            return true;
        }
        for (std::size_t i = 0; i < m.doubtful_count; ++i) {
            const auto sample = static_cast<std::size_t>(m.doubtful[i]);
            if ((m.hit[sample / 64] >> (sample % 64) & 1U) == 0) {
                return true;
            }
        }
        return false;
    }

    // By the triangles that rays enter closed surfaces by; where that leaves a doubt, by all. Where it often does, by all at
    // once.
    static void cover_plain(const bake_task& task, const bake_line& line, const grid& g, bake_raster_memory& m)
    {
        const bool entered = task.occluders.closed != nullptr && m.repeated <= 8 + m.lines / 4;
        m.doubtful_count = 0;
        covering::template cover_all<true>(task, line, g, m, entered);
        if (!entered) {
            return;
        }
        ++m.lines;
        if (is_doubtful(m)) {
            ++m.repeated;
            covering::template cover_all<true>(task, line, g, m, false);
        }
    }

    AO_BAKE_KERNEL static void raster(const bake_task& task, const bake_line& line, bake_raster_memory& m, const bake_view& view)
    {
        const grid g = grid::receive(task, line, m, view);
        g.sort(task, line, m, view);
        const std::size_t samples = task.receivers.count + m.second_count + bake_groups * bake_padding;
        for (std::size_t i = 0; i <= samples / 64 + 1; ++i) {
            m.hit[i] = 0;
        }
        if (task.options.falloff != 0) {
            for (std::size_t i = 0; i < samples; ++i) {
                m.distances[i] = 1e30F;
            }
        }
        if (is_plain(task.options)) {
            cover_plain(task, line, g, m);
        }
        else {
            covering::template cover_all<false>(task, line, g, m, false);
        }
        collect(task, g, m, view);
    }
};

} // namespace ao::cpu::detail
