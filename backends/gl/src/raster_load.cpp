#include "ao/gl/rasterizer.hpp"

#include "limits.hpp"
#include "raster_meshes.hpp"
#include "raster_textures.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace ao::gl {

namespace {

// Indirect draws and batches; slots are places in the plan's order.
std::vector<indirect_draw> make_draws(const scene& s, const draw_plan& p, const mesh_arrays& arrays,
                                      const std::vector<int>& places, bool hardware, raster_model_state& into)
{
    std::vector<indirect_draw> draws;
    int mesh = -1;
    int material = -1;
    for (std::size_t slot = 0; slot < p.draws.size(); ++slot) {
        const draw& d = p.draws[slot];
        const auto o = static_cast<std::size_t>(d.object);
        const auto variant = static_cast<std::size_t>(d.variant);
        const bool textured = hardware && samples(p.variants[variant]);
        if (into.batches.empty() || into.batches.back().variant != variant || (textured && material != d.material)) {
            draw_batch batch{ variant, draws.size(), 0, 0, 0 };
            if (textured) {
                const standard_material& m = s.materials[static_cast<std::size_t>(d.material)];
                const auto name = [&](int map, bool wanted) {
                    return wanted ? into.textures[static_cast<std::size_t>(places[static_cast<std::size_t>(map)])].name() : 0U;
                };
                batch.alpha_map = name(m.alpha_map, p.variants[variant].alpha_map);
                batch.normal_map = name(m.normal_map, p.variants[variant].normal_map);
            }
            into.batches.push_back(batch);
            mesh = -1;
        }
        material = d.material;
        if (s.objects[o].mesh != mesh) {
            mesh = s.objects[o].mesh;
            const placed_mesh& placed = arrays.meshes[static_cast<std::size_t>(mesh)];
            draws.push_back({ placed.index_count, 0, placed.first_index, placed.base_vertex, static_cast<GLuint>(slot) });
            ++into.batches.back().count;
        }
        ++draws.back().instances;
    }
    return draws;
}

void attach_buffers(const functions& gl, const raster_model_state& state)
{
    constexpr std::array<GLsizei, attribute_count> strides{ 12, 12, 16, 8, 12, 4 };
    for (const raster_pipeline& pipeline : state.pipelines) {
        const GLuint name = pipeline.vertex_array.name();
        for (GLuint i = 0; i < attribute_count; ++i) {
            if (state.attributes[i].name() != 0) {
                gl.VertexArrayVertexBuffer(name, i, state.attributes[i].name(), 0, strides[i]);
            }
        }
        gl.VertexArrayElementBuffer(name, state.indices.name());
    }
}

instance make_instance(const scene& s, const drawn_object& d)
{
    const ao::object& o = s.objects[static_cast<std::size_t>(d.object)];
    return { affine_map(o.model), static_cast<std::uint32_t>(d.object + 1), static_cast<std::uint32_t>(o.material + 1),
             static_cast<std::uint32_t>(d.leaf), d.mirrored ? -1.0F : 1.0F };
}

raster_math::ao_affine_map make_previous(const scene& s, const drawn_object& d)
{
    return affine_map(s.objects[static_cast<std::size_t>(d.object)].previous_model);
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values)
{
    return std::as_bytes(std::span(values));
}

void upload_objects(buffer_maker& buffers, const scene& s, raster_model_state& into)
{
    std::vector<instance> instances;
    instances.reserve(into.objects.size());
    for (const drawn_object& d : into.objects) {
        instances.push_back(make_instance(s, d));
    }
    into.instances = buffers.storage("the table of objects", bytes_of(instances), GL_DYNAMIC_STORAGE_BIT);
    if (into.facts.motion) {
        std::vector<raster_math::ao_affine_map> previous;
        previous.reserve(into.objects.size());
        for (const drawn_object& d : into.objects) {
            previous.push_back(make_previous(s, d));
        }
        into.previous = buffers.storage("the table of last frame's objects", bytes_of(previous), GL_DYNAMIC_STORAGE_BIT);
    }
}

std::optional<error> check_moved(const scene& s, const raster_model_state& state)
{
    if (s.objects.size() != state.scene_objects) {
        return error(errc::plan_mismatch, "the scene has another number of objects than the one loaded");
    }
    for (const drawn_object& d : state.objects) {
        const ao::object& moved = s.objects[static_cast<std::size_t>(d.object)];
        if (!ao::detail::is_finite(moved.model) || !ao::detail::is_finite(moved.previous_model)) {
            return error(errc::invalid_scene, "object " + std::to_string(d.object) + ": a transform that is not finite");
        }
        if ((ao::detail::determinant(moved.model) < 0) != d.mirrored) {
            return error(errc::plan_mismatch, "object " + std::to_string(d.object) +
                                                  " mirrors now and did not when it was planned, or the other way round");
        }
    }
    return std::nullopt;
}

} // namespace

