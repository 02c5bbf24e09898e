// Visibility of all receivers along one line (the direction-major irregular raster of Aila and Laine, "Alias-free shadow maps",
// 2004, without a depth map): starts are sorted into cells of a grid across the line, and every triangle runs over the starts in
// its cells. Float arithmetic with bounds of its errors decides nearly all pairs; the rest goes through the shared predicate.
#pragma once

#include "bake_kernels.hpp"
#include "bake_wide.hpp"

#if defined(__GNUC__) && !defined(AO_CPU_INSTRUMENTED)
#define AO_BAKE_KERNEL [[gnu::flatten]]
#else
#define AO_BAKE_KERNEL
#endif

namespace ao::cpu::detail {

// Groups of samples: those that look along d, and those that look along -d.
inline constexpr int bake_groups = 2;
// Tiles across the grid, each way, at most; one more row and column around them.
inline constexpr int bake_most_tiles = 64;
inline constexpr int bake_tile_pitch = bake_most_tiles + 1;

template <class Real>
struct bake_raster {
    using w = wide<Real>;
    using pass = bake_pass<Real>;
    using integer = typename w::integer;
    using mask = typename w::mask;
    using reals = real_traits<Real>;
    static constexpr int width = w::width;
    static constexpr std::size_t step = w::width;
    static constexpr float far_away = 3e7F; // steps: beyond every point

    struct grid {
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
    };

