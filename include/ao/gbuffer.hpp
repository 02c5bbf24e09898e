// The geometry pass as plain data: which targets it fills, and which objects it draws in which order with which shader variant.
// A rasterizer is a backend's executor of it.
#pragma once

#include "ao/plan.hpp"
#include "ao/scene.hpp"
#include "ao/scene_check.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ao {

// Targets of a geometry pass; depth is always there. What is off costs nothing.
struct gbuffer_facts {
    int width = 0; // pixels
    int height = 0;
    pixel_format depth_format = pixel_format::d32f;       // or d24; cleared to the far end of the range
    bool position = false;                                // view space, w = 1; background 0 0 0 0
    pixel_format position_format = pixel_format::rgba32f; // or rgba16f
    bool normal = true; // view space, unit, towards the eye on two-sided surfaces seen from behind; background 0
    normal_source normals = normal_source::vector; // as facts::normals; from_depth means none
    pixel_format normal_format = pixel_format::rgba16f;
    bool motion = false; // where the point was in the last frame minus where it is, in pixels; background 0
    pixel_format motion_format = pixel_format::rg32f; // or rgba32f: z = eye depth in the last frame, 0 behind the eye; w = 0
    bool ids = false;     // rg32ui: object + 1, object::material + 1 in two's complement; background 0 0
    bool surface = false; // rgba32f: uv, squared length of the longer screen derivative of uv, side (+1 front, -1 back)
    // rgba32f: what ao_packed_frame makes of the interpolated normal and tangent, for blends whose leaves have normal maps of
    // their own (draw_variant::frame), else 0. As seen from the front: the side is in `surface`.
    bool frame = false;
};

// What the shader of an object has to do. Objects alike in this share a pipeline; nothing else compiles one.
struct draw_variant {
    bool alpha_map = false;
    bool normal_map = false; // only where the normal target asks for it
    bool cull_back = false;
    bool mirrored = false;     // the model matrix turns winding around
    bool deforming = false;    // reads previous positions
    bool flat_normals = false; // the mesh has none: the triangle's own, counter-clockwise
    bool uvs = false;          // reads texture coordinates; without them `surface` gets 0
    bool frame = false;        // fills the target `frame`

    friend constexpr auto operator<=>(const draw_variant&, const draw_variant&) = default;
};

struct draw {
    int object = 0;   // index into scene::objects
    int material = 0; // index into scene::materials: the leaf that gives the geometry its maps
    int variant = 0;  // index into draw_plan::variants
};

struct draw_plan {
    gbuffer_facts facts;
    std::vector<draw_variant> variants; // those in use, each once
    std::vector<draw> draws;            // by variant, then material, then object
    std::size_t skipped_triangles = 0;  // with a vertex that is not finite
};

// The indices of a mesh without triangles that have a vertex that is not finite. Precondition: indices in range.
inline std::vector<std::uint32_t> drawable_indices(const mesh& m)
{
    std::vector<std::uint32_t> kept;
    kept.reserve(m.indices.size());
    for (std::size_t i = 0; i + 3 <= m.indices.size(); i += 3) {
        const auto triangle = m.indices.subspan(i, 3);
        if (std::all_of(triangle.begin(), triangle.end(), [&](auto v) { return detail::is_finite(m.positions[v]); })) {
            kept.insert(kept.end(), triangle.begin(), triangle.end());
        }
    }
    return kept;
}

namespace detail {

inline std::optional<error> validate(const gbuffer_facts& f)
{
    using enum pixel_format;
    const auto fail = [](errc code, const char* why) { return error(code, why); };
    if (f.width < 1 || f.height < 1 || f.width > 65536 || f.height > 65536) {
        return fail(errc::invalid_size, "picture must have 1 to 65536 pixels a side");
    }
    if (f.depth_format != d32f && f.depth_format != d24) {
        return fail(errc::unsupported_format, "a depth buffer that is drawn into must be d32f or d24");
    }
    if (f.position && f.position_format != rgba16f && f.position_format != rgba32f) {
        return fail(errc::unsupported_format, "positions must be rgba16f or rgba32f");
    }
    if (f.motion && f.motion_format != rg32f && f.motion_format != rgba32f) {
        return fail(errc::unsupported_format, "motion must be rg32f or rgba32f");
    }
    const pixel_format n = f.normal_format;
    const bool fits = f.normals == normal_source::vector       ? n == rgba16f || n == rgba32f
                      : f.normals == normal_source::unorm10    ? n == rgb10a2
                      : f.normals == normal_source::octahedral ? n == rg16
                                                               : false;
    if (f.normal && !fits) {
        return fail(errc::unsupported_format, "normal format does not fit the normal source");
    }
    return std::nullopt;
}

// Of the 3x3 part; its sign says whether winding is turned around.
constexpr double determinant(const matrix4& m)
{
    const auto at = [&](int row, int column) { return static_cast<double>(m[column][row]); };
    return at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) - at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
           at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
}

