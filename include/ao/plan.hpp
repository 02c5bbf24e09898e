// The plan: what runs in a frame, as plain data. Settings and facts of a scene go in; passes, their constants and the pictures
// between them come out; nothing the scene does not need is in it. No API: a backend executes it.
#pragma once

#include "ao/format.hpp"
#include "ao/passes.hpp"
#include "ao/projection.hpp"
#include "ao/result.hpp"
#include "ao/settings.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>

namespace ao {

enum class depth_source {
    linear,   // eye depth d = -z > 0, in r32f; 0, negative, NaN or infinite: background
    hardware, // a depth buffer, in d32f, d24 or r32f
    position, // view-space position, in rgba16f or rgba32f; only z is read, z >= 0: background
};

enum class normal_source {
    vector = occlusion_pass<float, no_resources>::ao_normal_vector,         // xyz, in rgba16f or rgba32f
    unorm10 = occlusion_pass<float, no_resources>::ao_normal_unorm10,       // xyz * 0.5 + 0.5, in rgb10a2
    octahedral = occlusion_pass<float, no_resources>::ao_normal_octahedral, // octahedral * 0.5 + 0.5, in rg16
    from_depth = occlusion_pass<float, no_resources>::ao_normal_from_depth, // none stored: rebuilt from depth
};

// What stays the same from frame to frame; another set of facts is another plan.
struct facts {
    int width = 0; // pixels
    int height = 0;
    depth_source depth = depth_source::linear;
    pixel_format depth_format = pixel_format::r32f;
    normal_source normals = normal_source::vector;
    pixel_format normal_format = pixel_format::rgba16f;
    bool world_normals = false;                      // stored in world space: camera::normal_to_view turns them
    bool parallel = false;                           // parallel projection
    pixel_format output_format = pixel_format::r32f; // or r8
};

// Eye depths beyond are background: products with them would leave the range of floats.
inline constexpr float max_eye_depth = 1e30F;

// What may change every frame.
struct camera {
    camera_projection projection;
    matrix3 normal_to_view{};         // a rotation, used where facts::world_normals
    float background = max_eye_depth; // eye depths from here on are background
};

enum class pass_type { linearize, occlusion, filter_rows, filter_columns, bitmask, denoise_rows, denoise_columns };

// Pictures a pass reads or writes. The first three belong to the host, `rotation` is a table, the rest are the program's own.
enum class image_id { depth, normal, visibility, rotation, linear_depth, raw_visibility, row_sums, none };

// Options of the pass bodies. A backend compiles them in (specialisation constants) or passes them as they are.
struct pass_options {
    bool affine = false;
    int tap_count = 0;
    int normal_source = 0;
    bool rotate_normals = false;
    bool parallel = false;
    bool limit_thickness = false;
    bool mark_background = false;
    int filter_radius = 0;
    int slice_count = 1;
    bool coarse = false;

