// What every rasterizer makes of a scene and its draw plan before it uploads anything: draws, objects, materials and the camera
// as the shared geometry pass reads them (ao/shared/geometry_vertex.h).
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/math.hpp"
#include "ao/mesh_arrays.hpp"
#include "ao/projection.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ao {

using affine_map = math<float>::ao_affine_map;
using geometry_camera = math<float>::ao_geometry_camera;
using geometry_instance = math<float>::ao_geometry_instance;
using drawn_material = math<float>::ao_geometry_material;
static_assert(sizeof(affine_map) == 48 && sizeof(geometry_camera) == 208 && sizeof(geometry_instance) == 64 &&
              sizeof(drawn_material) == 32);

inline affine_map make_affine_map(const matrix4& m)
{
    const auto row = [&](int i) { return glm::vec4(m[0][i], m[1][i], m[2][i], m[3][i]); };
    return { row(0), row(1), row(2) };
}

// The specialisation constants of shaders of the geometry pass, by id: the options of ao/shared/geometry_pass.h and what else a
// variant and the facts decide. Variants alike in these share a shader.
using geometry_options = std::array<std::uint32_t, 13>;

inline geometry_options make_geometry_options(const draw_variant& v, const gbuffer_facts& f, bool driver_samples)
{
    return { v.alpha_map,
             v.normal_map,
             v.uvs,
             v.frame,
             v.deforming,
             f.position,
             f.normal,
             f.motion,
             f.ids,
             f.surface,
             f.frame,
             static_cast<std::uint32_t>(f.normals),
             reads_maps(v) && driver_samples };
}

// What an object's instance is made of, beside its matrices.
struct drawn_object {
    int object = 0; // of the scene
    int leaf = 0;   // the material that gives the geometry its maps
    bool mirrored = false;
};

// In the plan's order: the index of one is its slot.
inline std::vector<drawn_object> make_drawn_objects(const draw_plan& p)
{
    std::vector<drawn_object> objects;
    objects.reserve(p.draws.size());
    for (const draw& d : p.draws) {
        objects.push_back({ d.object, d.material, p.variants[static_cast<std::size_t>(d.variant)].mirrored });
    }
    return objects;
}

inline geometry_instance make_instance(const scene& s, const drawn_object& d)
{
    const object& o = s.objects[static_cast<std::size_t>(d.object)];
    return { make_affine_map(o.model), static_cast<std::uint32_t>(d.object + 1), static_cast<std::uint32_t>(o.material + 1),
             static_cast<std::uint32_t>(d.leaf), d.mirrored ? -1.0F : 1.0F };
}

inline affine_map make_previous_model(const scene& s, const drawn_object& d)
{
    return make_affine_map(s.objects[static_cast<std::size_t>(d.object)].previous_model);
}

// Whether the transforms of a scene's objects still fit what was planned from it.
inline std::optional<error> check_moved(const scene& s, std::size_t planned_objects, const std::vector<drawn_object>& drawn)
{
    if (s.objects.size() != planned_objects) {
        return error(errc::plan_mismatch, "the scene has another number of objects than the one loaded");
    }
    for (const drawn_object& d : drawn) {
        const object& moved = s.objects[static_cast<std::size_t>(d.object)];
        if (!detail::is_finite(moved.model) || !detail::is_finite(moved.previous_model)) {
            return error(errc::invalid_scene, detail::reason("object ", d.object, ": a transform that is not finite"));
        }
        if ((detail::determinant(moved.model) < 0) != d.mirrored) {
            return error(errc::plan_mismatch, detail::reason("object ", d.object,
                                                             " mirrors now and did not when it was planned, or the other way "
                                                             "round"));
        }
    }
    return std::nullopt;
}

// VkDrawIndexedIndirectCommand, which is OpenGL's too.
struct indirect_draw {
    std::uint32_t index_count;
    std::uint32_t instances;
    std::uint32_t first_index;
    std::int32_t base_vertex;
    std::uint32_t first_slot;
};
static_assert(sizeof(indirect_draw) == 20);

// Draws alike in pipeline and textures.
struct draw_batch {
    std::size_t variant = 0;
    std::size_t first = 0; // of the indirect draws
    std::size_t count = 0;
    int material = no_texture; // of all draws, where they were split by it
};

struct indirect_draws {
    std::vector<indirect_draw> draws;
    std::vector<draw_batch> batches;
};

