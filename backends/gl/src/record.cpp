#include "ao/gl/backend.hpp"
#include "saved_state.hpp"
#include "state.hpp"

#include <cassert>
#include <cstring>
#include <optional>

namespace ao::gl {

namespace {

void upload_constants(const functions& gl, const program_state& program, linked_pass& into, const pass& p, GLintptr offset)
{
    if (into.has_uploaded && std::memcmp(into.uploaded.data(), p.constants.data(), p.constants_size) == 0) {
        return;
    }
    gl.NamedBufferSubData(program.constants.name(), offset, static_cast<GLsizeiptr>(p.constants_size), p.constants.data());
    into.uploaded = p.constants;
    into.has_uploaded = true;
}

void bind_inputs(const functions& gl, const program_state& program, const binding_state& bound, const pass& p, GLintptr offset)
{
    std::array<GLuint, max_inputs> textures{};
    std::array<GLuint, max_inputs> samplers{};
    for (std::size_t i = 0; i < textures.size(); ++i) {
        // A unit that is not read gets the first input: name 0 would unbind textures of other targets too.
        const image_id id = p.inputs[i] == image_id::none ? p.inputs[0] : p.inputs[i];
        textures[i] = bound.images[index_of(id)];
        samplers[i] = program.sampler.name();
    }
    gl.BindTextures(0, max_inputs, textures.data());
    gl.BindSamplers(0, max_inputs, samplers.data());
    gl.BindBufferRange(GL_UNIFORM_BUFFER, constants_index, program.constants.name(), offset,
                       static_cast<GLsizeiptr>(p.constants_size));
    gl.BindBufferBase(GL_UNIFORM_BUFFER, taps_index, program.taps.name());
}

void dispatch(const functions& gl, const options& chosen, const program_state& program, const binding_state& bound, const plan& p,
              const pass& each)
{
    const std::size_t output = index_of(each.output);
    gl.BindImageTexture(0, bound.images[output], 0, GL_FALSE, 0, GL_WRITE_ONLY, program.formats[output]);
    const auto groups = [](int pixels, unsigned size) { return (static_cast<GLuint>(pixels) + size - 1) / size; };
    // Stores wait for whoever still reads the picture, and fetches for the stores.
    gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    const extent size = extent_of(p, each.output);
    gl.DispatchCompute(groups(size.width, chosen.group_width), groups(size.height, chosen.group_height), 1);
    const GLbitfield handed_over =
        GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT;
    gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | (each.output == image_id::visibility ? handed_over : 0U));
}

void draw(const functions& gl, const program_state& program, const linked_pass& linked, const binding_state& bound, extent size)
{
    const bool own = linked.framebuffer.name() != 0;
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, own ? linked.framebuffer.name() : bound.framebuffer.name());
    gl.BindVertexArray(program.vertex_array.name());
    const std::array<GLfloat, 4> viewport{ 0.0F, 0.0F, static_cast<GLfloat>(size.width), static_cast<GLfloat>(size.height) };
    gl.ViewportIndexedfv(0, viewport.data());
    gl.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    for (const GLenum capability : switched_off) {
        gl.Disable(capability);
    }
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Disablei(GL_BLEND, 0);
    gl.Disablei(GL_SCISSOR_TEST, 0);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace

void backend::record_pass(commands, program& prepared, binding& bound, const plan& p, std::size_t index)
{
    const functions& gl = *gl_;
    program_state& state = *prepared.state_;
    const pass& each = p.passes[index];
    linked_pass& linked = state.passes[index];
    assert(index < p.passes.size() && p.passes.size() == state.passes.size() && each.type == linked.type);

    std::optional<saved_state> before;
    if (options_.restore_state) {
        const bool compute = options_.route == route::compute;
        before.emplace(gl, touched{ .textures = max_inputs,
                                    .uniform_buffers = 2,
                                    .images = compute ? 1U : 0U,
                                    .color_targets = compute ? 0U : 1U });
    }
    const GLintptr offset = constants_stride * static_cast<GLintptr>(index);
    upload_constants(gl, state, linked, each, offset);
    gl.UseProgram(linked.program.name());
    bind_inputs(gl, state, *bound.state_, each, offset);
    if (options_.route == route::compute) {
        dispatch(gl, options_, state, *bound.state_, p, each);
    }
    else {
        draw(gl, state, linked, *bound.state_, extent_of(p, each.output));
    }
}

} // namespace ao::gl