    friend constexpr bool operator==(const pass_options&, const pass_options&) = default;
};

// Zero or more values in place, at most N.
template <class T, std::size_t N>
class inline_vector {
public:
    constexpr void push_back(const T& value) { items_.at(size_++) = value; }
    constexpr std::size_t size() const { return size_; }
    constexpr bool empty() const { return size_ == 0; }
    constexpr T& operator[](std::size_t i) { return items_[i]; }
    constexpr const T& operator[](std::size_t i) const { return items_[i]; }
    constexpr T* begin() { return items_.data(); }
    constexpr T* end() { return items_.data() + size_; }
    constexpr const T* begin() const { return items_.data(); }
    constexpr const T* end() const { return items_.data() + size_; }

private:
    std::array<T, N> items_{};
    std::size_t size_ = 0;
};

struct pass {
    pass_type type{};
    pass_options options;
    // linearize: depth. occlusion, bitmask: eye depth, normal (or none), rotation. filter_rows: visibility. filter_columns: row
    // sums. denoise_rows, denoise_columns: packed visibility and eye depth (packed_visibility.h), normal (or none); where coarse,
    // eye depth.
    std::array<image_id, 3> inputs{ image_id::none, image_id::none, image_id::none };
    image_id output = image_id::none;
    // The shared constants struct of the pass, as bytes.
    std::array<std::byte, 128> constants{};
    std::size_t constants_size = 0;
};

// A picture of the program's own.
struct transient_image {
    image_id id{};
    pixel_format format{};
    int width = 0; // texels
    int height = 0;
};

struct plan {
    ao::settings settings;
    ao::facts facts;
    inline_vector<pass, 4> passes;
    inline_vector<transient_image, 3> transients;
};

using linearize_constants = math<float>::ao_depth_decode;
using occlusion_constants = occlusion_pass<float, no_resources>::ao_occlusion_constants;
using denoise_constants = denoise_pass<float, no_resources>::ao_denoise_constants;
using filter_constants = filter_pass<float, no_resources>::ao_filter_constants;

// The constants of a pass (or a temporal step) as the struct that its body takes. Precondition: Constants is the one of its type.
template <class Constants, class Pass>
constexpr Constants constants_of(const Pass& p)
{
    assert(p.constants_size == sizeof(Constants));
    std::array<std::byte, sizeof(Constants)> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = p.constants[i];
    }
    return std::bit_cast<Constants>(bytes);
}

namespace detail {

template <class Pass, class Constants>
constexpr void set_constants(Pass& p, const Constants& constants)
{
    static_assert(sizeof(Constants) <= std::tuple_size_v<decltype(p.constants)>);
    const auto bytes = std::bit_cast<std::array<std::byte, sizeof(Constants)>>(constants);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        p.constants[i] = bytes[i];
    }
    p.constants_size = bytes.size();
}

constexpr std::optional<error> validate(const facts& f)
{
    using enum pixel_format;
    const auto fail = [](errc code, const char* why) { return error(code, why); };
    if (f.width < 1 || f.height < 1 || f.width > 65536 || f.height > 65536) {
        return fail(errc::invalid_size, "picture must have 1 to 65536 pixels a side");
    }
    const pixel_format d = f.depth_format;
    const bool depth_fits = f.depth == depth_source::linear     ? d == r32f
                            : f.depth == depth_source::hardware ? d == d32f || d == d24 || d == r32f
                                                                : d == rgba16f || d == rgba32f;
    if (!depth_fits) {
        return fail(errc::unsupported_format, "depth format does not fit the depth source");
    }
    const pixel_format n = f.normal_format;
    const bool normal_fits = f.normals == normal_source::from_depth   ? true
                             : f.normals == normal_source::vector     ? n == rgba16f || n == rgba32f
                             : f.normals == normal_source::unorm10    ? n == rgb10a2
                             : f.normals == normal_source::octahedral ? n == rg16
                                                                      : false;
    if (!normal_fits) {
        return fail(errc::unsupported_format, "normal format does not fit the normal source");
    }
    if (f.output_format != r32f && f.output_format != r8) {
        return fail(errc::unsupported_format, "visibility must be r32f or r8");
    }
    return std::nullopt;
}

constexpr linearize_constants make_linearize_constants(const facts& f, const projection_constants& folded)
{
    linearize_constants c = folded.decode;
    if (f.depth != depth_source::hardware) {
        c = {};
        c.scale = f.depth == depth_source::position ? -1.0F : 1.0F;
        c.background = folded.decode.background;
    }
    return c;
}

// Relative rounding of what linearize reads or the host stores, and of the depth buffer's own steps: what an error-free
// surface may seem to stand in front of itself (numerics.md 4.4), twice: for the pixel and for the tap.
// As eye depth: constant + d * (linear + d * quadratic).
struct depth_error {
    float constant = 0; // scene units
    float linear = 0;
    float quadratic = 0;
};

