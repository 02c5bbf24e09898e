// The pass bodies over the pixels of a tile.
#pragma once

#include "kernels.hpp"
#include "resources.hpp"

#include "ao/kernel.hpp"
#include "ao/passes.hpp"

#include <cstring>

#if defined(__GNUC__) && !defined(AO_CPU_INSTRUMENTED)
#define AO_CPU_KERNEL [[gnu::flatten]]
#else
#define AO_CPU_KERNEL
#endif

namespace ao::cpu::detail {

template <class Real>
struct pass_kernels {
    using memory = detail::memory<Real>;
    using integer = typename math<Real>::integer;
    using ivec2 = typename math<Real>::ivec2;
    using vec2 = typename math<Real>::vec2;

    // A shared constants struct: reals only.
    template <class Constants, class Arguments>
    static Constants constants(const Arguments& a)
    {
        constexpr int count = sizeof(Constants) / sizeof(Real);
        static_assert(sizeof(float) * count <= sizeof(a.constants));
        Real each[count];
        for (int i = 0; i < count; ++i) {
            each[i] = Real(a.constants[i]);
        }
        Constants all;
        std::memcpy(&all, each, sizeof(all));
        return all;
    }

    // Calls body(pixel, target offset in pixels of the row, number of pixels) for each block. Lanes beyond the tile repeat the
    // last pixel.
    template <class Body>
    static void for_blocks(const tile& t, Body body)
    {
        for (int y = t.top; y < t.bottom; ++y) {
            for (int x = t.left; x < t.right; x += memory::width) {
                const int left = t.right - x;
                const int count = left < memory::width ? left : memory::width;
                body(ivec2(memory::ascending(x, 1, count), integer(y)), x, y, count);
            }
        }
    }

    static std::byte* at(const plane& p, int x, int y)
    {
        const std::size_t pixel_bytes = p.format == pixel_format::r8 ? 1 : 4;
        return p.data + static_cast<std::size_t>(y) * p.row_bytes + static_cast<std::size_t>(x) * pixel_bytes;
    }

    static void store(const plane& p, int x, int y, Real value, int count)
    {
        if (p.format != pixel_format::r8) {
            memory::store(at(p, x, y), value, count);
            return;
        }
        // To nearest, ties to even, by the rounding of the sum.
        const Real rounded = value * Real(255.0F) + Real(8388608.0F);
        memory::store_bytes(at(p, x, y), integer(rounded - Real(8388608.0F)), count);
    }

    AO_CPU_KERNEL static void linearize(const pass_arguments& a, const tile& t)
    {
        linearize_pass<Real, linearize_resources<Real>> pass{};
        pass.resources.depth = reader<Real>(a.source);
        pass.ao_affine = a.options.affine;
        const auto c = constants<typename decltype(pass)::ao_depth_decode>(a);
        for_blocks(t,
                   [&](ivec2 pixel, int x, int y, int count) { store(a.target, x, y, pass.ao_linearize_pass(c, pixel), count); });
    }

    // One component of the tile of rotations.
    static reader<Real> rotation(const pass_arguments& a, int i)
    {
        reader<Real> r;
        r.data = reinterpret_cast<const std::byte*>(a.rotation + i * tile_size * tile_size);
        r.row_words = tile_size;
        return r;
    }

    // The options that are asked per tap are constants.
    template <bool Parallel, bool LimitThickness>
    AO_CPU_KERNEL static void occlusion(const pass_arguments& a, const tile& t)
    {
        occlusion_pass<Real, occlusion_resources<Real>> pass{};
        pass.ao_tap_count = a.options.tap_count;
        pass.ao_normal_source = a.options.normal_source;
        pass.ao_rotate_normals = a.options.rotate_normals;
        pass.ao_parallel = Parallel;
        pass.ao_limit_thickness = LimitThickness;
        pass.ao_mark_background = a.options.mark_background;
        pass.resources.eye_depth = reader<Real>(a.source);
        pass.resources.normals = reader<Real>(a.normal);
        pass.resources.rotation_x = rotation(a, 0);
        pass.resources.rotation_y = rotation(a, 1);
        pass.resources.kernel = a.kernel;
        const auto c = constants<typename decltype(pass)::ao_occlusion_constants>(a);
        for_blocks(t,
                   [&](ivec2 pixel, int x, int y, int count) { store(a.target, x, y, pass.ao_occlusion_pass(c, pixel), count); });
    }

