// Starts across a line: in groups by what they must meet, and sorted into the cells of a grid.
#pragma once

#include "bake_kernels.hpp"
#include "bake_wide.hpp"

namespace ao::cpu::detail {

// Groups of samples: those that look along d, and those that look along -d.
inline constexpr int bake_groups = 2;
// Tiles across the grid, each way, at most; one more row and column around them.
inline constexpr int bake_most_tiles = 64;
inline constexpr int bake_tile_pitch = bake_most_tiles + 1;
inline constexpr int bake_tiles = bake_tile_pitch * bake_tile_pitch;

template <class Real>
struct bake_raster_grid {
    using w = wide<Real>;
    using pass = bake_pass<Real>;
    using integer = typename w::integer;
    using mask = typename w::mask;
    using reals = real_traits<Real>;
    static constexpr std::size_t step = w::width;
    static constexpr float far_away = 3e7F; // steps: beyond every point

    float left;
    float top;
    float to_column;
    float to_row;
    float to_tile_column;
    float to_tile_row;
    int columns;
    int rows;
    int tiles;

    static integer place(Real x, float first, float scale, int count)
    {
        const Real cells = (x - Real(first)) * Real(scale);
        return w::whole(w::min(w::max(cells, Real(0.0F)), Real(static_cast<float>(count - 1))));
    }
    integer column(Real u) const { return place(u, left, to_column, columns); }
    integer row(Real v) const { return place(v, top, to_row, rows); }
    integer tile_column(Real u) const { return place(u, left, to_tile_column, tiles); }
    integer tile_row(Real v) const { return place(v, top, to_tile_row, tiles); }
    std::int32_t cells() const { return rows * columns; }
    // Between the first cells of groups.
    std::int32_t group_pitch() const { return cells() + 1; }

    static void see(const bake_line& line, const bake_vectors& from, std::size_t count, const bake_seen& to)
    {
        const auto l = wide_line<Real>(line);
        for (std::size_t i = 0; i < count; i += step) {
            const auto seen =
                pass::ao_bake_seen(l, typename pass::vec3(w::load(from.x + i), w::load(from.y + i), w::load(from.z + i)));
            w::store(to.u + i, seen.u);
            w::store(to.w + i, seen.w);
            w::store(to.d + i, seen.d);
        }
    }

    // Starts, cosines, and the grid around the starts.
    static bake_raster_grid receive(const bake_task& task, const bake_line& line, const bake_raster_memory& m,
                                    const bake_view& view)
    {
        const bake_receiver_arrays& r = task.receivers;
        see(line, r.starts, r.count, m.starts);
        for (std::size_t i = r.count; i < r.count + bake_padding; ++i) { // repeat the first
            m.starts.u[i] = m.starts.u[0];
            m.starts.w[i] = m.starts.w[0];
            m.starts.d[i] = m.starts.d[0];
        }
        const auto l = wide_line<Real>(line);
        Real left(m.starts.u[0]);
        Real right = left;
        Real top(m.starts.w[0]);
        Real bottom = top;
        for (std::size_t i = 0; i < r.count; i += step) {
            const Real u = w::load(m.starts.u + i);
            const Real v = w::load(m.starts.w + i);
            left = w::min(left, u);
            right = w::max(right, u);
            top = w::min(top, v);
            bottom = w::max(bottom, v);
            const typename pass::vec3 normal(w::load(r.normals.x + i), w::load(r.normals.y + i), w::load(r.normals.z + i));
            w::store(view.cosine + i, pass::ao_bake_cosine(l, normal));
        }
        bake_raster_grid g{};
        g.columns = m.columns;
        g.rows = m.rows;
        g.tiles = m.tiles_across;
        g.left = w::least(left);
        g.top = w::least(top);
        const float across = w::greatest(right) - g.left + 1.0F;
        const float down = w::greatest(bottom) - g.top + 1.0F;
        g.to_column = static_cast<float>(g.columns) / across;
        g.to_row = static_cast<float>(g.rows) / down;
        g.to_tile_column = static_cast<float>(g.tiles) / across;
        g.to_tile_row = static_cast<float>(g.tiles) / down;
        return g;
    }

