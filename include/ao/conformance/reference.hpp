// An executor of plans without any API: the pass bodies in a double loop over host pictures. With float it is the reference
// that backends are compared with; with interval it bounds what they may answer; it also lets the core be tested alone.
// Compile with -ffp-contract=off (ao::strict_fp).
#pragma once

#include "ao/interval.hpp"
#include "ao/kernel.hpp"
#include "ao/passes.hpp"
#include "ao/picture.hpp"
#include "ao/plan.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace ao::conformance {

// Texels as a pass reads them, components that a format lacks are 0.
template <class Real>
struct values {
    using texel = glm::vec<4, Real>;
    int width = 0;
    int height = 0;
    std::vector<texel> texels;

    values() = default;
    values(int w, int h) : width(w), height(h), texels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), texel(Real(0)))
    {
    }
    const texel& at(std::int64_t x, std::int64_t y) const
    {
        assert(x >= 0 && y >= 0 && x < width && y < height);
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

// What an API's conversion makes of a texel. Codes are divided by the greatest one: correctly rounded by the reference, with
// the error of a division by others.
template <class Real>
glm::vec<4, Real> decode_texel(const picture& p, std::size_t i)
{
    using texel = glm::vec<4, Real>;
    const auto ratio = [](std::uint32_t code, std::uint32_t top) { return Real(code) / Real(top); };
    switch (p.format) {
    case pixel_format::r32f:
    case pixel_format::d32f:
        return texel(Real(p.texel<float>(i)), Real(0), Real(0), Real(0));
    case pixel_format::rg32f: {
        const auto v = p.texel<std::array<float, 2>>(i);
        return texel(Real(v[0]), Real(v[1]), Real(0), Real(0));
    }
    case pixel_format::rgba32f: {
        const auto v = p.texel<std::array<float, 4>>(i);
        return texel(Real(v[0]), Real(v[1]), Real(v[2]), Real(v[3]));
    }
    case pixel_format::rgba16f: {
        const auto h = p.texel<std::array<std::uint16_t, 4>>(i);
        return texel(Real(half_to_float(h[0])), Real(half_to_float(h[1])), Real(half_to_float(h[2])), Real(half_to_float(h[3])));
    }
    case pixel_format::rgb10a2: {
        const auto code = p.texel<std::uint32_t>(i);
        return texel(ratio(code & 1023U, 1023), ratio(code >> 10U & 1023U, 1023), ratio(code >> 20U & 1023U, 1023),
                     ratio(code >> 30U, 3));
    }
    case pixel_format::rg16: {
        const auto code = p.texel<std::uint32_t>(i);
        return texel(ratio(code & 65535U, 65535), ratio(code >> 16U, 65535), Real(0), Real(0));
    }
    case pixel_format::d24: {
        const std::uint32_t code = p.texel<std::uint32_t>(i) & 0xffffffU;
        if constexpr (std::is_same_v<Real, float>) {
            return texel(Real(code) * d24_step, Real(0), Real(0), Real(0));
        }
        return texel(ratio(code, 0xffffff), Real(0), Real(0), Real(0));
    }
    case pixel_format::r8:
        return texel(ratio(static_cast<std::uint32_t>(p.texel<std::uint8_t>(i)), 255), Real(0), Real(0), Real(0));
    case pixel_format::rg32ui:
        break; // read as integers, not here
    }
    return texel(Real(0));
}

template <class Real>
values<Real> decode(const picture& p)
{
    values<Real> decoded(p.width, p.height);
    for (std::size_t i = 0; i < p.pixels(); ++i) {
        decoded.texels[i] = decode_texel<Real>(p, i);
    }
    return decoded;
}

namespace detail {

// Reads of one picture. An uncertain texel is the hull of those it may be, of the whole picture where they are many.
template <class Real>
class reader {
public:
    explicit reader(const values<Real>& source) : source_(&source) {}
    template <class Integer>
    typename values<Real>::texel operator()(const glm::vec<2, Integer>& at) const
    {
        return source_->at(at.x, at.y);
    }

private:
    const values<Real>* source_;
};

template <>
class reader<interval> {
public:
    explicit reader(const values<interval>& source) : source_(&source) { all_ = over(0, 0, source.width - 1, source.height - 1); }
    values<interval>::texel operator()(const glm::vec<2, integer_interval<std::int32_t>>& at) const
    {
        // Coordinates outside belong to reads whose result is not used.
        const std::int64_t left = inside(at.x.lo, source_->width);
        const std::int64_t right = inside(at.x.hi, source_->width);
        const std::int64_t top = inside(at.y.lo, source_->height);
        const std::int64_t bottom = inside(at.y.hi, source_->height);
        constexpr std::int64_t most = 64;
        return (right - left + 1) * (bottom - top + 1) <= most ? over(left, top, right, bottom) : all_;
    }

private:
    static std::int64_t inside(std::int64_t i, int size) { return i < 0 ? 0 : i >= size ? size - 1 : i; }
    values<interval>::texel over(std::int64_t left, std::int64_t top, std::int64_t right, std::int64_t bottom) const
    {
        values<interval>::texel all = source_->at(left, top);
        for (std::int64_t y = top; y <= bottom; ++y) {
            for (std::int64_t x = left; x <= right; ++x) {
                const values<interval>::texel& t = source_->at(x, y);
                all = { hull(all.x, t.x), hull(all.y, t.y), hull(all.z, t.z), hull(all.w, t.w) };
            }
        }
        return all;
    }

    const values<interval>* source_;
    values<interval>::texel all_;
};

// The callbacks of every pass; each pass uses those of its inputs.
template <class Real>
struct readers {
    using traits = real_traits<Real>;
    using ivec2 = glm::vec<2, typename traits::integer>;
    reader<Real> first;
    reader<Real> second;
    reader<Real> eye_depth;
    int depth_component; // of its texels
    reader<Real> tile;
    const std::vector<glm::vec4>* taps;
    bool stored_z; // a position picture: its z

    Real stored_depth(ivec2 pixel) const { return stored_z ? first(pixel).z : first(pixel).x; }
    Real depth(ivec2 pixel) const { return eye_depth(pixel)[depth_component]; }
    glm::vec<4, Real> normal(ivec2 pixel) const { return second(pixel); }
    glm::vec<2, Real> rotation(ivec2 pixel) const { return glm::vec<2, Real>(tile(pixel)); }
    glm::vec<4, Real> tap(int i) const
    {
        const glm::vec4 s = (*taps)[static_cast<std::size_t>(i)];
        return { Real(s.x), Real(s.y), Real(s.z), Real(s.w) };
    }
    Real visibility(ivec2 pixel) const { return first(pixel).x; }
    glm::vec<2, Real> row_sum(ivec2 pixel) const { return glm::vec<2, Real>(first(pixel)); }
    glm::vec<2, Real> packed(ivec2 pixel) const { return glm::vec<2, Real>(first(pixel)); }
};

} // namespace detail

// Runs plans of any structure; holds the tables and the pictures between the passes.
template <class Real>
class executor {
public:
    // `normal` may be empty where the plan reads none.
    executor(const plan& p, const picture& depth, const picture& normal) : plan_(p)
    {
        at(image_id::depth) = decode<Real>(depth);
        at(image_id::normal) = decode<Real>(normal);
        const auto tile = make_tile(p.settings);
        values<Real>& rotation = at(image_id::rotation) = values<Real>(tile_size, tile_size);
        for (std::size_t i = 0; i < tile.size(); ++i) {
            rotation.texels[i].x = Real(tile[i].x);
            rotation.texels[i].y = Real(tile[i].y);
        }
        const auto kernel = make_taps(p.settings);
        taps_.assign(kernel.begin(), kernel.end());
    }

    // The visibility before it is stored.
    const values<Real>& run()
    {
        if constexpr (std::is_same_v<Real, interval>) {
            if (plan_.settings.method == method::bitmask) {
                return anything();
            }
        }
        for (const pass& each : plan_.passes) {
            run_pass(each);
        }
        return at(image_id::visibility);
    }

    // Another tile of rotations, tile_size squared.
    void set_rotation(values<Real> tile) { at(image_id::rotation) = std::move(tile); }
    const values<Real>& image(image_id id) const { return images_[static_cast<std::size_t>(id)]; }

private:
    using resources = detail::readers<Real>;
    using ivec2 = typename resources::ivec2;

    values<Real>& at(image_id id) { return images_[static_cast<std::size_t>(id)]; }

    template <class Body>
    void over_pixels(const pass& each, Body&& body)
    {
        const extent size = extent_of(plan_, each.output);
        values<Real> written(size.width, size.height);
        for (int y = 0; y < written.height; ++y) {
            for (int x = 0; x < written.width; ++x) {
                const auto i =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(written.width) + static_cast<std::size_t>(x);
                body(ivec2(x, y), written.texels[i]);
            }
        }
        at(each.output) = std::move(written);
    }

    detail::reader<Real> reader_of(image_id id)
    {
        static const values<Real> nothing(1, 1);
        const values<Real>& image = at(id);
        return detail::reader<Real>(image.texels.empty() ? nothing : image);
    }

    void run_pass(const pass& each)
    {
        const pass_options& o = each.options;
        const bool denoises = each.type == pass_type::denoise_rows || each.type == pass_type::denoise_columns;
        const resources read{ reader_of(each.inputs[0]),
                              reader_of(each.inputs[1]),
                              reader_of(each.inputs[denoises && o.coarse ? 2 : 0]),
                              denoises && !o.coarse ? 1 : 0,
                              reader_of(image_id::rotation),
                              &taps_,
                              plan_.facts.depth == depth_source::position };
        switch (each.type) {
        case pass_type::linearize: {
            using body = linearize_pass<Real, resources>;
            body run{ read, o.affine };
            const auto c = convert_constants<typename body::ao_depth_decode, Real, linearize_constants, float>(
                constants_of<linearize_constants>(each));
            over_pixels(each, [&](ivec2 pixel, auto& out) { out.x = run.ao_linearize_pass(c, pixel); });
            break;
        }
        case pass_type::occlusion: {
            using body = occlusion_pass<Real, resources>;
            body run{ read, o.tap_count, o.normal_source, o.rotate_normals, o.parallel, o.limit_thickness, o.mark_background };
            const auto c = convert_constants<typename body::ao_occlusion_constants, Real, occlusion_constants, float>(
                constants_of<occlusion_constants>(each));
            over_pixels(each, [&](ivec2 pixel, auto& out) { out.x = run.ao_occlusion_pass(c, pixel); });
            break;
        }
        case pass_type::bitmask: {
            if constexpr (!std::is_same_v<Real, interval>) {
                run_bitmask(each, read);
            }
            break;
        }
        case pass_type::denoise_rows:
        case pass_type::denoise_columns: {
            using body = denoise_pass<Real, resources>;
            body run{ read, o.filter_radius, o.normal_source, o.rotate_normals, o.parallel, o.coarse };
            const auto c = convert_constants<typename body::ao_denoise_constants, Real, denoise_constants, float>(
                constants_of<denoise_constants>(each));
            if (each.type == pass_type::denoise_columns) {
                over_pixels(each, [&](ivec2 pixel, auto& out) { out.x = run.ao_denoise_columns_pass(c, pixel); });
                break;
            }
            over_pixels(each, [&](ivec2 pixel, auto& out) {
                const auto packed = run.ao_denoise_rows_pass(c, pixel);
                out.x = packed.x;
                out.y = packed.y;
            });
            break;
        }
        case pass_type::filter_rows:
        case pass_type::filter_columns: {
            using body = filter_pass<Real, resources>;
            body run{ read, o.filter_radius };
            const auto c = convert_constants<typename body::ao_filter_constants, Real, filter_constants, float>(
                constants_of<filter_constants>(each));
            if (each.type == pass_type::filter_columns) {
                over_pixels(each, [&](ivec2 pixel, auto& out) { out.x = run.ao_filter_columns_pass(c, pixel); });
                break;
            }
            over_pixels(each, [&](ivec2 pixel, auto& out) {
                const auto sums = run.ao_filter_rows_pass(c, pixel);
                out.x = sums.x;
                out.y = sums.y;
            });
            break;
        }
        }
    }

    // Which sectors a tap blocks has no bounds: nothing but the range is known of the method `bitmask` off exact drivers.
    const values<Real>& anything()
    {
        values<Real>& visibility = at(image_id::visibility) = values<Real>(plan_.facts.width, plan_.facts.height);
        for (auto& texel : visibility.texels) {
            texel.x = Real(0.0F, 1.0F);
        }
        return visibility;
    }

    void run_bitmask(const pass& each, const resources& read)
    {
        const pass_options& o = each.options;
        using body = bitmask_pass<Real, resources>;
        body run{ read, o.tap_count, o.slice_count, o.normal_source, o.rotate_normals, o.parallel, o.mark_background, o.coarse };
        const auto c = convert_constants<typename body::ao_occlusion_constants, Real, occlusion_constants, float>(
            constants_of<occlusion_constants>(each));
        over_pixels(each, [&](ivec2 pixel, auto& out) {
            if (!o.mark_background) {
                out.x = run.ao_bitmask_pass(c, pixel).visibility;
                return;
            }
            const auto packed = run.ao_bitmask_packed_pass(c, pixel);
            out.x = packed.x;
            out.y = packed.y;
        });
    }

    plan plan_;
    std::array<values<Real>, static_cast<std::size_t>(image_id::none) + 1> images_;
    std::vector<glm::vec4> taps_;
};

// The visibility of the reference, stored in the plan's output format; r8 rounds to the nearest code.
inline picture reference_visibility(const plan& p, const picture& depth, const picture& normal)
{
    executor<float> run(p, depth, normal);
    const values<float>& visibility = run.run();
    picture stored(p.facts.output_format, p.facts.width, p.facts.height);
    for (std::size_t i = 0; i < stored.pixels(); ++i) {
        const float v = visibility.texels[i].x;
        if (stored.format == pixel_format::r8) {
            stored.set_texel(i, static_cast<std::uint8_t>(std::nearbyint(v * 255.0F)));
        }
        else {
            stored.set_texel(i, v);
        }
    }
    return stored;
}

} // namespace ao::conformance
