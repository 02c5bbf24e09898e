#include "ao/gl/temporal.hpp"

#include "ao_gl_shaders.hpp"
#include "buffer.hpp"
#include "compile.hpp"
#include "host_texture.hpp"
#include "limits.hpp"
#include "shader.hpp"
#include "state.hpp"
#include "temporal_state.hpp"

#include <array>
#include <string>
#include <utility>

namespace ao::gl {

namespace {

// Constant ids of the shaders: options in the order of temporal_options, then the group size.
constexpr std::array<GLuint, 14> accumulate_ids{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 13, 14, 15 };
constexpr std::array<GLuint, 5> filter_ids{ 2, 9, 11, 14, 15 };

source source_of(temporal_pass_type type)
{
    using namespace shaders;
    switch (type) {
    case temporal_pass_type::filter_rows:
        return { temporal_rows_comp, temporal_rows_comp_text, filter_ids, "temporal filter rows" };
    case temporal_pass_type::filter_columns:
        return { temporal_columns_comp, temporal_columns_comp_text, filter_ids, "temporal filter columns" };
    case temporal_pass_type::resolve:
        return { temporal_resolve_comp, temporal_resolve_comp_text, filter_ids, "resolve" };
    case temporal_pass_type::accumulate:
    case temporal_pass_type::linearize:
        break;
    }
    return { temporal_accumulate_comp, temporal_accumulate_comp_text, accumulate_ids, "accumulate" };
}

result<object> link_step(const functions& gl, const options& chosen, const temporal_step& step, const facts& f)
{
    const temporal_options& o = step.options;
    if (step.type == temporal_pass_type::linearize) {
        pass same;
        same.type = pass_type::linearize;
        same.options.affine = o.affine;
        return link_pass(gl, chosen, same, f.depth == depth_source::position);
    }
    const std::array<GLuint, 16> values{ static_cast<GLuint>(o.most_samples),
                                         static_cast<GLuint>(o.contribution),
                                         static_cast<GLuint>(o.history_format),
                                         static_cast<GLuint>(o.invalidation),
                                         o.reproject,
                                         o.use_motion,
                                         o.cubic,
                                         static_cast<GLuint>(o.normal_source),
                                         o.rotate_normals,
                                         o.parallel,
                                         o.limit_thickness,
                                         static_cast<GLuint>(o.filter_radius),
                                         o.affine,
                                         static_cast<GLuint>(o.slice_taps),
                                         chosen.group_width,
                                         chosen.group_height };
    const source from = source_of(step.type);
    result<object> compiled = compile(gl, chosen.source, GL_COMPUTE_SHADER, from, values);
    if (!compiled) {
        return compiled.error();
    }
    return link(gl, from.name, { &*compiled, 1 });
}

// A buffer as texels; `what` names it in the error.
result<object> make_buffer_texture(const functions& gl, const char* what, const object& buffer, GLenum format, std::size_t texels)
{
    const auto limit = static_cast<std::size_t>(gl.integer(GL_MAX_TEXTURE_BUFFER_SIZE));
    if (texels > limit) {
        return error(errc::out_of_memory, std::string(what) + ": " + std::to_string(texels) + " texels, the driver takes " +
                                              std::to_string(limit) + " in a buffer texture");
    }
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    object made(gl, object_type::texture, name);
    gl.TextureBuffer(name, format, buffer.name());
    return made;
}

} // namespace

result<temporal_program> temporal::prepare_temporal(const temporal_plan& p)
{
    const functions& gl = *gl_;
    gl.take_error();
    const facts& f = p.facts.frame;
    if (const auto wrong = check_size(gl, options_, f.width, f.height)) {
        return *wrong;
    }
    auto state = std::make_unique<temporal_program_state>();
    state->plan = p;
    buffer_maker buffers(gl);
    for (object& history : state->histories) {
        history = buffers.storage_of_size("a history", history_bytes(p), GL_DYNAMIC_STORAGE_BIT);
    }
    const auto groups = [](int pixels, unsigned size) { return (static_cast<std::size_t>(pixels) + size - 1) / size; };
    const std::size_t tiles = groups(f.width, options_.group_width) * groups(f.height, options_.group_height);
    state->tiles = buffers.storage_of_size("the tiles to be filtered", 16 + 8 * tiles, GL_DYNAMIC_STORAGE_BIT);
    const auto taps = make_temporal_taps(p.settings);
    state->taps = buffers.storage("the sequence of samples", std::as_bytes(std::span(taps)), 0);
    if (buffers.failed()) {
        return *buffers.failed();
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const bool precise = p.settings.format == history_format::precise;
        const std::size_t pixels = static_cast<std::size_t>(f.width) * static_cast<std::size_t>(f.height);
        result<object> texels =
            make_buffer_texture(gl, "a history", state->histories[i], precise ? GL_RGBA32UI : GL_RG32UI, pixels);
        if (!texels) {
            return texels.error();
        }
        state->history_textures[i] = std::move(*texels);
    }
    result<object> sequence = make_buffer_texture(gl, "the sequence of samples", state->taps, GL_RGBA32F, taps.size());
    if (!sequence) {
        return sequence.error();
    }
    state->tap_texture = std::move(*sequence);
    state->constants = make_object(gl, object_type::buffer, gl.CreateBuffers);
    gl.NamedBufferStorage(state->constants.name(), temporal_stride * static_cast<GLsizeiptr>(p.steps.size()), nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
    state->rotations = make_tile_texture(gl, make_tile(p.settings));
    state->sampler = make_sampler(gl);
    if (p.linearize) {
        state->linear = make_texture(gl, GL_R32F, f.width, f.height);
    }
    for (const temporal_step& step : p.steps) {
        if (step.type == temporal_pass_type::filter_rows) {
            state->rows = make_texture(gl, GL_R32F, f.width, f.height);
        }
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("allocating the pictures of the passes", code);
    }
    for (const temporal_step& step : p.steps) {
        result<object> linked = link_step(gl, options_, step, f);
        if (!linked) {
            return linked.error();
        }
        state->programs.push_back(std::move(*linked));
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("preparing the passes", code);
    }
    return temporal_program(std::move(state));
}

result<temporal_binding> temporal::bind_temporal(temporal_program& program, const temporal_plan& p,
                                                 const temporal_images<image>& images)
{
    const functions& gl = *gl_;
    gl.take_error();
    const temporal_program_state& from = *program.state_;
    if (!same_program(from.plan, p)) {
        return error(errc::plan_mismatch, "the program was prepared for another plan");
    }
    const facts& f = p.facts.frame;
    auto state = std::make_unique<temporal_binding_state>();
    const auto read = [&](GLuint texture, const char* role, pixel_format format, object& view,
                          GLuint& into) -> std::optional<error> {
        if (const auto wrong = check_texture(gl, texture, role, format, f.width, f.height)) {
            return wrong;
        }
        const result<GLuint> readable = make_readable(gl, texture, role, format, view);
        if (!readable) {
            return readable.error();
        }
        into = *readable;
        return std::nullopt;
    };
    if (const auto wrong = read(images.depth, "depth", f.depth_format, state->depth_view, state->stored_depth)) {
        return *wrong;
    }
    state->depth = p.linearize ? from.linear.name() : state->stored_depth;
    // What is not read gets eye depth: name 0 would unbind textures of other targets too.
    state->normal = state->motion = state->depth;
    if (f.normals != normal_source::from_depth) {
        if (const auto wrong = read(images.normal, "normal", f.normal_format, state->normal_view, state->normal)) {
            return *wrong;
        }
    }
    if (p.facts.motion) {
        if (const auto wrong = read(images.motion, "motion", p.facts.motion_format, state->motion_view, state->motion)) {
            return *wrong;
        }
    }
    if (const auto wrong = check_texture(gl, images.visibility, "visibility", f.output_format, f.width, f.height)) {
        return *wrong;
    }
    state->visibility = images.visibility;
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("binding the textures", code);
    }
    return temporal_binding(std::move(state));
}

} // namespace ao::gl
