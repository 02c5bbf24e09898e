#include "ao/gl/rasterizer.hpp"

#include "limits.hpp"
#include "raster_textures.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace ao::gl {

namespace {

// By batch.
std::vector<std::array<GLuint, 2>> sampled_maps(const scene& s, const map_places& maps, const raster_model_state& state)
{
    std::vector<std::array<GLuint, 2>> names;
    for (const draw_batch& batch : state.batches) {
        const draw_variant& v = state.pipelines[batch.variant].variant;
        const auto name = [&](int map, bool read) {
            return read ? state.textures[static_cast<std::size_t>(maps.places[static_cast<std::size_t>(map)])].name() : 0U;
        };
        if (batch.material == no_texture) {
            names.push_back({});
            continue;
        }
        const standard_material& m = s.materials[static_cast<std::size_t>(batch.material)];
        names.push_back({ name(m.alpha_map, v.alpha_map), name(m.normal_map, v.normal_map) });
    }
    return names;
}

void attach_buffers(const functions& gl, const raster_model_state& state)
{
    for (const raster_pipeline& pipeline : state.pipelines) {
        const GLuint name = pipeline.vertex_array.name();
        for (GLuint i = 0; i < attribute_count; ++i) {
            if (state.attributes[i].name() != 0) {
                const int floats = i == slot_attribute ? 1 : vertex_attribute_floats[i];
                gl.VertexArrayVertexBuffer(name, i, state.attributes[i].name(), 0, 4 * floats);
            }
        }
        gl.VertexArrayElementBuffer(name, state.indices.name());
    }
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values)
{
    return std::as_bytes(std::span(values));
}

void upload_objects(buffer_maker& buffers, const scene& s, raster_model_state& into)
{
    std::vector<geometry_instance> instances;
    instances.reserve(into.objects.size());
    for (const drawn_object& d : into.objects) {
        instances.push_back(make_instance(s, d));
    }
    into.instances = buffers.storage("the table of objects", bytes_of(instances), GL_DYNAMIC_STORAGE_BIT);
    if (into.facts.motion) {
        std::vector<affine_map> previous;
        previous.reserve(into.objects.size());
        for (const drawn_object& d : into.objects) {
            previous.push_back(make_previous_model(s, d));
        }
        into.previous = buffers.storage("the table of last frame's objects", bytes_of(previous), GL_DYNAMIC_STORAGE_BIT);
    }
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
        state->samples = state->samples || reads_maps(v);
    }
    if (const auto wrong = make_pipelines(gl, options_, p, *state)) {
        return *wrong;
    }

    buffer_maker buffers(gl);
    const map_places maps = find_maps(s, p);
    if (state->samples) {
        state->materials = upload_materials(buffers, s, maps);
        if (hardware) {
            state->textures = upload_textures(buffers, gl, maps);
        }
        else {
            state->heap = upload_heap(buffers, maps);
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
        for (std::size_t i = 0; i < vertex_attribute_count; ++i) {
            if (!arrays.streams[i].empty()) {
                state->attributes[i] = buffers.make("vertices", bytes_of(arrays.streams[i]), 0);
            }
        }
        state->indices = buffers.make("indices", bytes_of(arrays.indices), 0);
        indirect_draws draws = make_draws(s, p, arrays, hardware);
        state->draws = buffers.make("draws", bytes_of(draws.draws), 0);
        state->batches = std::move(draws.batches);
        state->maps = sampled_maps(s, maps, *state);
    }
    std::vector<GLuint> slots(p.draws.size());
    std::iota(slots.begin(), slots.end(), 0U);
    state->attributes[slot_attribute] = buffers.make("objects", bytes_of(slots), 0);

    state->objects = make_drawn_objects(p);
    upload_objects(buffers, s, *state);
    const std::array<geometry_camera, 1> no_camera{};
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
    if (const auto wrong = check_moved(s, state.scene_objects, state.objects)) {
        return wrong;
    }
    // In pieces, so that it takes little memory.
    constexpr std::size_t piece = 4096;
    std::vector<geometry_instance> instances;
    std::vector<affine_map> previous;
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
            previous.push_back(make_previous_model(s, state.objects[slot]));
        }
        upload(instances, state.instances, first);
        if (state.facts.motion) {
            upload(previous, state.previous, first);
        }
    }
    return std::nullopt;
}

} // namespace ao::gl
