#include "saved_state.hpp"

#include <cassert>

namespace ao::gl {

saved_state::saved_state(const functions& gl, const touched& what) : gl_(gl), what_(what)
{
    assert(what.textures <= most_textures && what.uniform_buffers <= most_uniform_buffers &&
           what.storage_buffers <= most_storage_buffers && what.images <= most_images &&
           what.color_targets <= most_color_targets);
    const auto name = [&](GLenum which) { return static_cast<GLuint>(gl.integer(which)); };
    program_ = name(GL_CURRENT_PROGRAM);
    active_texture_ = name(GL_ACTIVE_TEXTURE);
    for (GLuint unit = 0; unit < what.textures; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + unit);
        textures_[unit] = name(GL_TEXTURE_BINDING_2D);
        samplers_[unit] = name(GL_SAMPLER_BINDING);
        buffer_textures_[unit] = what.buffer_textures ? name(GL_TEXTURE_BINDING_BUFFER) : 0;
    }
    gl.ActiveTexture(active_texture_);
    uniform_buffer_ = name(GL_UNIFORM_BUFFER_BINDING);
    save_buffers(GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, what.uniform_buffers,
                 uniform_buffers_.data());
    storage_buffer_ = name(GL_SHADER_STORAGE_BUFFER_BINDING);
    save_buffers(GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE,
                 what.storage_buffers, storage_buffers_.data());
    dispatch_buffer_ = what.dispatch ? name(GL_DISPATCH_INDIRECT_BUFFER_BINDING) : 0;
    for (GLuint unit = 0; unit < what.images; ++unit) {
        image_units_[unit] = save_image_unit(unit);
    }
    if (what.color_targets != 0) {
        save_raster();
    }
    if (what.depth) {
        save_depth();
    }
}

void saved_state::save_buffers(GLenum binding, GLenum start, GLenum size, GLuint count, buffer_range* into) const
{
    for (GLuint index = 0; index < count; ++index) {
        GLint buffer = 0;
        gl_.GetIntegeri_v(binding, index, &buffer);
        into[index].name = static_cast<GLuint>(buffer);
        gl_.GetInteger64i_v(start, index, &into[index].start);
        gl_.GetInteger64i_v(size, index, &into[index].size);
    }
}

saved_state::image_unit saved_state::save_image_unit(GLuint unit) const
{
    const auto get = [&](GLenum what) {
        GLint value = 0;
        gl_.GetIntegeri_v(what, unit, &value);
        return value;
    };
    return { static_cast<GLuint>(get(GL_IMAGE_BINDING_NAME)),
             get(GL_IMAGE_BINDING_LEVEL),
             static_cast<GLboolean>(get(GL_IMAGE_BINDING_LAYERED) != 0 ? GL_TRUE : GL_FALSE),
             get(GL_IMAGE_BINDING_LAYER),
             static_cast<GLenum>(get(GL_IMAGE_BINDING_ACCESS)),
             static_cast<GLenum>(get(GL_IMAGE_BINDING_FORMAT)) };
}

void saved_state::save_raster()
{
    raster_.vertex_array = static_cast<GLuint>(gl_.integer(GL_VERTEX_ARRAY_BINDING));
    raster_.framebuffer = static_cast<GLuint>(gl_.integer(GL_DRAW_FRAMEBUFFER_BINDING));
    gl_.GetFloati_v(GL_VIEWPORT, 0, raster_.viewport.data());
    // Some drivers answer for front and back.
    std::array<GLint, 2> polygon_mode{};
    gl_.GetIntegerv(GL_POLYGON_MODE, polygon_mode.data());
    raster_.polygon_mode = static_cast<GLenum>(polygon_mode[0]);
    for (std::size_t i = 0; i < switched_off.size(); ++i) {
        raster_.enabled[i] = gl_.IsEnabled(switched_off[i]);
    }
    for (GLuint i = 0; i < what_.color_targets; ++i) {
        gl_.GetBooleani_v(GL_COLOR_WRITEMASK, i, raster_.color_masks[i].data());
        raster_.blend[i] = gl_.IsEnabledi(GL_BLEND, i);
    }
    raster_.scissor = gl_.IsEnabledi(GL_SCISSOR_TEST, 0);
    raster_.depth_test = gl_.IsEnabled(GL_DEPTH_TEST);
    raster_.cull_face = gl_.IsEnabled(GL_CULL_FACE);
}