constexpr depth_error storage_error(const facts& f, const projection_constants& folded)
{
    constexpr float rounding = 1.1920929e-7F; // 2^-23, two half steps of a float
    depth_error e;
    e.linear = 2 * rounding;
    if (f.depth_format == pixel_format::rgba16f) {
        e.linear = 9.765625e-4F; // 2^-10; stores of half floats truncate on some drivers
    }
    if (f.depth == depth_source::hardware) {
        const auto magnitude = [](float x) { return x < 0 ? -x : x; };
        const float step = f.depth_format == pixel_format::d24 ? 2 * rounding : rounding;
        const float terms = step * magnitude(folded.decode.scale) + rounding * magnitude(folded.decode.offset);
        if (folded.parallel) {
            e.constant = terms;
            e.linear += 2 * rounding;
        }
        else if (f.depth_format == pixel_format::d24 || folded.decode.offset != 0) {
            e.quadratic = terms / magnitude(folded.decode.numerator);
        }
    }
    return e;
}

// Row by row, padded as ao_rotation is.
constexpr std::array<float, 12> rows_of(const matrix3& m)
{
    return { m[0][0], m[1][0], m[2][0], 0, m[0][1], m[1][1], m[2][1], 0, m[0][2], m[1][2], m[2][2], 0 };
}

} // namespace detail

// Rewrites the constants for this frame's camera; nothing is allocated and the structure stays.
constexpr std::optional<error> update(plan& p, const camera& view)
{
    const facts& f = p.facts;
    if (!(view.background > 0)) {
        return error(errc::invalid_projection, "background must be greater than 0");
    }
    const float background = view.background < max_eye_depth ? view.background : max_eye_depth;
    const result<projection_constants> folded = fold_projection(view.projection, f.width, f.height, background);
    if (!folded) {
        return folded.error();
    }
    if (folded->parallel != f.parallel) {
        return error(errc::invalid_projection, f.parallel ? "the plan is for a parallel projection, the camera has perspective"
                                                          : "the plan is for perspective, the camera has a parallel projection");
    }
    for (pass& each : p.passes) {
        switch (each.type) {
        case pass_type::linearize: {
            detail::set_constants(each, detail::make_linearize_constants(f, *folded));
            break;
        }
        case pass_type::occlusion:
        case pass_type::bitmask: {
            occlusion_constants c{};
            c.projection = std::bit_cast<decltype(c.projection)>(folded->projection);
            c.normal_to_view = std::bit_cast<decltype(c.normal_to_view)>(detail::rows_of(view.normal_to_view));
            const detail::depth_error e = detail::storage_error(f, *folded);
            c.radius = p.settings.radius;
            c.bias = p.settings.bias + e.constant;
            c.bias_linear = e.linear;
            c.bias_quadratic = e.quadratic;
            c.thickness = p.settings.thickness * p.settings.radius;
            c.background = background;
            c.width = static_cast<float>(f.width);
            c.height = static_cast<float>(f.height);
            detail::set_constants(each, c);
            break;
        }
        case pass_type::denoise_rows:
        case pass_type::denoise_columns: {
            denoise_constants c{};
            c.projection = std::bit_cast<decltype(c.projection)>(folded->projection);
            c.normal_to_view = std::bit_cast<decltype(c.normal_to_view)>(detail::rows_of(view.normal_to_view));
            c.width = static_cast<float>(f.width);
            c.height = static_cast<float>(f.height);
            // A neighbour counts up to a twenty-fifth of the radius or, by ao_plane_depth, a five-hundredth of the depth from the
            // tangent plane.
            c.plane_constant = 1.6e-3F * p.settings.radius * p.settings.radius;
            c.background = background;
            detail::set_constants(each, c);
            break;
        }
        case pass_type::filter_rows:
        case pass_type::filter_columns: {
            filter_constants c{};
            c.width = static_cast<float>(f.width);
            c.height = static_cast<float>(f.height);
            detail::set_constants(each, c);
            break;
        }
        }
    }
    return std::nullopt;
}