    // A block of triangles, each a lane, made ready for the starts.
    struct alignas(64) block {
        float au[width]; // the first corner, lattice steps, and its depth
        float aw[width];
        float ad[width];
        // Shares of the second and third corner in what lies x, y from the first, and its depth, are linear in x and y.
        float second_x[width];
        float second_y[width];
        float third_x[width];
        float third_y[width];
        float depth_x[width];
        float depth_y[width];
        float share_error[width];
        float depth_error[width];
        std::int32_t first_cell[width]; // of the first row
        std::int32_t last_cell[width];  // one past the last, of the first row
        std::int32_t more_rows[width];  // after the first
    };

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
    static grid receive(const bake_task& task, const bake_line& line, const bake_raster_memory& m, const bake_view& view)
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
        grid g{};
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
    static void sort(const bake_task& task, const bake_line& line, const grid& g, bake_raster_memory& m, const bake_view& view)
    {
        const std::size_t count = task.receivers.count;
        const std::int32_t cells = g.rows * g.columns;
        const std::int32_t group_pitch = cells + 1;
        const bool both = line.opposite > 0;
        // An integer no cell has: looks along neither direction.
        const std::int32_t nowhere = bake_groups * group_pitch;
        for (std::size_t i = 0; i < count; i += step) {
            const Real u = w::load(m.starts.u + i);
            const Real v = w::load(m.starts.w + i);
            const Real cosine = w::load(view.cosine + i);
            const integer cell = g.row(v) * integer(g.columns) + g.column(u);
            const integer other = both ? cell + integer(group_pitch) : integer(nowhere);
            w::store(m.cells + i, pick(cell, other, cosine < Real(0.0F)));
            w::store(m.tiles + i, g.tile_row(v) * integer(bake_tile_pitch) + g.tile_column(u));
        }
        std::int32_t* first = m.first;
        for (std::int32_t i = 0; i <= nowhere + 1; ++i) {
            first[i] = 0;
        }
        for (std::size_t i = 0; i < count; ++i) {
            ++first[m.cells[i]];
        }
        // Who looks across the line looks both ways.
        m.second_count = 0;
        if (both) {
            for (std::size_t i = 0; i < count; i += step) {
                unsigned across = w::packed(w::load(view.cosine + i) == Real(0.0F));
                for (; across != 0; across &= across - 1) {
                    const std::size_t at = i + static_cast<std::size_t>(__builtin_ctz(across));
                    if (at < count) {
                        m.seconds[m.second_count++] = { static_cast<std::uint32_t>(at), 1.0F };
                        ++first[m.cells[at] + group_pitch];
                    }
                }
            }
        }
        std::int32_t sum = 0;
        for (int group = 0; group < bake_groups; ++group) {
            std::int32_t* const of_group = first + group * group_pitch;
            for (std::int32_t i = 0; i < cells; ++i) {
                const std::int32_t here = of_group[i];
                of_group[i] = sum;
                sum += here;
            }
            of_group[cells] = sum;
            // What lies between the groups is far from every triangle.
            for (std::size_t i = 0; i < bake_padding; ++i) {
                m.samples.u[static_cast<std::size_t>(sum) + i] = far_away;
                m.samples.w[static_cast<std::size_t>(sum) + i] = far_away;
                m.samples.d[static_cast<std::size_t>(sum) + i] = 0;
            }
            sum += static_cast<std::int32_t>(bake_padding);
        }
        float* const lowest = m.tile_depths;
        float* const highest = lowest + bake_tile_pitch * bake_tile_pitch;
        for (int i = 0; i < bake_tile_pitch * bake_tile_pitch; ++i) {
            lowest[i] = 8.0F;
            highest[i] = -8.0F;
        }
        const auto place = [&](std::size_t i, std::int32_t cell, std::int32_t receiver) {
            const auto to = static_cast<std::size_t>(first[cell]++);
            const float d = m.starts.d[i];
            m.samples.u[to] = m.starts.u[i];
            m.samples.w[to] = m.starts.w[i];
            m.samples.d[to] = d;
            m.receivers[to] = receiver;
            const std::int32_t tile = m.tiles[i];
            if (cell < group_pitch) {
                lowest[tile] = d < lowest[tile] ? d : lowest[tile];
            }
            else {
                highest[tile] = d > highest[tile] ? d : highest[tile];
            }
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (m.cells[i] != nowhere) {
                place(i, m.cells[i], static_cast<std::int32_t>(i));
            }
        }
        for (std::size_t k = 0; k < m.second_count; ++k) {
            place(m.seconds[k].receiver, m.cells[m.seconds[k].receiver] + group_pitch, -1 - static_cast<std::int32_t>(k));
        }
        // Every cell's first sample has become its end, the next cell's first: move up by one.
        for (int group = bake_groups - 1; group >= 0; --group) {
            std::int32_t* const of_group = first + group * group_pitch;
            for (std::int32_t i = cells; i > 0; --i) {
                of_group[i] = of_group[i - 1];
            }
        }
        restore_firsts(m, group_pitch, cells);
        // A tile knows of its right and lower neighbours, too.
        for (int y = 0; y < g.tiles; ++y) {
            for (int x = 0; x < g.tiles; ++x) {
                const int at = y * bake_tile_pitch + x;
                for (const int next : { at + 1, at + bake_tile_pitch, at + bake_tile_pitch + 1 }) {
                    lowest[at] = lowest[next] < lowest[at] ? lowest[next] : lowest[at];
                    highest[at] = highest[next] > highest[at] ? highest[next] : highest[at];
                }
            }
        }
    }

    static integer pick(integer a, integer b, mask m) { return reals::select(a, b, m); }

    // The first of each group.
    static void restore_firsts(bake_raster_memory& m, std::int32_t group_pitch, std::int32_t cells)
    {
        m.first[0] = 0;
        m.first[group_pitch] = m.first[cells] + static_cast<std::int32_t>(bake_padding);
    }

    // Lanes of triangles that may stand before a start of group 0, and of group 1.
    struct relevant {
        unsigned along;
        unsigned against;
    };

