// Running the pass bodies over plain pictures in host memory, for any Real type.
#pragma once

#include "unit/core_support.hpp"

#include "ao/kernel.hpp"
#include "ao/plan.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace core_test {

// What a G-buffer delivers to the passes.
struct pictures {
    int width = 0;
    int height = 0;
    std::vector<float> depth;       // eye depth, 0 for background
    std::vector<glm::vec3> normals; // view space

    pictures(int w, int h, float d = 0.0F, glm::vec3 n = { 0, 0, 1 })
        : width(w),
          height(h),
          depth(static_cast<std::size_t>(w * h), d),
          normals(depth.size(), n)
    {
    }
    std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1));
    }
};

// Answers the occlusion pass from pictures; `on_depth` and `on_normal` hear of every texel that is read.
template <class Real>
struct picture_resources {
    using m = ao::math<Real>;
    const pictures* source;
    std::array<glm::vec4, ao::max_taps> kernel;
    std::array<glm::vec2, ao::tile_size * ao::tile_size> tile;
    std::function<void(std::size_t)> on_depth;
    std::function<void(std::size_t)> on_normal;

    picture_resources(const pictures& p, const ao::settings& s)
        : source(&p),
          kernel(ao::make_kernel(s.method, s.taps, s.seed)),
          tile(ao::make_rotation_tile(s.seed))
    {
    }
    std::size_t index(const typename m::ivec2& pixel, int i) const { return source->index(at(pixel.x, i), at(pixel.y, i)); }
    Real depth(typename m::ivec2 pixel) const
    {
        return each<Real>([&](int i) {
            const std::size_t k = index(pixel, i);
            if (on_depth) {
                on_depth(k);
            }
            return source->depth[k];
        });
    }
    typename m::vec4 normal(typename m::ivec2 pixel) const
    {
        if (on_normal) {
            for (int i = 0; i < width_of<Real>; ++i) {
                on_normal(index(pixel, i));
            }
        }
        const auto part = [&](int k) { return each<Real>([&](int i) { return source->normals[index(pixel, i)][k]; }); };
        return { part(0), part(1), part(2), Real(0) };
    }
    typename m::vec2 rotation(typename m::ivec2 texel) const
    {
        const auto part = [&](int k) {
            return each<Real>(
                [&](int i) { return tile[static_cast<std::size_t>(at(texel.y, i) * ao::tile_size + at(texel.x, i))][k]; });
        };
        return { part(0), part(1) };
    }
    typename m::vec4 tap(int i) const
    {
        const glm::vec4& s = kernel[static_cast<std::size_t>(i)];
        return { Real(s.x), Real(s.y), Real(s.z), Real(s.w) };
    }
};

template <class Pass>
void set_options(Pass& body, const ao::pass_options& o)
{
    body.ao_tap_count = o.tap_count;
    body.ao_normal_source = o.normal_source;
    body.ao_rotate_normals = o.rotate_normals;
    body.ao_parallel = o.parallel;
    body.ao_limit_thickness = o.limit_thickness;
    body.ao_mark_background = o.mark_background;
}

inline const ao::pass& pass_of(const ao::plan& p, ao::pass_type type)
{
    return *std::find_if(p.passes.begin(), p.passes.end(), [&](const ao::pass& each) { return each.type == type; });
}

// f(pixel) for every pixel, width_of<Real> at a time.
template <class Real, class F>
void for_each_pixel(int width, int height, F f)
{
    using m = ao::math<Real>;
    using integer = typename m::integer;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; x += width_of<Real>) {
            f(x, y, typename m::ivec2(each<integer>([&](int i) { return std::min(x + i, width - 1); }), integer(y)));
        }
    }
}

// The occlusion pass of a plan with linear depth, over the whole picture.
template <class Real, class Resources = picture_resources<Real>>
std::vector<float> run_occlusion(const ao::plan& p, const Resources& resources)
{
    using body_type = ao::occlusion_pass<Real, Resources>;
    const ao::pass& planned = pass_of(p, ao::pass_type::occlusion);
    body_type body{ resources };
    set_options(body, planned.options);
    const auto plain = ao::constants_of<ao::occlusion_constants>(planned);
    const auto constants =
        ao::convert_constants<typename body_type::ao_occlusion_constants, Real, ao::occlusion_constants, float>(plain);
    std::vector<float> visibility(static_cast<std::size_t>(p.facts.width * p.facts.height));
    for_each_pixel<Real>(p.facts.width, p.facts.height, [&](int x, int y, const typename ao::math<Real>::ivec2& pixel) {
        const Real v = body.ao_occlusion_pass(constants, pixel);
        for (int i = 0; i < width_of<Real> && x + i < p.facts.width; ++i) {
            visibility[static_cast<std::size_t>(y * p.facts.width + x + i)] = static_cast<float>(at(v, i));
        }
    });
    return visibility;
}