result<raster_model> rasterizer::load(const scene& s, const draw_plan& p)
{
    const functions& gl = *gl_;
    gl.take_error();
    options limits;
    limits.route = route::fragment;
    if (const auto wrong = check_size(gl, limits, p.facts.width, p.facts.height)) {
        return *wrong;
    }
    auto state = std::make_unique<raster_model_state>();
    state->facts = p.facts;
    state->scene_objects = s.objects.size();
    const bool hardware = options_.sampling == sampling::hardware;
    for (const draw_variant& v : p.variants) {
        state->samples = state->samples || samples(v);
    }
    if (const auto wrong = make_pipelines(gl, options_, p, *state)) {
        return *wrong;
    }

    buffer_maker buffers(gl);
    const std::vector<int> places = read_textures(s, p);
    if (state->samples) {
        state->materials = upload_materials(buffers, s, places);
        if (hardware) {
            state->textures = upload_textures(buffers, gl, s, places);
        }
        else {
            state->heap = upload_heap(buffers, s, places);
        }
    }
    if (buffers.failed()) {
        return *buffers.failed();
    }
    {
        const mesh_arrays arrays = gather_meshes(s, p);
        if (arrays.too_large) {
            return error(errc::out_of_memory, "the meshes have more than 2^31 vertices or indices");
        }
        for (std::size_t i = 0; i < attribute_count; ++i) {
            if (!arrays.streams[i].empty()) {
                state->attributes[i] = buffers.make("vertices", bytes_of(arrays.streams[i]), 0);
            }
        }
        state->indices = buffers.make("indices", bytes_of(arrays.indices), 0);
        const std::vector<indirect_draw> draws = make_draws(s, p, arrays, places, hardware, *state);
        state->draws = buffers.make("draws", bytes_of(draws), 0);
    }
    std::vector<GLuint> slots(p.draws.size());
    std::iota(slots.begin(), slots.end(), 0U);
    state->attributes[slot_attribute] = buffers.make("objects", bytes_of(slots), 0);

    for (const draw& d : p.draws) {
        state->objects.push_back({ d.object, d.material, p.variants[static_cast<std::size_t>(d.variant)].mirrored });
    }
    upload_objects(buffers, s, *state);
    const std::array<camera_block, 1> no_camera{};
    state->camera = buffers.make("the camera", std::as_bytes(std::span(no_camera)), GL_DYNAMIC_STORAGE_BIT);
    if (buffers.failed()) {
        return *buffers.failed();
    }
    attach_buffers(gl, *state);
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("loading the scene", code);
    }
    return raster_model(std::move(state));
}

std::optional<error> rasterizer::move(model& loaded, const scene& s)
{
    const functions& gl = *gl_;
    const raster_model_state& state = *loaded.state_;
    if (const auto wrong = check_moved(s, state)) {
        return wrong;
    }
    // In pieces, so that it takes little memory.
    constexpr std::size_t piece = 4096;
    std::vector<instance> instances;
    std::vector<raster_math::ao_affine_map> previous;
    const auto upload = [&](const auto& values, const object& into, std::size_t first) {
        const auto size = static_cast<GLsizeiptr>(sizeof values[0]);
        gl.NamedBufferSubData(into.name(), size * static_cast<GLintptr>(first), size * static_cast<GLsizeiptr>(values.size()),
                              values.data());
    };
    for (std::size_t first = 0; first < state.objects.size(); first += piece) {
        instances.clear();
        previous.clear();
        for (std::size_t slot = first; slot < std::min(first + piece, state.objects.size()); ++slot) {
            instances.push_back(make_instance(s, state.objects[slot]));
            previous.push_back(make_previous(s, state.objects[slot]));
        }
        upload(instances, state.instances, first);
        if (state.facts.motion) {
            upload(previous, state.previous, first);
        }
    }
    return std::nullopt;
}

} // namespace ao::gl