    static relevant prepare(const bake_task& task, const grid& g, const bake_raster_memory& m, std::size_t i, block& b)
    {
        const bake_occluder_arrays& o = task.occluders;
        Real u[3];
        Real v[3];
        Real d[3];
        for (int k = 0; k < 3; ++k) {
            const integer corner = w::load(o.corners[k] + i);
            u[k] = w::gather(m.points.u, corner);
            v[k] = w::gather(m.points.w, corner);
            d[k] = w::gather(m.points.d, corner);
        }
        const Real left = w::min(w::min(u[0], u[1]), u[2]);
        const Real right = w::max(w::max(u[0], u[1]), u[2]);
        const Real top = w::min(w::min(v[0], v[1]), v[2]);
        const Real bottom = w::max(w::max(v[0], v[1]), v[2]);
        const Real low = w::min(w::min(d[0], d[1]), d[2]);
        const Real high = w::max(w::max(d[0], d[1]), d[2]);

        // What is not above the lowest start of its tiles that looks up stands before none of them, to the last bit.
        const integer tile_column = g.tile_column(left);
        const integer tile_row = g.tile_row(top);
        const integer tile = tile_row * integer(bake_tile_pitch) + tile_column;
        const mask wide_tiles = g.tile_column(right) > tile_column + integer(1) || g.tile_row(bottom) > tile_row + integer(1);
        const Real lowest = w::gather(m.tile_depths, tile);
        const Real highest = w::gather(m.tile_depths + bake_tile_pitch * bake_tile_pitch, tile);
        mask along = wide_tiles || high > lowest;
        mask against = wide_tiles || low < highest;

        const Real bu = u[1] - u[0];
        const Real bv = v[1] - v[0];
        const Real cu = u[2] - u[0];
        const Real cv = v[2] - v[0];
        const Real first_product = bu * cv;
        const Real second_product = bv * cu;
        const Real area = first_product - second_product;
        const mask turned = area < Real(0.0F);
        const Real bd = d[1] - d[0];
        const Real cd = d[2] - d[0];
        // Bounds of rounding (docs/numerics.md, "Per vertex"). Starts looked at are within the box and a cell around it, or
        // farther and clearly outside.
        constexpr float unit = 1.1920928955078125e-7F; // 2^-23
        const Real across = right - left + Real(1.01F / g.to_column);
        const Real down = bottom - top + Real(1.01F / g.to_row);
        const Real longest_u = w::max(reals::abs(bu), reals::abs(cu));
        const Real longest_v = w::max(reals::abs(bv), reals::abs(cv));
        const Real edge_error = Real(16.0F * unit) * (across * longest_v + down * longest_u);
        // Slivers: nothing is certain, all is possible.
        const mask thin = reals::abs(area) < Real(64.0F) * edge_error;
        if (task.options.front) {
            along = along && (turned || thin);
            against = against && (!turned || thin);
        }
        const Real inverse = reals::select(Real(1.0F) / area, Real(0.0F), thin);
        const Real share_error = edge_error * reals::abs(inverse);
        const Real depth = w::max(reals::abs(bd), reals::abs(cd));
        const Real depth_error = depth * (Real(64.0F * unit) + Real(8.0F) * share_error);
        const Real second_x = cv * inverse;
        const Real second_y = -(cu * inverse);
        const Real third_x = -(bv * inverse);
        const Real third_y = bu * inverse;

        w::store(b.au, u[0]);
        w::store(b.aw, v[0]);
        w::store(b.ad, d[0]);
        w::store(b.second_x, second_x);
        w::store(b.second_y, second_y);
        w::store(b.third_x, third_x);
        w::store(b.third_y, third_y);
        w::store(b.depth_x, second_x * bd + third_x * cd);
        w::store(b.depth_y, second_y * bd + third_y * cd);
        w::store(b.share_error, reals::select(share_error, Real(1e30F), thin));
        w::store(b.depth_error, reals::select(depth_error, Real(1e30F), thin));
        const integer first_row = g.row(top);
        const integer row_start = first_row * integer(g.columns);
        w::store(b.first_cell, row_start + g.column(left));
        w::store(b.last_cell, row_start + g.column(right) + integer(1));
        w::store(b.more_rows, g.row(bottom) - first_row);
        return { w::packed(along), w::packed(against) };
    }

