#include "ao/gl/temporal.hpp"
#include "saved_state.hpp"
#include "state.hpp"
#include "temporal_state.hpp"

#include <array>
#include <cassert>
#include <optional>

namespace ao::gl {

namespace {

// Units that a step does not read get whatever fits: name 0 would unbind textures of other targets too.
std::array<GLuint, temporal_inputs> inputs_of(temporal_pass_type type, const temporal_program_state& program,
                                              const temporal_binding_state& bound, const temporal_frame& frame)
{
    const bool accumulates = type == temporal_pass_type::accumulate;
    const auto history = static_cast<std::size_t>(accumulates ? frame.read : frame.write);
    std::array<GLuint, temporal_inputs> inputs{};
    inputs.fill(type == temporal_pass_type::linearize ? bound.stored_depth : bound.depth);
    inputs[history_unit] = program.history_textures[history].name();
    if (accumulates) {
        inputs = { bound.depth,          bound.normal,
                   bound.motion,         program.rotations.name(),
                   inputs[history_unit], program.tap_texture.name() };
    }
    if (type == temporal_pass_type::filter_columns) {
        inputs[row_unit] = program.rows.name();
    }
    return inputs;
}

} // namespace

void temporal::record_temporal(commands, temporal_program& program, temporal_binding& bound, const temporal_plan& p,
                               const temporal_frame& frame, std::size_t index)
{
    const functions& gl = *gl_;
    const temporal_program_state& state = *program.state_;
    const temporal_binding_state& pictures = *bound.state_;
    assert(index < frame.steps.size() && frame.steps[index] < state.programs.size());
    const std::size_t which = frame.steps[index];
    const temporal_step& step = p.steps[which];
    assert(step.type == state.plan.steps[which].type);

    std::optional<saved_state> before;
    if (options_.restore_state) {
        before.emplace(gl, touched{ .textures = temporal_inputs,
                                    .buffer_textures = true,
                                    .uniform_buffers = 1,
                                    .storage_buffers = 1,
                                    .images = 1,
                                    .dispatch = true });
    }
    const GLintptr offset = temporal_stride * static_cast<GLintptr>(which);
    gl.NamedBufferSubData(state.constants.name(), offset, static_cast<GLsizeiptr>(step.constants_size), step.constants.data());

    gl.UseProgram(state.programs[which].name());
    std::array<GLuint, temporal_inputs> samplers{};
    samplers.fill(state.sampler.name());
    gl.BindTextures(0, temporal_inputs, inputs_of(step.type, state, pictures, frame).data());
    gl.BindSamplers(0, temporal_inputs, samplers.data());
    gl.BindBufferRange(GL_UNIFORM_BUFFER, constants_index, state.constants.name(), offset,
                       static_cast<GLsizeiptr>(step.constants_size));
    if (step.type == temporal_pass_type::accumulate) {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, written_index, program.history(frame.write));
    }
    else {
        const bool own = step.type == temporal_pass_type::linearize || step.type == temporal_pass_type::filter_rows;
        const GLuint picture = !own                                         ? pictures.visibility
                               : step.type == temporal_pass_type::linearize ? state.linear.name()
                                                                            : state.rows.name();
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, written_index, state.tiles.name());
        gl.BindImageTexture(0, picture, 0, GL_FALSE, 0, GL_WRITE_ONLY,
                            own ? GL_R32F : internal_format(p.facts.frame.output_format));
    }
    const auto groups = [](int pixels, unsigned size) { return (static_cast<GLuint>(pixels) + size - 1) / size; };
    // Stores wait for whoever still reads what they overwrite, and what reads next for the stores.
    gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                     GL_BUFFER_UPDATE_BARRIER_BIT);
    if (step.type == temporal_pass_type::resolve) {
        gl.ClearNamedBufferData(state.tiles.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    }
    if (step.type == temporal_pass_type::filter_rows || step.type == temporal_pass_type::filter_columns) {
        gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state.tiles.name());
        gl.DispatchComputeIndirect(0);
    }
    else {
        gl.DispatchCompute(groups(p.facts.frame.width, options_.group_width), groups(p.facts.frame.height, options_.group_height),
                           1);
    }
    const bool last = index + 1 == frame.steps.size();
    const GLbitfield handed_over = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                                   GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT;
    gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | (last ? handed_over : 0U));
}

} // namespace ao::gl
