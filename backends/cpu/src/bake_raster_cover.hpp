// Triangles over the starts in their cells. Float arithmetic with bounds of its errors decides nearly all pairs; the rest goes
// through the shared predicate.
#pragma once

#include "bake_raster_grid.hpp"

#if defined(__GNUC__) && !defined(AO_CPU_INSTRUMENTED)
#define AO_BAKE_KERNEL [[gnu::flatten]]
#else
#define AO_BAKE_KERNEL
#endif

namespace ao::cpu::detail {

template <class Real>
struct bake_raster_cover {
    using w = wide<Real>;
    using pass = bake_pass<Real>;
    using integer = typename w::integer;
    using mask = typename w::mask;
    using reals = real_traits<Real>;
    using grid = bake_raster_grid<Real>;
    static constexpr int width = w::width;
    static constexpr std::size_t step = w::width;

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

    // Corners of a lane's triangle each.
    struct corners {
        Real u[3];
        Real v[3];
        Real d[3];

        corners(const bake_task& task, const typename pass::ao_bake_line& line, std::size_t first)
        {
            for (int k = 0; k < 3; ++k) {
                const bake_vectors& p = task.occluders.places[k];
                const typename pass::vec3 place(w::load(p.x + first), w::load(p.y + first), w::load(p.z + first));
                const auto seen = pass::ao_bake_seen(line, place);
                u[k] = seen.u;
                v[k] = seen.w;
                d[k] = seen.d;
            }
        }
        static Real least(const Real* x) { return w::min(w::min(x[0], x[1]), x[2]); }
        static Real greatest(const Real* x) { return w::max(w::max(x[0], x[1]), x[2]); }
    };

    // What surrounds a triangle, and twice its area, whose sign is exact: rounding keeps the order of the products.
    struct box {
        Real left;
        Real right;
        Real top;
        Real bottom;
        Real low;
        Real high;
        Real area;

        explicit box(const corners& c)
            : left(corners::least(c.u)),
              right(corners::greatest(c.u)),
              top(corners::least(c.v)),
              bottom(corners::greatest(c.v)),
              low(corners::least(c.d)),
              high(corners::greatest(c.d)),
              area((c.u[1] - c.u[0]) * (c.v[2] - c.v[0]) - (c.v[1] - c.v[0]) * (c.u[2] - c.u[0]))
        {
        }
    };

    // Lanes of triangles that may stand before a start of each group.
    struct relevant {
        unsigned along;
        unsigned against;
    };

    // `entered`: of closed surfaces, those triangles that rays enter by are enough.
    static relevant select(const bake_task& task, const grid& g, const bake_raster_memory& m, std::size_t first, const box& c,
                           bool entered)
    {
        mask along(true);
        mask against(true);
        if (task.options.front) {
            along = c.area <= Real(0.0F);
            against = c.area >= Real(0.0F);
        }
        // What is not above the lowest start of its tiles that looks up stands before none of them, to the last bit.
        const integer tile_column = g.tile_column(c.left);
        const integer tile_row = g.tile_row(c.top);
        const integer tile = tile_row * integer(bake_tile_pitch) + tile_column;
        const mask wide_tiles = g.tile_column(c.right) > tile_column + integer(1) || g.tile_row(c.bottom) > tile_row + integer(1);
        if (!entered) {
            along = along && (wide_tiles || c.high > w::gather(m.tile_depths, tile));
            against = against && (wide_tiles || -c.low > w::gather(m.tile_depths + bake_tiles, tile));
            return { w::packed(along), w::packed(against) };
        }
        // Where the predicate's depths may be off by more than 7 steps both sides are looked at (docs/numerics.md).
        const mask both = (c.right - c.left) * (c.bottom - c.top) * (c.high - c.low) >= Real(0.75F) * reals::abs(c.area) ||
                          w::load(task.occluders.closed + first) == integer(0);
        const mask turned = c.area < Real(0.0F);
        const integer group = reals::select(integer(bake_tiles), integer(0), turned);
        const Real farthest = reals::select(-c.low, c.high, turned);
        const mask before = both || wide_tiles || farthest > w::gather(m.tile_depths, tile + group);
        return { w::packed(before && (both || turned)), w::packed(before && (both || !turned)) };
    }