    // The shared predicate for the samples at `at`. Rare, and its registers are not to be the inner loop's.
    [[gnu::noinline]] static unsigned exactly(const bake_task& task, const bake_raster_memory& m, std::size_t triangle,
                                              std::size_t at, bool along, unsigned lanes)
    {
        const auto point = [&](int k) {
            const std::int32_t p = task.occluders.corners[k][triangle];
            return typename pass::ao_bake_point{ Real(m.points.u[p]), Real(m.points.w[p]), Real(m.points.d[p]) };
        };
        const typename pass::ao_bake_point start{ w::load(m.samples.u + at), w::load(m.samples.w + at),
                                                  w::load(m.samples.d + at) };
        const auto crossing = pass::ao_bake_crossing_of(start, point(0), point(1), point(2));
        const Real reach(task.options.reach);
        mask hit = along ? pass::ao_bake_ahead(crossing, reach) : pass::ao_bake_behind(crossing, reach);
        if (task.options.front) {
            hit = hit && (along ? crossing.turned : !crossing.turned);
        }
        lanes &= w::packed(hit);
        if (task.options.falloff != 0) {
            float distances[width];
            w::store(distances, pass::ao_bake_distance(crossing));
            for (unsigned rest = lanes; rest != 0; rest &= rest - 1) {
                const int i = __builtin_ctz(rest);
                float& least = m.distances[at + static_cast<std::size_t>(i)];
                least = distances[i] < least ? distances[i] : least;
            }
        }
        return lanes;
    }

    // What the inner loop reads.
    struct samples {
        const float* u;
        const float* w;
        const float* d;
        const std::int32_t* first; // of the group
    };

    // One triangle of a block against samples begin ... end - 1.
    template <bool Along, bool Plain>
    static void cover(const bake_task& task, const bake_raster_memory& m, const samples& s, const block& b, unsigned lane,
                      std::size_t triangle, std::int32_t begin, std::int32_t end)
    {
        do {
            const auto here = static_cast<std::size_t>(begin);
            const Real x = w::load(s.u + here) - Real(b.au[lane]);
            const Real y = w::load(s.w + here) - Real(b.aw[lane]);
            const Real above = Real(b.ad[lane]) - w::load(s.d + here);
            const Real second = w::fused(x, Real(b.second_x[lane]), y * Real(b.second_y[lane]));
            const Real third = w::fused(x, Real(b.third_x[lane]), y * Real(b.third_y[lane]));
            const Real least = w::min(Real(1.0F) - second - third, w::min(second, third));
            const Real depth = w::fused(x, Real(b.depth_x[lane]), w::fused(y, Real(b.depth_y[lane]), above));
            const Real share_error(b.share_error[lane]);
            const Real depth_error(b.depth_error[lane]);
            const mask inside = least >= -share_error;
            // Lanes beyond the end are starts of the group as well, or far from everything.
            const unsigned lanes = w::packed(inside && (Along ? depth >= -depth_error : depth <= depth_error));
            begin += width;
            if (lanes == 0) [[likely]] {
                continue;
            }
            unsigned hit = 0;
            if constexpr (Plain) {
                hit = lanes & w::packed(least > share_error && (Along ? depth > depth_error : depth < -depth_error));
            }
            if (hit != lanes) [[unlikely]] {
                hit |= exactly(task, m, triangle, here, Along, lanes & ~hit);
            }
            std::uint64_t word = 0;
            char* const word_at = reinterpret_cast<char*>(m.hit) + (here >> 5U) * 4;
            std::memcpy(&word, word_at, 8);
            word |= static_cast<std::uint64_t>(hit) << (here & 31U);
            std::memcpy(word_at, &word, 8);
        } while (begin < end);
    }

