// Plans as constant expressions: what a scene does not need is not in them, and a new camera keeps the structure.
#include "ao/plan.hpp"

#include <initializer_list>

namespace {

using enum ao::pass_type;
using enum ao::image_id;

constexpr ao::facts scene()
{
    ao::facts f;
    f.width = 64;
    f.height = 48;
    return f;
}
constexpr ao::camera view(bool parallel = false)
{
    ao::projection_options options;
    options.parallel = parallel;
    return { ao::make_projection({}, options), {}, std::numeric_limits<float>::max() };
}
template <class Change>
constexpr ao::facts scene_with(Change change)
{
    ao::facts f = scene();
    change(f);
    return f;
}
template <class Change>
constexpr ao::settings with(Change change)
{
    ao::settings s;
    change(s);
    return s;
}
constexpr ao::plan planned(const ao::settings& s, const ao::facts& f)
{
    return *ao::make_plan(s, f, view(f.parallel));
}
constexpr bool runs(const ao::plan& p, std::initializer_list<ao::pass_type> types)
{
    if (p.passes.size() != types.size()) {
        return false;
    }
    std::size_t i = 0;
    for (const ao::pass_type type : types) {
        if (p.passes[i++].type != type) {
            return false;
        }
    }
    return true;
}
constexpr bool holds(const ao::plan& p, std::initializer_list<ao::image_id> ids)
{
    if (p.transients.size() != ids.size()) {
        return false;
    }
    std::size_t i = 0;
    for (const ao::image_id id : ids) {
        if (p.transients[i++].id != id) {
            return false;
        }
    }
    return true;
}

// Every picture of the program's own is written before it is read, and every one is read.
constexpr bool flows(const ao::plan& p)
{
    for (const ao::transient_image& t : p.transients) {
        bool written = false;
        bool read = false;
        for (const ao::pass& each : p.passes) {
            for (const ao::image_id in : each.inputs) {
                if (in == t.id) {
                    if (!written) {
                        return false;
                    }
                    read = true;
                }
            }
            written = written || each.output == t.id;
        }
        if (!written || !read) {
            return false;
        }
    }
    return p.passes[p.passes.size() - 1].output == visibility;
}

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr ao::settings unfiltered = with([](auto& s) {
    s.filter = 1;
    s.thickness = inf;
});

constexpr ao::plan least = planned(unfiltered, scene());
static_assert(runs(least, { occlusion }) && least.transients.empty() && flows(least));
static_assert(least.passes[0].inputs[0] == depth && least.passes[0].inputs[1] == normal && least.passes[0].inputs[2] == rotation);
static_assert(!least.passes[0].options.rotate_normals && !least.passes[0].options.limit_thickness &&
              !least.passes[0].options.mark_background && !least.passes[0].options.parallel);

constexpr ao::plan filtered = planned({}, scene());
static_assert(runs(filtered, { occlusion, filter_rows, filter_columns }) && holds(filtered, { raw_visibility, row_sums }));
static_assert(flows(filtered) && filtered.passes[0].options.mark_background && filtered.passes[1].options.filter_radius == 2);

constexpr ao::facts hardware = scene_with([](auto& f) {
    f.depth = ao::depth_source::hardware;
    f.depth_format = ao::pixel_format::d32f;
});
constexpr ao::plan from_hardware = planned({}, hardware);
static_assert(runs(from_hardware, { linearize, occlusion, filter_rows, filter_columns }) && flows(from_hardware));
static_assert(holds(from_hardware, { linear_depth, raw_visibility, row_sums }) && !from_hardware.passes[0].options.affine);

constexpr ao::facts positions = scene_with([](auto& f) {
    f.depth = ao::depth_source::position;
    f.depth_format = ao::pixel_format::rgba16f;
});
static_assert(runs(planned(unfiltered, positions), { linearize, occlusion }) &&
              planned(unfiltered, positions).passes[0].options.affine);

// No stored normals: none is bound, and nothing is turned.
constexpr ao::facts bare = scene_with([](auto& f) {
    f.normals = ao::normal_source::from_depth;
    f.world_normals = true;
});
static_assert(planned({}, bare).passes[0].inputs[1] == none && !planned({}, bare).passes[0].options.rotate_normals);
static_assert(planned({}, scene_with([](auto& f) { f.world_normals = true; })).passes[0].options.rotate_normals);
static_assert(planned({}, scene_with([](auto& f) { f.parallel = true; })).passes[0].options.parallel);
static_assert(planned(with([](auto& s) { s.thickness = 1; }), scene()).passes[0].options.limit_thickness);
static_assert(planned(with([](auto& s) { s.taps = 7; }), scene()).passes[0].options.tap_count == 7);

// Every structure that can come up flows.
constexpr bool all_flow()
{
    for (int bits = 0; bits < 16; ++bits) {
        ao::facts f = (bits & 1) != 0 ? hardware : (bits & 2) != 0 ? positions : scene();
        f.normals = (bits & 4) != 0 ? ao::normal_source::from_depth : ao::normal_source::vector;
        if (!flows(planned((bits & 8) != 0 ? unfiltered : ao::settings{}, f))) {
            return false;
        }
    }
    return true;
}
static_assert(all_flow());

constexpr bool camera_keeps_structure()
{
    ao::plan p = from_hardware;
    ao::camera moved = view();
    moved.projection = ao::make_projection({ -0.2, 0.4, -0.3, 0.3, 0.5, 80 });
    if (ao::update(p, moved) || !ao::same_structure(p, from_hardware)) {
        return false;
    }
    const auto before = ao::constants_of<ao::occlusion_constants>(from_hardware.passes[1]);
    const auto after = ao::constants_of<ao::occlusion_constants>(p.passes[1]);
    return before.projection.scale_x != after.projection.scale_x && before.radius == after.radius;
}
static_assert(camera_keeps_structure());

constexpr ao::plan changed(ao::settings s)
{
    return planned(s, scene());
}
static_assert(ao::same_structure(filtered, changed(with([](auto& s) { s.radius = 9; }))));
static_assert(ao::same_structure(filtered, changed(with([](auto& s) { s.bias = 9; }))));
static_assert(!ao::same_structure(filtered, changed(with([](auto& s) { s.taps = 9; }))));
static_assert(!ao::same_structure(filtered, changed(with([](auto& s) { s.filter = 9; }))));
static_assert(!ao::same_structure(filtered, changed(with([](auto& s) { s.seed = 9; }))));
static_assert(ao::same_structure(filtered, changed(with([](auto& s) { s.thickness = 9; }))));
static_assert(!ao::same_structure(filtered, changed(with([](auto& s) { s.thickness = inf; }))));
static_assert(!ao::same_structure(filtered, changed(with([](auto& s) { s.method = ao::method::box; }))));
static_assert(!ao::same_structure(filtered, from_hardware));

constexpr bool refused(const ao::settings& s, const ao::facts& f, const ao::camera& c, ao::errc code)
{
    const auto p = ao::make_plan(s, f, c);
    return !p && p.error().code() == code && !p.error().reason().empty();
}
using enum ao::errc;
static_assert(refused(with([](auto& s) { s.taps = 0; }), scene(), view(), invalid_settings));
static_assert(refused({}, {}, view(), invalid_size));
static_assert(refused({}, scene_with([](auto& f) { f.width = 65537; }), view(), invalid_size));
static_assert(refused({}, scene_with([](auto& f) { f.height = -1; }), view(), invalid_size));
static_assert(refused({}, scene_with([](auto& f) { f.depth_format = ao::pixel_format::rgba16f; }), view(), unsupported_format));
static_assert(refused({}, scene_with([](auto& f) {
                          f.depth = ao::depth_source::hardware;
                          f.depth_format = ao::pixel_format::rg16;
                      }),
                      view(), unsupported_format));
static_assert(refused({}, scene_with([](auto& f) { f.depth = ao::depth_source::position; }), view(), unsupported_format));
static_assert(refused({}, scene_with([](auto& f) { f.normal_format = ao::pixel_format::rg16; }), view(), unsupported_format));
static_assert(refused({}, scene_with([](auto& f) { f.normals = ao::normal_source::octahedral; }), view(), unsupported_format));
static_assert(refused({}, scene_with([](auto& f) { f.normals = ao::normal_source::unorm10; }), view(), unsupported_format));
static_assert(refused({}, scene_with([](auto& f) { f.output_format = ao::pixel_format::rg32f; }), view(), unsupported_format));
static_assert(refused({}, scene(), view(true), invalid_projection));
static_assert(refused({}, scene_with([](auto& f) { f.parallel = true; }), view(false), invalid_projection));
static_assert(refused({}, scene(), { view().projection, {}, 0.0F }, invalid_projection));
static_assert(refused({}, scene(), { view().projection, {}, std::numeric_limits<float>::quiet_NaN() }, invalid_projection));
static_assert(refused({}, scene(), { { ao::matrix4::zero(), {}, {} }, {}, 1.0F }, invalid_projection));

// Constants structs: reals only, a multiple of four.
static_assert(sizeof(ao::linearize_constants) == 32 && sizeof(ao::occlusion_constants) == 112 &&
              sizeof(ao::filter_constants) == 16);
static_assert(sizeof(ao::occlusion_pass<double, ao::no_resources>::ao_occlusion_constants) == 224);

} // namespace
