#include "saved_state.hpp"

namespace ao::gl {

saved_state::saved_state(const functions& gl, route by) : gl_(gl), route_(by)
{
    const auto name = [&](GLenum what) { return static_cast<GLuint>(gl.integer(what)); };
    program_ = name(GL_CURRENT_PROGRAM);
    active_texture_ = name(GL_ACTIVE_TEXTURE);
    for (GLuint unit = 0; unit < max_inputs; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        textures_[unit] = name(GL_TEXTURE_BINDING_2D);
        samplers_[unit] = name(GL_SAMPLER_BINDING);
    }
    gl.ActiveTexture(active_texture_);
    uniform_buffer_ = name(GL_UNIFORM_BUFFER_BINDING);
    for (GLuint index = 0; index < uniform_buffers_.size(); ++index) {
        GLint buffer = 0;
        gl.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, index, &buffer);
        uniform_buffers_[index].name = static_cast<GLuint>(buffer);
        gl.GetInteger64i_v(GL_UNIFORM_BUFFER_START, index, &uniform_buffers_[index].start);
        gl.GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, index, &uniform_buffers_[index].size);
    }
    if (by == route::compute) {
        save_image_unit();
    }
    else {
        save_raster();
    }
}

void saved_state::save_image_unit()
{
    const auto get = [&](GLenum what) {
        GLint value = 0;
        gl_.GetIntegeri_v(what, 0, &value);
        return value;
    };
    image_unit_.texture = static_cast<GLuint>(get(GL_IMAGE_BINDING_NAME));
    image_unit_.level = get(GL_IMAGE_BINDING_LEVEL);
    image_unit_.layered = get(GL_IMAGE_BINDING_LAYERED) != 0 ? GL_TRUE : GL_FALSE;
    image_unit_.layer = get(GL_IMAGE_BINDING_LAYER);
    image_unit_.access = static_cast<GLenum>(get(GL_IMAGE_BINDING_ACCESS));
    image_unit_.format = static_cast<GLenum>(get(GL_IMAGE_BINDING_FORMAT));
}

void saved_state::save_raster()
{
    raster_.vertex_array = static_cast<GLuint>(gl_.integer(GL_VERTEX_ARRAY_BINDING));
    raster_.framebuffer = static_cast<GLuint>(gl_.integer(GL_DRAW_FRAMEBUFFER_BINDING));
    gl_.GetFloati_v(GL_VIEWPORT, 0, raster_.viewport.data());
    gl_.GetBooleani_v(GL_COLOR_WRITEMASK, 0, raster_.color_mask.data());
    // Some drivers answer for front and back.
    std::array<GLint, 2> polygon_mode{};
    gl_.GetIntegerv(GL_POLYGON_MODE, polygon_mode.data());
    raster_.polygon_mode = static_cast<GLenum>(polygon_mode[0]);
    for (std::size_t i = 0; i < switched_off.size(); ++i) {
        raster_.enabled[i] = gl_.IsEnabled(switched_off[i]);
    }
    for (std::size_t i = 0; i < switched_off_indexed.size(); ++i) {
        raster_.enabled_indexed[i] = gl_.IsEnabledi(switched_off_indexed[i], 0);
    }
}

saved_state::~saved_state()
{
    gl_.UseProgram(program_);
    for (GLuint unit = 0; unit < max_inputs; ++unit) {
        // Not glBindTextures: its 0 would take away textures of other targets too.
        gl_.ActiveTexture(GL_TEXTURE0 + unit);
        gl_.BindTexture(GL_TEXTURE_2D, textures_[unit]);
    }
    gl_.ActiveTexture(active_texture_);
    gl_.BindSamplers(0, max_inputs, samplers_.data());
    for (GLuint index = 0; index < uniform_buffers_.size(); ++index) {
        const buffer_range& range = uniform_buffers_[index];
        if (range.name == 0 || range.size == 0) {
            gl_.BindBufferBase(GL_UNIFORM_BUFFER, index, range.name);
        }
        else {
            gl_.BindBufferRange(GL_UNIFORM_BUFFER, index, range.name, static_cast<GLintptr>(range.start),
                                static_cast<GLsizeiptr>(range.size));
        }
    }
    gl_.BindBuffer(GL_UNIFORM_BUFFER, uniform_buffer_);
    if (route_ == route::compute) {
        gl_.BindImageTexture(0, image_unit_.texture, image_unit_.level, image_unit_.layered, image_unit_.layer,
                             image_unit_.access, image_unit_.format);
    }
    else {
        restore_raster();
    }
}

void saved_state::restore_raster() const
{
    gl_.BindVertexArray(raster_.vertex_array);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, raster_.framebuffer);
    gl_.ViewportIndexedfv(0, raster_.viewport.data());
    const auto& mask = raster_.color_mask;
    gl_.ColorMaski(0, mask[0], mask[1], mask[2], mask[3]);
    gl_.PolygonMode(GL_FRONT_AND_BACK, raster_.polygon_mode);
    for (std::size_t i = 0; i < switched_off.size(); ++i) {
        if (raster_.enabled[i] != GL_FALSE) {
            gl_.Enable(switched_off[i]);
        }
    }
    for (std::size_t i = 0; i < switched_off_indexed.size(); ++i) {
        if (raster_.enabled_indexed[i] != GL_FALSE) {
            gl_.Enablei(switched_off_indexed[i], 0);
        }
    }
}

} // namespace ao::gl