    // The triangles of a block, by lanes, against the samples of a group: row by row of all of them, so that few branches
    // surprise.
    template <bool Along, bool Plain>
    static void cover_block(const bake_task& task, const grid& g, const bake_raster_memory& m, const samples& s, const block& b,
                            std::size_t first_triangle, unsigned lanes)
    {
        alignas(64) std::int32_t begin[width];
        alignas(64) std::int32_t end[width];
        integer first_cell = w::load(b.first_cell);
        integer last_cell = w::load(b.last_cell);
        const integer more_rows = w::load(b.more_rows);
        for (int row = 0; lanes != 0; ++row) {
            const integer from = w::gather(s.first, first_cell);
            const integer to = w::gather(s.first, last_cell);
            w::store(begin, from);
            w::store(end, to);
            for (unsigned rest = lanes & w::packed(from < to); rest != 0; rest &= rest - 1) {
                const auto lane = static_cast<unsigned>(__builtin_ctz(rest));
                cover<Along, Plain>(task, m, s, b, lane, first_triangle + lane, begin[lane], end[lane]);
            }
            lanes &= w::packed(integer(row) < more_rows);
            // Lanes that have no more rows stay where they are.
            const integer down = pick(integer(0), integer(g.columns), integer(row) < more_rows);
            first_cell = first_cell + down;
            last_cell = last_cell + down;
        }
    }

    template <bool Plain>
    static void cover_all(const bake_task& task, const grid& g, const bake_raster_memory& m)
    {
        const std::int32_t group_pitch = g.rows * g.columns + 1;
        const samples along{ m.samples.u, m.samples.w, m.samples.d, m.first };
        const samples against{ m.samples.u, m.samples.w, m.samples.d, m.first + group_pitch };
        block b;
        const std::size_t count = task.occluders.triangle_count;
        for (std::size_t i = 0; i < count; i += step) {
            const relevant lanes = prepare(task, g, m, i, b);
            const unsigned whole = count - i >= step ? ~0U : (1U << (count - i)) - 1U;
            cover_block<true, Plain>(task, g, m, along, b, i, lanes.along & whole);
            cover_block<false, Plain>(task, g, m, against, b, i, lanes.against & whole);
        }
    }

    // Openness of every receiver from the bits of the samples.
    static void collect(const bake_task& task, const grid& g, bake_raster_memory& m, const bake_view& view)
    {
        const std::int32_t cells = g.rows * g.columns;
        const std::int32_t group_pitch = cells + 1;
        for (std::size_t i = 0; i < task.receivers.count; i += step) {
            w::store(view.open + i, Real(1.0F));
        }
        const auto openness = [&](std::size_t sample) {
            if (task.options.falloff == 0) {
                return 0.0F;
            }
            float lanes[width];
            w::store(lanes, pass::ao_bake_openness(Real(m.distances[sample]), Real(task.options.reach), task.options.falloff));
            return lanes[0];
        };
        for (int group = 0; group < bake_groups; ++group) {
            const std::int32_t begin = m.first[group * group_pitch];
            const std::int32_t end = m.first[group * group_pitch + cells];
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

    AO_BAKE_KERNEL static void raster(const bake_task& task, const bake_line& line, bake_raster_memory& m, const bake_view& view)
    {
        see(line, task.occluders.points, task.occluders.point_count, m.points);
        const grid g = receive(task, line, m, view);
        sort(task, line, g, m, view);
        const std::size_t samples = task.receivers.count + m.second_count + bake_groups * bake_padding;
        for (std::size_t i = 0; i <= samples / 64 + 1; ++i) {
            m.hit[i] = 0;
        }
        if (task.options.falloff != 0) {
            for (std::size_t i = 0; i < samples; ++i) {
                m.distances[i] = 1e30F;
            }
        }
        const bool plain = !task.options.limited && !task.options.front && task.options.falloff == 0;
        if (plain) {
            cover_all<true>(task, g, m);
        }
        else {
            cover_all<false>(task, g, m);
        }
        collect(task, g, m, view);
    }
};

} // namespace ao::cpu::detail