    AO_CPU_KERNEL static void filter_rows(const pass_arguments& a, const tile& t)
    {
        filter_pass<Real, filter_resources<Real>> pass{};
        pass.ao_filter_radius = a.options.filter_radius;
        pass.resources.first = reader<Real>(a.source);
        const auto c = constants<typename decltype(pass)::ao_filter_constants>(a);
        for_blocks(t, [&](ivec2 pixel, int x, int y, int count) {
            const vec2 sum = pass.ao_filter_rows_pass(c, pixel);
            store(a.target, x, y, sum.x, count);
            store(a.target_second, x, y, sum.y, count);
        });
    }

    AO_CPU_KERNEL static void filter_columns(const pass_arguments& a, const tile& t)
    {
        filter_pass<Real, filter_resources<Real>> pass{};
        pass.ao_filter_radius = a.options.filter_radius;
        pass.resources.first = reader<Real>(a.source);
        pass.resources.counts = reader<Real>(a.source_second);
        const auto c = constants<typename decltype(pass)::ao_filter_constants>(a);
        for_blocks(t, [&](ivec2 pixel, int x, int y, int count) {
            store(a.target, x, y, pass.ao_filter_columns_pass(c, pixel), count);
        });
    }

    template <bool Parallel>
    AO_CPU_KERNEL static void bitmask(const pass_arguments& a, const tile& t)
    {
        bitmask_pass<Real, occlusion_resources<Real>> pass{};
        pass.ao_tap_count = a.options.tap_count;
        pass.ao_slice_count = a.options.slice_count;
        pass.ao_normal_source = a.options.normal_source;
        pass.ao_rotate_normals = a.options.rotate_normals;
        pass.ao_parallel = Parallel;
        pass.ao_mark_background = a.options.mark_background;
        pass.ao_coarse = a.options.coarse;
        pass.resources.eye_depth = reader<Real>(a.source);
        pass.resources.normals = reader<Real>(a.normal);
        pass.resources.rotation_x = rotation(a, 0);
        pass.resources.rotation_y = rotation(a, 1);
        pass.resources.kernel = a.kernel;
        const auto c = constants<typename decltype(pass)::ao_occlusion_constants>(a);
        for_blocks(t, [&](ivec2 pixel, int x, int y, int count) {
            if (!a.options.mark_background) {
                store(a.target, x, y, pass.ao_bitmask_pass(c, pixel).visibility, count);
                return;
            }
            const vec2 packed = pass.ao_bitmask_packed_pass(c, pixel);
            store(a.target, x, y, packed.x, count);
            store(a.target_second, x, y, packed.y, count);
        });
    }

    template <bool Coarse>
    static denoise_pass<Real, denoise_resources<Real>> denoise(const pass_arguments& a)
    {
        denoise_pass<Real, denoise_resources<Real>> pass{};
        pass.ao_filter_radius = a.options.filter_radius;
        pass.ao_normal_source = a.options.normal_source;
        pass.ao_rotate_normals = a.options.rotate_normals;
        pass.ao_parallel = a.options.parallel;
        pass.ao_coarse = Coarse;
        pass.resources.visibility = reader<Real>(a.source);
        pass.resources.depths = reader<Real>(a.source_second);
        pass.resources.eye_depth = reader<Real>(Coarse ? a.depth : a.source_second);
        pass.resources.normals = reader<Real>(a.normal);
        return pass;
    }

    template <bool Coarse>
    AO_CPU_KERNEL static void denoise_rows(const pass_arguments& a, const tile& t)
    {
        auto pass = denoise<Coarse>(a);
        const auto c = constants<typename decltype(pass)::ao_denoise_constants>(a);
        for_blocks(t, [&](ivec2 pixel, int x, int y, int count) {
            const vec2 packed = pass.ao_denoise_rows_pass(c, pixel);
            store(a.target, x, y, packed.x, count);
            store(a.target_second, x, y, packed.y, count);
        });
    }

    template <bool Coarse>
    AO_CPU_KERNEL static void denoise_columns(const pass_arguments& a, const tile& t)
    {
        auto pass = denoise<Coarse>(a);
        const auto c = constants<typename decltype(pass)::ao_denoise_constants>(a);
        for_blocks(t, [&](ivec2 pixel, int x, int y, int count) {
            store(a.target, x, y, pass.ao_denoise_columns_pass(c, pixel), count);
        });
    }

    static constexpr kernel_table table(const temporal_kernel_table& temporal)
    {
        return {
            linearize,
            { { occlusion<false, false>, occlusion<false, true> }, { occlusion<true, false>, occlusion<true, true> } },
            filter_rows,
            filter_columns,
            { bitmask<false>, bitmask<true> },
            { denoise_rows<false>, denoise_rows<true> },
            { denoise_columns<false>, denoise_columns<true> },
            temporal,
        };
    }
};

} // namespace ao::cpu::detail