constexpr result<plan> make_plan(const settings& s, const facts& f, const camera& view)
{
    if (const auto wrong = validate(s)) {
        return *wrong;
    }
    if (const auto wrong = detail::validate(f)) {
        return *wrong;
    }
    plan p{ s, f, {}, {} };
    image_id depth = image_id::depth;

    // Linear depth is read as it is.
    if (f.depth != depth_source::linear) {
        pass linearize;
        linearize.type = pass_type::linearize;
        linearize.options.affine = f.depth == depth_source::position || f.parallel;
        linearize.inputs = { image_id::depth, image_id::none, image_id::none };
        linearize.output = depth = image_id::linear_depth;
        p.passes.push_back(linearize);
        p.transients.push_back({ image_id::linear_depth, pixel_format::r32f, f.width, f.height });
    }

    const bool filtered = s.filter > 1;
    const bool sliced = s.method == method::bitmask;
    pass occlusion;
    occlusion.type = sliced ? pass_type::bitmask : pass_type::occlusion;
    occlusion.options.tap_count = s.taps;
    occlusion.options.slice_count = sliced ? s.slices : 1;
    occlusion.options.normal_source = static_cast<int>(f.normals);
    occlusion.options.rotate_normals = f.world_normals && f.normals != normal_source::from_depth;
    occlusion.options.parallel = f.parallel;
    occlusion.options.limit_thickness = !sliced && s.thickness <= std::numeric_limits<float>::max();
    occlusion.options.mark_background = filtered;
    occlusion.options.coarse = s.resolution == resolution::half;
    occlusion.inputs = { depth, f.normals == normal_source::from_depth ? image_id::none : image_id::normal, image_id::rotation };
    occlusion.output = filtered ? image_id::raw_visibility : image_id::visibility;
    p.passes.push_back(occlusion);

    if (filtered) {
        const bool coarse = occlusion.options.coarse;
        const int rows_written = coarse ? (f.height + 1) / 2 : f.height;
        p.transients.push_back({ image_id::raw_visibility, sliced ? pixel_format::rg32f : pixel_format::r32f,
                                 coarse ? (f.width + 1) / 2 : f.width, rows_written });
        p.transients.push_back({ image_id::row_sums, pixel_format::rg32f, f.width, rows_written });
        pass rows;
        rows.type = sliced ? pass_type::denoise_rows : pass_type::filter_rows;
        rows.options.filter_radius = s.filter / 2;
        if (sliced) {
            rows.options.normal_source = occlusion.options.normal_source;
            rows.options.rotate_normals = occlusion.options.rotate_normals;
            rows.options.parallel = f.parallel;
            rows.options.coarse = coarse;
        }
        rows.inputs = { image_id::raw_visibility, sliced ? occlusion.inputs[1] : image_id::none,
                        coarse ? depth : image_id::none };
        rows.output = image_id::row_sums;
        p.passes.push_back(rows);
        pass columns = rows;
        columns.type = sliced ? pass_type::denoise_columns : pass_type::filter_columns;
        columns.inputs[0] = image_id::row_sums;
        columns.output = image_id::visibility;
        p.passes.push_back(columns);
    }
    if (const auto wrong = update(p, view)) {
        return *wrong;
    }
    return p;
}

struct extent {
    int width = 0; // texels
    int height = 0;
};

// Of a picture that a pass of the plan writes.
constexpr extent extent_of(const plan& p, image_id id)
{
    for (const transient_image& each : p.transients) {
        if (each.id == id) {
            return { each.width, each.height };
        }
    }
    return { p.facts.width, p.facts.height };
}

// True where both plans run the same passes over the same pictures with the same tables, so that a program prepared for one
// can run the other.
constexpr bool same_structure(const plan& a, const plan& b)
{
    if (a.passes.size() != b.passes.size() || a.facts.width != b.facts.width || a.facts.height != b.facts.height ||
        a.facts.depth_format != b.facts.depth_format || a.facts.normal_format != b.facts.normal_format ||
        a.facts.output_format != b.facts.output_format || a.settings.method != b.settings.method ||
        a.settings.seed != b.settings.seed) {
        return false;
    }
    for (std::size_t i = 0; i < a.passes.size(); ++i) {
        if (a.passes[i].type != b.passes[i].type || !(a.passes[i].options == b.passes[i].options) ||
            a.passes[i].inputs != b.passes[i].inputs || a.passes[i].output != b.passes[i].output) {
            return false;
        }
    }
    return true;
}

} // namespace ao