    // Sorts the starts by group and cell, and lists the receivers with a second direction. samples.* get the sorted starts;
    // m.first the sample of every cell of a group, and one past the last.
    void sort(const bake_task& task, const bake_line& line, bake_raster_memory& m, const bake_view& view) const
    {
        choose_cells(task, line, m, view);
        count_cells(task, line, m, view);
        const std::size_t count = task.receivers.count;
        const std::int32_t nowhere = bake_groups * group_pitch();
        for (int i = 0; i < bake_groups * bake_tiles; ++i) {
            m.tile_depths[i] = 8.0F;
        }
        const auto put = [&](std::size_t i, std::int32_t cell, std::int32_t tile, float toward, std::int32_t receiver) {
            const auto to = static_cast<std::size_t>(m.first[cell]++);
            m.samples.u[to] = m.starts.u[i];
            m.samples.w[to] = m.starts.w[i];
            m.samples.d[to] = m.starts.d[i];
            m.receivers[to] = receiver;
            float& nearest = m.tile_depths[tile];
            nearest = toward < nearest ? toward : nearest;
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (m.cells[i] != nowhere) {
                put(i, m.cells[i], m.tiles[i], m.toward[i], static_cast<std::int32_t>(i));
            }
        }
        for (std::size_t k = 0; k < m.second_count; ++k) {
            const std::size_t i = m.seconds[k].receiver;
            put(i, m.cells[i] + group_pitch(), m.tiles[i] + bake_tiles, -m.toward[i], -1 - static_cast<std::int32_t>(k));
        }
        // Every cell's first sample has become its end, the next cell's first: move up by one.
        for (int group = bake_groups - 1; group >= 0; --group) {
            std::int32_t* const of_group = m.first + group * group_pitch();
            for (std::int32_t i = cells(); i > 0; --i) {
                of_group[i] = of_group[i - 1];
            }
        }
        m.first[0] = 0;
        for (int group = 1; group < bake_groups; ++group) {
            std::int32_t* const of_group = m.first + group * group_pitch();
            of_group[0] = of_group[-1] + static_cast<std::int32_t>(bake_padding);
        }
        widen_tiles(m);
    }

private:
    static integer pick(integer a, integer b, mask m) { return reals::select(a, b, m); }

    void choose_cells(const bake_task& task, const bake_line& line, const bake_raster_memory& m, const bake_view& view) const
    {
        const bool both = line.opposite > 0;
        // An integer no cell has: looks along neither direction.
        const std::int32_t nowhere = bake_groups * group_pitch();
        for (std::size_t i = 0; i < task.receivers.count; i += step) {
            const Real u = w::load(m.starts.u + i);
            const Real v = w::load(m.starts.w + i);
            const Real d = w::load(m.starts.d + i);
            const mask back = w::load(view.cosine + i) < Real(0.0F);
            const integer group = pick(integer(0), integer(1), back);
            const integer cell = row(v) * integer(columns) + column(u) + group * integer(group_pitch());
            w::store(m.cells + i, both ? cell : pick(cell, integer(nowhere), back));
            w::store(m.tiles + i, tile_row(v) * integer(bake_tile_pitch) + tile_column(u) + group * integer(bake_tiles));
            w::store(m.toward + i, reals::select(d, -d, back));
        }
    }

    // The first sample of every cell, and m.seconds.
    void count_cells(const bake_task& task, const bake_line& line, bake_raster_memory& m, const bake_view& view) const
    {
        const std::size_t count = task.receivers.count;
        std::int32_t* const first = m.first;
        for (std::int32_t i = 0; i <= bake_groups * group_pitch() + 1; ++i) {
            first[i] = 0;
        }
        for (std::size_t i = 0; i < count; ++i) {
            ++first[m.cells[i]];
        }
        // Who looks across the line looks both ways.
        m.second_count = 0;
        for (std::size_t i = 0; line.opposite > 0 && i < count; i += step) {
            unsigned across = w::packed(w::load(view.cosine + i) == Real(0.0F));
            for (; across != 0; across &= across - 1) {
                const std::size_t at = i + static_cast<std::size_t>(__builtin_ctz(across));
                if (at < count) {
                    m.seconds[m.second_count++] = { static_cast<std::uint32_t>(at), 1.0F };
                    ++first[m.cells[at] + group_pitch()];
                }
            }
        }
        std::int32_t sum = 0;
        for (int group = 0; group < bake_groups; ++group) {
            std::int32_t* const of_group = first + group * group_pitch();
            for (std::int32_t i = 0; i < cells(); ++i) {
                const std::int32_t here = of_group[i];
                of_group[i] = sum;
                sum += here;
            }
            of_group[cells()] = sum;
            // What lies between the groups is far from every triangle.
            for (std::size_t i = 0; i < bake_padding; ++i) {
                m.samples.u[static_cast<std::size_t>(sum) + i] = far_away;
                m.samples.w[static_cast<std::size_t>(sum) + i] = far_away;
                m.samples.d[static_cast<std::size_t>(sum) + i] = 0;
            }
            sum += static_cast<std::int32_t>(bake_padding);
        }
    }

    // A tile knows of its right and lower neighbours, too.
    void widen_tiles(const bake_raster_memory& m) const
    {
        for (int group = 0; group < bake_groups; ++group) {
            float* const nearest = m.tile_depths + group * bake_tiles;
            for (int y = 0; y < tiles; ++y) {
                for (int x = 0; x < tiles; ++x) {
                    const int at = y * bake_tile_pitch + x;
                    for (const int next : { at + 1, at + bake_tile_pitch, at + bake_tile_pitch + 1 }) {
                        nearest[at] = nearest[next] < nearest[at] ? nearest[next] : nearest[at];
                    }
                }
            }
        }
    }
};

} // namespace ao::cpu::detail
