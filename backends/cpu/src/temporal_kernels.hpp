// The bodies of the temporal passes over the pixels of a tile.
#pragma once

#include "pass_kernels.hpp"
#include "temporal_resources.hpp"

namespace ao::cpu::detail {

template <class Real>
struct temporal_kernels {
    using pixels = pass_kernels<Real>;
    using memory = detail::memory<Real>;
    using ivec2 = typename math<Real>::ivec2;

    static reader<Real> rotation(const temporal_arguments& a, int component)
    {
        reader<Real> r;
        r.data = reinterpret_cast<const std::byte*>(a.rotation + component * tile_size * tile_size);
        r.row_words = tile_size;
        return r;
    }
    static history_reader<Real> history(const temporal_arguments& a)
    {
        return { reinterpret_cast<const std::byte*>(a.read), 4 * a.history_plane, a.history_words };
    }

    // Options that are asked per tap or texel are constants.
    template <bool Reproject, bool Cubic, int Contribution, bool Precise>
    AO_CPU_KERNEL static void accumulate(const temporal_arguments& a, const tile& t)
    {
        temporal_pass<Real, temporal_resources<Real>> pass{};
        const temporal_options& o = a.options;
        pass.ao_most_samples = o.most_samples;
        pass.ao_contribution = Contribution;
        pass.ao_history_format = Precise ? pass.ao_history_precise : o.history_format;
        pass.ao_invalidation = o.invalidation;
        pass.ao_reproject = Reproject;
        pass.ao_use_motion = Reproject && o.use_motion;
        pass.ao_cubic = Cubic;
        pass.ao_normal_source = o.normal_source;
        pass.ao_rotate_normals = o.rotate_normals;
        pass.ao_parallel = o.parallel;
        pass.ao_limit_thickness = o.limit_thickness;
        pass.ao_slice_taps = o.slice_taps;
        pass.resources.eye_depth = reader<Real>(a.depth);
        pass.resources.normals = reader<Real>(a.normal);
        pass.resources.motions = reader<Real>(a.motion);
        pass.resources.rotation_x = rotation(a, 0);
        pass.resources.rotation_y = rotation(a, 1);
        pass.resources.last = history(a);
        pass.resources.taps = reinterpret_cast<const std::byte*>(a.taps);
        pass.resources.tap_bytes = 4 * a.tap_plane;
        pass.resources.slices = Contribution == pass.ao_bitmask;
        const auto c = pixels::template constants<typename decltype(pass)::ao_temporal_constants>(a);
        pixels::for_blocks(t, [&](ivec2 pixel, int x, int y, int count) {
            const auto words = pass.ao_packed_history(pass.ao_accumulate_pass(c, pixel), pass.ao_history_format);
            const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x);
            const auto store = [&](std::size_t word, auto value) {
                memory::store(reinterpret_cast<std::byte*>(a.write + word * a.history_plane + at), pass.ao_real_of_bits(value),
                              count);
            };
            store(0, words.x);
            store(1, words.y);
            if (a.history_words == 4) {
                store(2, words.z);
                store(3, words.w);
            }
        });
    }

    template <bool Reproject, bool Cubic>
    static constexpr accumulate_table accumulate_kernels{
        { { accumulate<Reproject, Cubic, 0, false>, accumulate<Reproject, Cubic, 0, true> },
          { accumulate<Reproject, Cubic, 1, false>, accumulate<Reproject, Cubic, 1, true> },
          { accumulate<Reproject, Cubic, 2, false>, accumulate<Reproject, Cubic, 2, true> } }
    };

    using filter_pass = temporal_filter_pass<Real, temporal_filter_resources<Real>>;

    static filter_pass make_filter_pass(const temporal_arguments& a)
    {
        filter_pass pass{};
        pass.ao_filter_radius = a.options.filter_radius;
        pass.ao_history_format = a.options.history_format;
        pass.ao_parallel = a.options.parallel;
        pass.resources.eye_depth = reader<Real>(a.depth);
        pass.resources.rows = reader<Real>(a.rows);
        pass.resources.now = history(a);
        return pass;
    }
    // Calls body(row of the tile, its mark).
    template <class Body>
    static void for_rows(const temporal_arguments& a, const tile& t, Body body)
    {
        const int columns = (a.width + a.tile_width - 1) / a.tile_width;
        for (int y = t.top; y < t.bottom; ++y) {
            const auto mark =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(t.left / a.tile_width);
            body(tile{ t.left, y, t.right, y + 1 }, a.filtered[mark]);
        }
    }
    template <class Call>
    static void filter(const temporal_arguments& a, const tile& t, Call call)
    {
        filter_pass pass = make_filter_pass(a);
        const auto c = pixels::template constants<typename filter_pass::ao_temporal_filter_constants>(a);
        for_rows(a, t, [&](const tile& row, std::uint8_t filtered) {
            if (filtered != 0) {
                pixels::for_blocks(row, [&](ivec2 pixel, int x, int y, int count) {
                    pixels::store(a.target, x, y, call(pass, c, pixel), count);
                });
            }
        });
    }
    AO_CPU_KERNEL static void filter_rows(const temporal_arguments& a, const tile& t)
    {
        filter(a, t, [](auto& pass, const auto& c, ivec2 pixel) { return pass.ao_temporal_rows_pass(c, pixel); });
    }
    AO_CPU_KERNEL static void filter_columns(const temporal_arguments& a, const tile& t)
    {
        filter(a, t, [](auto& pass, const auto& c, ivec2 pixel) { return pass.ao_temporal_columns_pass(c, pixel); });
    }
    AO_CPU_KERNEL static void resolve(const temporal_arguments& a, const tile& t)
    {
        filter_pass pass = make_filter_pass(a);
        const auto c = pixels::template constants<typename filter_pass::ao_temporal_filter_constants>(a);
        for_rows(a, t, [&](const tile& row, std::uint8_t& filtered) {
            bool any = false;
            pixels::for_blocks(row, [&](ivec2 pixel, int x, int y, int count) {
                pixels::store(a.target, x, y, pass.ao_temporal_resolve_pass(c, pixel), count);
                any = any || pass.ao_any(pass.ao_to_be_filtered(c, pass.ao_history_at(pixel, c.width)));
            });
            filtered = any ? 1 : 0;
        });
    }

    static constexpr temporal_kernel_table table{
        { accumulate_kernels<false, false>, accumulate_kernels<true, false>, accumulate_kernels<true, true> },
        filter_rows,
        filter_columns,
        resolve,
    };
};

// All kernels of a Real type.
template <class Real>
constexpr kernel_table kernels_over = pass_kernels<Real>::table(temporal_kernels<Real>::table);

} // namespace ao::cpu::detail