    static void prepare(const grid& g, const corners& c, const box& around, block& b)
    {
        const Real bu = c.u[1] - c.u[0];
        const Real bv = c.v[1] - c.v[0];
        const Real cu = c.u[2] - c.u[0];
        const Real cv = c.v[2] - c.v[0];
        const Real area = around.area;
        const Real bd = c.d[1] - c.d[0];
        const Real cd = c.d[2] - c.d[0];
        // Bounds of rounding (docs/numerics.md, "Per vertex"). Starts looked at are within the box and a cell around it, or
        // farther and clearly outside.
        constexpr float unit = 1.1920928955078125e-7F; // 2^-23
        const Real across = around.right - around.left + Real(1.01F / g.to_column);
        const Real down = around.bottom - around.top + Real(1.01F / g.to_row);
        const Real longest_u = w::max(reals::abs(bu), reals::abs(cu));
        const Real longest_v = w::max(reals::abs(bv), reals::abs(cv));
        const Real edge_error = Real(16.0F * unit) * (across * longest_v + down * longest_u);
        // Slivers: nothing is certain, all is possible.
        const mask thin = reals::abs(area) < Real(64.0F) * edge_error;
        const Real inverse = reals::select(Real(1.0F) / area, Real(0.0F), thin);
        const Real share_error = edge_error * reals::abs(inverse);
        const Real depth = w::max(reals::abs(bd), reals::abs(cd));
        const Real depth_error = depth * (Real(64.0F * unit) + Real(8.0F) * share_error);
        const Real second_x = cv * inverse;
        const Real second_y = -(cu * inverse);
        const Real third_x = -(bv * inverse);
        const Real third_y = bu * inverse;

        w::store(b.au, c.u[0]);
        w::store(b.aw, c.v[0]);
        w::store(b.ad, c.d[0]);
        w::store(b.second_x, second_x);
        w::store(b.second_y, second_y);
        w::store(b.third_x, third_x);
        w::store(b.third_y, third_y);
        w::store(b.depth_x, second_x * bd + third_x * cd);
        w::store(b.depth_y, second_y * bd + third_y * cd);
        w::store(b.share_error, reals::select(share_error, Real(1e30F), thin));
        w::store(b.depth_error, reals::select(depth_error, Real(1e30F), thin));
        const integer first_row = g.row(around.top);
        const integer row_start = first_row * integer(g.columns);
        w::store(b.first_cell, row_start + g.column(around.left));
        w::store(b.last_cell, row_start + g.column(around.right) + integer(1));
        w::store(b.more_rows, g.row(around.bottom) - first_row);
    }

    // Lines inside of a triangle that rounding may have put behind the start: depths are off by 8 steps x D X Y / area at most,
    // D, X, Y the triangle's extents, and right wherever all corners are on one side.
    static mask is_doubtful(const typename pass::ao_bake_crossing& crossing, const typename pass::ao_bake_point& s,
                            const typename pass::ao_bake_point& a, const typename pass::ao_bake_point& b,
                            const typename pass::ao_bake_point& c, bool along)
    {
        const auto extent = [](Real x, Real y, Real z) { return w::max(w::max(x, y), z) - w::min(w::min(x, y), z); };
        constexpr float eight_steps = 9.5367431640625e-7F;
        const Real error = Real(eight_steps) * extent(a.d, b.d, c.d) * extent(a.u, b.u, c.u) * extent(a.w, b.w, c.w);
        const Real sign(along ? 1.0F : -1.0F);
        const mask ahead = w::max(w::max(a.d * sign, b.d * sign), c.d * sign) > s.d * sign;
        return crossing.inside && ahead && crossing.moment * sign >= -error;
    }

    static void note_doubts(bake_raster_memory& m, std::size_t at, unsigned lanes)
    {
        for (; lanes != 0; lanes &= lanes - 1) {
            if (m.doubtful_count < bake_most_doubtful) {
                m.doubtful[m.doubtful_count] = static_cast<std::int32_t>(at) + __builtin_ctz(lanes);
            }
            ++m.doubtful_count;
        }
    }

