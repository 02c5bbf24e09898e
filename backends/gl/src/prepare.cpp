#include "ao/gl/backend.hpp"
#include "ao/kernel.hpp"
#include "limits.hpp"
#include "shader.hpp"
#include "state.hpp"
#include "unpack_state.hpp"

#include <array>
#include <utility>

namespace ao::gl {

namespace {

void make_tables(const functions& gl, program_state& state, const settings& s)
{
    const auto taps = make_taps(s);
    state.taps = make_object(gl, object_type::buffer, gl.CreateBuffers);
    gl.NamedBufferStorage(state.taps.name(), sizeof taps, taps.data(), 0);
    state.images[index_of(image_id::rotation)] = make_tile_texture(gl, make_tile(s));
}

} // namespace

object make_texture(const functions& gl, GLenum format, int width, int height)
{
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
    gl.TextureStorage2D(name, 1, format, width, height);
    return object(gl, object_type::texture, name);
}

object make_sampler(const functions& gl)
{
    object sampler = make_object(gl, object_type::sampler, gl.CreateSamplers);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
    return sampler;
}

object make_tile_texture(const functions& gl, std::span<const glm::vec2> tile)
{
    object rotations = make_texture(gl, GL_RG32F, tile_size, tile_size);
    const plain_unpack_state plain(gl);
    gl.TextureSubImage2D(rotations.name(), 0, 0, 0, tile_size, tile_size, GL_RG, GL_FLOAT, tile.data());
    return rotations;
}

result<object> make_framebuffer(const functions& gl, GLuint texture)
{
    object framebuffer = make_object(gl, object_type::framebuffer, gl.CreateFramebuffers);
    gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture, 0);
    const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return error(errc::device, "the driver does not render to a picture of the passes", static_cast<int>(status));
    }
    return framebuffer;
}

result<program> backend::prepare(const plan& p)
{
    const functions& gl = *gl_;
    gl.take_error();
    if (const auto wrong = check_size(gl, options_, p.facts.width, p.facts.height)) {
        return *wrong;
    }
    auto state = std::make_unique<program_state>();
    for (const transient_image& each : p.transients) {
        state->images[index_of(each.id)] = make_texture(gl, internal_format(each.format), each.width, each.height);
        state->formats[index_of(each.id)] = internal_format(each.format);
    }
    state->formats[index_of(image_id::visibility)] = internal_format(p.facts.output_format);
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("allocating the pictures of the passes", code);
    }
    make_tables(gl, *state, p.settings);
    state->constants = make_object(gl, object_type::buffer, gl.CreateBuffers);
    gl.NamedBufferStorage(state->constants.name(), constants_stride * static_cast<GLsizeiptr>(p.passes.size()), nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
    state->sampler = make_sampler(gl);
    if (options_.route == route::fragment) {
        state->vertex_array = make_object(gl, object_type::vertex_array, gl.CreateVertexArrays);
    }
    for (const pass& each : p.passes) {
        result<object> linked = link_pass(gl, options_, each, p.facts.depth == depth_source::position);
        if (!linked) {
            return linked.error();
        }
        linked_pass made;
        made.type = each.type;
        made.program = std::move(*linked);
        if (options_.route == route::fragment && each.output != image_id::visibility) {
            result<object> framebuffer = make_framebuffer(gl, state->images[index_of(each.output)].name());
            if (!framebuffer) {
                return framebuffer.error();
            }
            made.framebuffer = std::move(*framebuffer);
        }
        state->passes.push_back(std::move(made));
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("preparing the passes", code);
    }
    return program(std::move(state));
}

} // namespace ao::gl