inline draw_variant variant_of(const mesh& m, const standard_material& geometry, const material_needs& needs, const object& o,
                               const gbuffer_facts& f)
{
    draw_variant v;
    v.alpha_map = geometry.alpha_map != no_texture;
    v.normal_map = f.normal && needs.normal_map;
    v.cull_back = !geometry.two_sided;
    v.mirrored = determinant(o.model) < 0;
    v.deforming = f.motion && !m.previous_positions.empty();
    v.frame = f.frame && needs.frame;
    v.flat_normals = (f.normal || v.frame) && m.normals.empty();
    v.uvs = !m.uvs.empty() && (v.alpha_map || v.normal_map || f.surface);
    return v;
}

} // namespace detail

// Whether shading the scene needs gbuffer_facts::frame. Precondition: a valid scene.
inline bool needs_frame(const scene& s)
{
    const material_table materials(s);
    return std::any_of(s.objects.begin(), s.objects.end(), [&](const object& o) { return materials[o.material].frame; });
}

// Fails as validate does, and for sizes and formats that do not fit. Objects of meshes without triangles are not drawn.
inline result<draw_plan> plan_drawing(const scene& s, const gbuffer_facts& facts)
{
    draw_plan plan;
    plan.facts = facts;
    gbuffer_facts& f = plan.facts;
    f.normal = f.normal && f.normals != normal_source::from_depth;
    if (const auto wrong = detail::validate(f)) {
        return *wrong;
    }
    if (const auto wrong = validate(s)) {
        return *wrong;
    }
    std::vector<char> visible(s.meshes.size());
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const std::size_t drawable = drawable_indices(s.meshes[i]).size();
        visible[i] = drawable != 0 ? 1 : 0;
        plan.skipped_triangles += (s.meshes[i].indices.size() - drawable) / 3;
    }

    const material_table materials(s);
    std::vector<draw_variant> variants;
    for (std::size_t i = 0; i < s.objects.size(); ++i) {
        const object& o = s.objects[i];
        if (visible[static_cast<std::size_t>(o.mesh)] == 0) {
            continue;
        }
        const material_needs& needs = materials[o.material];
        const draw_variant v = detail::variant_of(s.meshes[static_cast<std::size_t>(o.mesh)],
                                                  s.materials[static_cast<std::size_t>(needs.geometry)], needs, o, f);
        std::size_t slot = 0;
        while (slot < variants.size() && variants[slot] != v) {
            ++slot;
        }
        if (slot == variants.size()) {
            variants.push_back(v);
        }
        plan.draws.push_back({ static_cast<int>(i), needs.geometry, static_cast<int>(slot) });
    }
    plan.variants = variants;
    std::sort(plan.variants.begin(), plan.variants.end());
    std::vector<int> rank(variants.size());
    for (std::size_t i = 0; i < variants.size(); ++i) {
        rank[i] =
            static_cast<int>(std::lower_bound(plan.variants.begin(), plan.variants.end(), variants[i]) - plan.variants.begin());
    }
    for (draw& d : plan.draws) {
        d.variant = rank[static_cast<std::size_t>(d.variant)];
    }
    std::stable_sort(plan.draws.begin(), plan.draws.end(), [](const draw& a, const draw& b) {
        return a.variant != b.variant ? a.variant < b.variant : a.material < b.material;
    });
    return plan;
}

// The host's pictures; those that the facts leave out are not looked at.
template <class Image>
struct gbuffer_images {
    Image depth{};
    Image position{};
    Image normal{};
    Image motion{};
    Image ids{};
    Image surface{};
    Image frame{};
};

// This frame's and the last frame's camera. `jitter` is part of the projections where there is any.
struct gbuffer_camera {
    camera_projection projection;
    matrix4 view; // world to view space, a rotation and a translation
    camera_projection previous_projection;
    matrix4 previous_view;
};

// image and commands: as in `backend`. model: a scene uploaded and its pipelines. targets: a model's pass bound to pictures.
template <class R>
concept rasterizer = requires
{
    typename R::image;
    typename R::commands;
    typename R::model;
    typename R::targets;
}
&&std::movable<typename R::model>&&
    std::movable<typename R::targets>&& requires(R& r, typename R::model& model, typename R::targets& targets,
                                                 typename R::commands commands, const scene& s, const draw_plan& p,
                                                 const gbuffer_images<typename R::image>& images, const gbuffer_camera& camera)
{
    // Uploads and compiles; slow. The scene's memory may go afterwards.
    {
        r.load(s, p)
        } -> std::same_as<result<typename R::model>>;
    // Object transforms as they are now in the scene's objects: call when they move, before record.
    {
        r.move(model, s)
        } -> std::same_as<std::optional<error>>;
    {
        r.bind(model, images)
        } -> std::same_as<result<typename R::targets>>;
    // Records the pass: clears the targets and draws. Allocates and compiles nothing.
    { r.record(commands, model, targets, camera) };
};

} // namespace ao