    // The shared predicate for the samples at `at`. Rare, and its registers are not to be the inner loop's.
    [[gnu::noinline]] static unsigned exactly(const bake_task& task, const bake_line& line, bake_raster_memory& m,
                                              std::size_t triangle, std::size_t at, bool along, unsigned lanes)
    {
        const auto point = [&](int k) {
            const bake_vectors& p = task.occluders.places[k];
            const typename pass::vec3 place(Real(p.x[triangle]), Real(p.y[triangle]), Real(p.z[triangle]));
            return pass::ao_bake_seen(wide_line<Real>(line), place);
        };
        const typename pass::ao_bake_point start{ w::load(m.samples.u + at), w::load(m.samples.w + at),
                                                  w::load(m.samples.d + at) };
        const auto crossing = pass::ao_bake_crossing_of(start, point(0), point(1), point(2));
        const Real reach(task.options.reach);
        mask hit = along ? pass::ao_bake_ahead(crossing, reach) : pass::ao_bake_behind(crossing, reach);
        if (task.options.front) {
            hit = hit && (along ? crossing.turned : !crossing.turned);
        }
        note_doubts(m, at, lanes & w::packed(is_doubtful(crossing, start, point(0), point(1), point(2), along) && !hit));
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

    // What a line's triangles are shown to.
    struct scene {
        const bake_task& task;
        const bake_line& line;
        const grid& g;
        bake_raster_memory& m;
    };

    // One triangle of a block against samples begin ... end - 1.
    template <bool Along, bool Plain>
    static void cover(const scene& s, const block& b, std::size_t first_triangle, unsigned lane, std::int32_t begin,
                      std::int32_t end)
    {
        const float* const samples_u = s.m.samples.u;
        const float* const samples_w = s.m.samples.w;
        const float* const samples_d = s.m.samples.d;
        do {
            const auto here = static_cast<std::size_t>(begin);
            const Real x = w::load(samples_u + here) - Real(b.au[lane]);
            const Real y = w::load(samples_w + here) - Real(b.aw[lane]);
            const Real above = Real(b.ad[lane]) - w::load(samples_d + here);
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
                hit |= exactly(s.task, s.line, s.m, first_triangle + lane, here, Along, lanes & ~hit);
            }
            std::uint64_t word = 0;
            char* const word_at = reinterpret_cast<char*>(s.m.hit) + (here >> 5U) * 4;
            std::memcpy(&word, word_at, 8);
            word |= static_cast<std::uint64_t>(hit) << (here & 31U);
            std::memcpy(word_at, &word, 8);
        } while (begin < end);
    }

    // The triangles of a block, by lanes, against the samples of a group: row by row of all of them, so that few branches
    // surprise.
    template <bool Along, bool Plain>
    static void cover_block(const scene& s, const block& b, std::size_t first_triangle, unsigned lanes)
    {
        const std::int32_t* const first = s.m.first + (Along ? 0 : s.g.group_pitch());
        struct span {
            unsigned lane;
            std::int32_t begin;
            std::int32_t end;
        };
        span spans[width + 1];
        for (std::int32_t row = 0; lanes != 0; ++row) {
            int count = 0;
            unsigned next = 0;
            for (; lanes != 0; lanes &= lanes - 1) {
                const auto lane = static_cast<unsigned>(__builtin_ctz(lanes));
                const std::int32_t down = row * s.g.columns;
                const std::int32_t begin = first[b.first_cell[lane] + down];
                const std::int32_t end = first[b.last_cell[lane] + down];
                spans[count] = { lane, begin, end };
                count += begin < end ? 1 : 0;
                next |= static_cast<unsigned>(row < b.more_rows[lane]) << lane;
            }
            for (int i = 0; i < count; ++i) {
                cover<Along, Plain>(s, b, first_triangle, spans[i].lane, spans[i].begin, spans[i].end);
            }
            lanes = next;
        }
    }

    template <bool Plain>
    static void cover_all(const bake_task& task, const bake_line& line, const grid& g, bake_raster_memory& m, bool entered)
    {
        const auto l = wide_line<Real>(line);
        const scene s{ task, line, g, m };
        block b;
        const std::size_t count = task.occluders.triangle_count;
        for (std::size_t i = 0; i < count; i += step) {
            const corners c(task, l, i);
            const box around(c);
            const relevant lanes = select(task, g, m, i, around, entered);
            const unsigned whole = count - i >= step ? ~0U : (1U << (count - i)) - 1U;
            if (((lanes.along | lanes.against) & whole) == 0) {
                continue;
            }
            prepare(g, c, around, b);
            cover_block<true, Plain>(s, b, i, lanes.along & whole);
            cover_block<false, Plain>(s, b, i, lanes.against & whole);
        }
    }
};

} // namespace ao::cpu::detail