void saved_state::save_depth()
{
    const auto value = [&](GLenum what) { return static_cast<GLenum>(gl_.integer(what)); };
    gl_.GetBooleanv(GL_DEPTH_WRITEMASK, &depth_.mask);
    depth_.function = value(GL_DEPTH_FUNC);
    gl_.GetDoublei_v(GL_DEPTH_RANGE, 0, depth_.range.data());
    depth_.culled = value(GL_CULL_FACE_MODE);
    depth_.front = value(GL_FRONT_FACE);
    depth_.clip_origin = value(GL_CLIP_ORIGIN);
    depth_.clip_depth = value(GL_CLIP_DEPTH_MODE);
    depth_.indirect = value(GL_DRAW_INDIRECT_BUFFER_BINDING);
    for (std::size_t i = 0; i < switched_off_in_depth.size(); ++i) {
        depth_.enabled[i] = gl_.IsEnabled(switched_off_in_depth[i]);
    }
}

saved_state::~saved_state()
{
    gl_.UseProgram(program_);
    for (GLuint unit = 0; unit < what_.textures; ++unit) {
        // Not glBindTextures: its 0 would take away textures of other targets too.
        gl_.ActiveTexture(GL_TEXTURE0 + unit);
        gl_.BindTexture(GL_TEXTURE_2D, textures_[unit]);
        if (what_.buffer_textures) {
            gl_.BindTexture(GL_TEXTURE_BUFFER, buffer_textures_[unit]);
        }
    }
    gl_.ActiveTexture(active_texture_);
    if (what_.textures != 0) {
        gl_.BindSamplers(0, static_cast<GLsizei>(what_.textures), samplers_.data());
    }
    restore_buffers(GL_UNIFORM_BUFFER, what_.uniform_buffers, uniform_buffers_.data());
    gl_.BindBuffer(GL_UNIFORM_BUFFER, uniform_buffer_);
    if (what_.storage_buffers != 0) {
        restore_buffers(GL_SHADER_STORAGE_BUFFER, what_.storage_buffers, storage_buffers_.data());
        gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, storage_buffer_);
    }
    if (what_.dispatch) {
        gl_.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, dispatch_buffer_);
    }
    for (GLuint i = 0; i < what_.images; ++i) {
        const image_unit& unit = image_units_[i];
        gl_.BindImageTexture(i, unit.texture, unit.level, unit.layered, unit.layer, unit.access, unit.format);
    }
    if (what_.color_targets != 0) {
        restore_raster();
    }
    if (what_.depth) {
        restore_depth();
    }
}

void saved_state::restore_buffers(GLenum target, GLuint count, const buffer_range* from) const
{
    for (GLuint index = 0; index < count; ++index) {
        const buffer_range& range = from[index];
        if (range.name == 0 || range.size == 0) {
            gl_.BindBufferBase(target, index, range.name);
        }
        else {
            gl_.BindBufferRange(target, index, range.name, static_cast<GLintptr>(range.start),
                                static_cast<GLsizeiptr>(range.size));
        }
    }
}

void saved_state::restore_raster() const
{
    const auto enable = [&](GLenum capability, GLboolean on) {
        on != GL_FALSE ? gl_.Enable(capability) : gl_.Disable(capability);
    };
    gl_.BindVertexArray(raster_.vertex_array);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, raster_.framebuffer);
    gl_.ViewportIndexedfv(0, raster_.viewport.data());
    gl_.PolygonMode(GL_FRONT_AND_BACK, raster_.polygon_mode);
    for (std::size_t i = 0; i < switched_off.size(); ++i) {
        enable(switched_off[i], raster_.enabled[i]);
    }
    for (GLuint i = 0; i < what_.color_targets; ++i) {
        const auto& mask = raster_.color_masks[i];
        gl_.ColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
        if (raster_.blend[i] != GL_FALSE) {
            gl_.Enablei(GL_BLEND, i);
        }
    }
    if (raster_.scissor != GL_FALSE) {
        gl_.Enablei(GL_SCISSOR_TEST, 0);
    }
    enable(GL_DEPTH_TEST, raster_.depth_test);
    enable(GL_CULL_FACE, raster_.cull_face);
}

void saved_state::restore_depth() const
{
    gl_.DepthMask(depth_.mask);
    gl_.DepthFunc(depth_.function);
    gl_.DepthRangeIndexed(0, depth_.range[0], depth_.range[1]);
    gl_.CullFace(depth_.culled);
    gl_.FrontFace(depth_.front);
    gl_.ClipControl(depth_.clip_origin, depth_.clip_depth);
    gl_.BindBuffer(GL_DRAW_INDIRECT_BUFFER, depth_.indirect);
    for (std::size_t i = 0; i < switched_off_in_depth.size(); ++i) {
        if (depth_.enabled[i] != GL_FALSE) {
            gl_.Enable(switched_off_in_depth[i]);
        }
    }
}

} // namespace ao::gl