// Objects in a row that share mesh and variant are instances of one draw. `split_materials`: a batch has one material where its
// variant reads maps, for drivers' samplers.
inline indirect_draws make_draws(const scene& s, const draw_plan& p, const mesh_arrays& arrays, bool split_materials)
{
    indirect_draws made;
    int mesh = -1;
    int material = -1;
    for (std::size_t slot = 0; slot < p.draws.size(); ++slot) {
        const draw& d = p.draws[slot];
        const auto o = static_cast<std::size_t>(d.object);
        const auto variant = static_cast<std::size_t>(d.variant);
        const bool textured = split_materials && reads_maps(p.variants[variant]);
        if (made.batches.empty() || made.batches.back().variant != variant || (textured && material != d.material)) {
            made.batches.push_back({ variant, made.draws.size(), 0, textured ? d.material : no_texture });
            mesh = -1;
        }
        material = d.material;
        if (s.objects[o].mesh != mesh) {
            mesh = s.objects[o].mesh;
            const placed_mesh& placed = arrays.meshes[static_cast<std::size_t>(mesh)];
            made.draws.push_back(
                { placed.index_count, 0, placed.first_index, placed.base_vertex, static_cast<std::uint32_t>(slot) });
            ++made.batches.back().count;
        }
        ++made.draws.back().instances;
    }
    return made;
}

// The alpha and normal maps that the draws of a plan read.
struct map_places {
    std::vector<int> places;       // by scene texture: its place among those read, or no_texture
    std::vector<texture> textures; // by place
};

inline map_places find_maps(const scene& s, const draw_plan& p)
{
    std::vector<char> read(s.textures.size());
    for (const draw& d : p.draws) {
        const draw_variant& v = p.variants[static_cast<std::size_t>(d.variant)];
        const standard_material& m = s.materials[static_cast<std::size_t>(d.material)];
        if (v.alpha_map) {
            read[static_cast<std::size_t>(m.alpha_map)] = 1;
        }
        if (v.normal_map) {
            read[static_cast<std::size_t>(m.normal_map)] = 1;
        }
    }
    map_places found;
    found.places.resize(read.size(), no_texture);
    for (std::size_t i = 0; i < read.size(); ++i) {
        if (read[i] != 0) {
            found.places[i] = static_cast<int>(found.textures.size());
            found.textures.push_back(s.textures[i]);
        }
    }
    return found;
}

// By scene material. Maps are places.
inline std::vector<drawn_material> make_drawn_materials(const scene& s, const map_places& maps)
{
    const auto place = [&](int map) {
        return map == no_texture ? 0U : static_cast<std::uint32_t>(std::max(maps.places[static_cast<std::size_t>(map)], 0));
    };
    std::vector<drawn_material> materials;
    materials.reserve(s.materials.size());
    for (const standard_material& m : s.materials) {
        materials.push_back({ m.repeat, std::max(m.repeat.x * m.repeat.x, m.repeat.y * m.repeat.y), m.alpha_cutoff,
                              place(m.alpha_map), m.alpha_from_red ? 1U : 0U, place(m.normal_map),
                              m.normal_green_down ? -1.0F : 1.0F });
    }
    return materials;
}

// A camera as the geometry pass reads it, and the state that goes with it.
struct geometry_view {
    geometry_camera camera{};
    float far_end = 1;   // what depth is cleared to: 1 (closer is less) or 0 (closer is greater)
    bool turned = false; // what turns counter-clockwise in view space turns clockwise along rows in memory
};

// `zero_to_one`: depth in clip space is to be 0 ... w whatever the projection's own range is, else it stays as it is.
// Precondition: both projections are supported (fold_projection).
inline geometry_view make_geometry_view(const gbuffer_camera& c, const gbuffer_facts& f, bool zero_to_one)
{
    const auto folded = fold_projection(c.projection, f.width, f.height);
    geometry_view view;
    view.far_end = folded->decode.cleared;
    view.turned = (folded->projection.scale_x < 0) != (folded->projection.scale_y < 0);
    view.camera.view = make_affine_map(c.view);
    matrix4 projection = c.projection.matrix;
    for (int column = 0; column < 4; ++column) {
        if (c.projection.rows == first_row::at_ndc_plus_one) {
            projection[column][1] = -projection[column][1];
        }
        if (zero_to_one && c.projection.range == depth_range::minus_one_to_one) {
            projection[column][2] = 0.5F * (projection[column][2] + projection[column][3]);
        }
    }
    view.camera.clip = make_affine_map(projection);
    view.camera.clip_w = { projection[0][3], projection[1][3], projection[2][3], projection[3][3] };
    if (f.motion) {
        const auto previous = fold_projection(c.previous_projection, f.width, f.height);
        view.camera.previous_view = make_affine_map(c.previous_view);
        view.camera.previous_projection = previous->projection;
        view.camera.previous_parallel = previous->parallel ? 1 : 0;
    }
    return view;
}

} // namespace ao