template <class Real>
struct filter_resources {
    using m = ao::math<Real>;
    int width;
    int height;
    const std::vector<float>* source;
    const std::vector<glm::vec2>* sums;

    std::size_t index(const typename m::ivec2& p, int i) const
    {
        return static_cast<std::size_t>(at(p.y, i) * width + at(p.x, i));
    }
    Real visibility(typename m::ivec2 pixel) const
    {
        return each<Real>([&](int i) { return (*source)[index(pixel, i)]; });
    }
    typename m::vec2 row_sum(typename m::ivec2 pixel) const
    {
        return { each<Real>([&](int i) { return (*sums)[index(pixel, i)].x; }),
                 each<Real>([&](int i) { return (*sums)[index(pixel, i)].y; }) };
    }
};

// Both filter passes; `size` is settings::filter.
template <class Real>
std::vector<float> run_filter(const std::vector<float>& raw, int width, int height, int size)
{
    using body_type = ao::filter_pass<Real, filter_resources<Real>>;
    std::vector<glm::vec2> sums(raw.size());
    std::vector<float> filtered(raw.size());
    body_type body{ { width, height, &raw, &sums } };
    body.ao_filter_radius = size / 2;
    const typename body_type::ao_filter_constants constants{ Real(width), Real(height), Real(0), Real(0) };
    for_each_pixel<Real>(width, height, [&](int x, int y, const typename ao::math<Real>::ivec2& pixel) {
        const auto sum = body.ao_filter_rows_pass(constants, pixel);
        for (int i = 0; i < width_of<Real> && x + i < width; ++i) {
            sums[static_cast<std::size_t>(y * width + x + i)] = { static_cast<float>(at(sum.x, i)),
                                                                  static_cast<float>(at(sum.y, i)) };
        }
    });
    for_each_pixel<Real>(width, height, [&](int x, int y, const typename ao::math<Real>::ivec2& pixel) {
        const Real v = body.ao_filter_columns_pass(constants, pixel);
        for (int i = 0; i < width_of<Real> && x + i < width; ++i) {
            filtered[static_cast<std::size_t>(y * width + x + i)] = static_cast<float>(at(v, i));
        }
    });
    return filtered;
}

// A plan for linear depth and view-space normals.
inline ao::plan plan_for(const pictures& p, const ao::settings& s, const ao::camera& view, bool parallel = false,
                         ao::normal_source normals = ao::normal_source::vector)
{
    ao::facts f;
    f.width = p.width;
    f.height = p.height;
    f.normals = normals;
    f.normal_format = ao::pixel_format::rgba32f;
    f.parallel = parallel;
    const auto made = ao::make_plan(s, f, view);
    if (!made) {
        throw std::logic_error(std::string(made.error().reason())); // a fault of the test
    }
    return *made;
}

// Symmetric camera with square pixels; `extent`: half the picture's height at distance 1 (in scene units if parallel).
inline ao::camera simple_camera(int width, int height, double extent = 0.6, bool parallel = false)
{
    const double wide = extent * width / height;
    ao::projection_options options;
    options.parallel = parallel;
    ao::camera view;
    view.projection = ao::make_projection({ -wide, wide, -extent, extent, 0.1, 1000 }, options);
    return view;
}

// A wavy, stepped surface with some background: something in which every code path is taken.
inline pictures rough_scene(int width, int height, std::uint32_t seed)
{
    pictures p(width, height);
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    directions random(seed + 1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = p.index(x, y);
            const int block = (x / 5 * 7 + y / 4 * 3) % 4;
            const float wave = 0.3F * static_cast<float>((x * 13 + y * 29) % 17) / 17.0F;
            p.depth[i] = unit(engine) < 0.08F ? 0.0F : 3.0F + 0.4F * static_cast<float>(block) + wave;
            const auto n = random.next();
            p.normals[i] = { 0.4F * n[0], 0.4F * n[1], 0.7F + 0.3F * n[2] };
        }
    }
    return p;
}

} // namespace core_test
