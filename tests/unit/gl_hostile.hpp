// A host whose OpenGL state would spoil every pass, and all of that state as text.
#pragma once

#include "unit/gl_pictures.hpp"

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES 1
#endif
#include <GL/glcorearb.h>

#include <array>
#include <cstddef>
#include <string>

namespace gl_test {

// Entry points by the host's loader, as the backend finds them.
template <class F>
F* entry(const char* name)
{
    return reinterpret_cast<F*>(context().loader()(name));
}
#define AO_ENTRY(name) const auto name = entry<decltype(gl##name)>("gl" #name)

// Everything that the backend could have touched and can be asked for, as text.
inline std::string snapshot()
{
    AO_ENTRY(GetIntegerv);
    AO_ENTRY(GetIntegeri_v);
    AO_ENTRY(GetInteger64i_v);
    AO_ENTRY(GetFloati_v);
    AO_ENTRY(GetDoublei_v);
    AO_ENTRY(IsEnabled);
    AO_ENTRY(IsEnabledi);
    AO_ENTRY(GetBooleani_v);
    AO_ENTRY(ActiveTexture);
    std::string s;
    const auto add = [&](auto value) { s += std::to_string(value) + " "; };
    const auto add_integers = [&](GLenum what) {
        std::array<GLint, 16> v{};
        GetIntegerv(what, v.data());
        for (std::size_t i = 0; i < 4; ++i) {
            add(v[i]);
        }
        s += "| ";
    };
    for (const GLenum what : { GL_CURRENT_PROGRAM,
                               GL_ACTIVE_TEXTURE,
                               GL_UNIFORM_BUFFER_BINDING,
                               GL_VERTEX_ARRAY_BINDING,
                               GL_DRAW_FRAMEBUFFER_BINDING,
                               GL_READ_FRAMEBUFFER_BINDING,
                               GL_VIEWPORT,
                               GL_POLYGON_MODE,
                               GL_PIXEL_UNPACK_BUFFER_BINDING,
                               GL_UNPACK_ALIGNMENT,
                               GL_UNPACK_ROW_LENGTH,
                               GL_UNPACK_SKIP_PIXELS,
                               GL_UNPACK_SWAP_BYTES,
                               GL_SCISSOR_BOX,
                               GL_RENDERBUFFER_BINDING,
                               GL_SHADER_STORAGE_BUFFER_BINDING,
                               GL_ARRAY_BUFFER_BINDING,
                               GL_DRAW_INDIRECT_BUFFER_BINDING,
                               GL_DISPATCH_INDIRECT_BUFFER_BINDING,
                               GL_DEPTH_WRITEMASK,
                               GL_DEPTH_FUNC,
                               GL_CULL_FACE_MODE,
                               GL_FRONT_FACE,
                               GL_CLIP_ORIGIN,
                               GL_CLIP_DEPTH_MODE }) {
        add_integers(what);
    }
    GLint active = 0;
    GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLenum unit = 0; unit < 8; ++unit) {
        ActiveTexture(GL_TEXTURE0 + unit);
        for (const GLenum what : { GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_CUBE_MAP, GL_TEXTURE_BINDING_3D,
                                   GL_TEXTURE_BINDING_BUFFER, GL_SAMPLER_BINDING }) {
            add_integers(what);
        }
    }
    ActiveTexture(static_cast<GLenum>(active));
    for (GLuint i = 0; i < 5; ++i) {
        for (const GLenum what :
             { GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER,
               GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT, GL_UNIFORM_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_BINDING }) {
            GLint value = 0;
            GetIntegeri_v(what, i, &value);
            add(value);
        }
        for (const GLenum what :
             { GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE }) {
            GLint64 value = 0;
            GetInteger64i_v(what, i, &value);
            add(value);
        }
        std::array<GLfloat, 4> viewport{};
        GetFloati_v(GL_VIEWPORT, i, viewport.data());
        std::array<GLdouble, 2> range{};
        GetDoublei_v(GL_DEPTH_RANGE, i, range.data());
        add(viewport[0]);
        add(viewport[2]);
        add(range[0]);
        add(range[1]);
    }
    for (GLuint i = 0; i < 8; ++i) {
        std::array<GLboolean, 4> mask{};
        GetBooleani_v(GL_COLOR_WRITEMASK, i, mask.data());
        for (const GLboolean on : mask) {
            add(static_cast<int>(on));
        }
        add(static_cast<int>(IsEnabledi(GL_BLEND, i)));
        add(static_cast<int>(IsEnabledi(GL_SCISSOR_TEST, i)));
        add(static_cast<int>(IsEnabled(GL_CLIP_DISTANCE0 + i)));
    }
    for (const GLenum what :
         { GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_DITHER, GL_COLOR_LOGIC_OP, GL_RASTERIZER_DISCARD, GL_MULTISAMPLE,
           GL_PRIMITIVE_RESTART, GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_DEPTH_CLAMP, GL_POLYGON_OFFSET_FILL, GL_POLYGON_SMOOTH }) {
        add(static_cast<int>(IsEnabled(what)));
    }
    return s;
}

inline GLenum take_error()
{
    return entry<decltype(glGetError)>("glGetError")();
}

// State that would spoil every pass if it stayed in force.
class hostile_state {
public:
    hostile_state()
    {
        AO_ENTRY(Enable);
        AO_ENTRY(BindTextureUnit);
        AO_ENTRY(BindSampler);
        AO_ENTRY(CreateSamplers);
        AO_ENTRY(CreateTextures);
        AO_ENTRY(TextureStorage2D);
        AO_ENTRY(CreateBuffers);
        AO_ENTRY(NamedBufferData);
        AO_ENTRY(CreateVertexArrays);
        AO_ENTRY(CreateFramebuffers);
        AO_ENTRY(NamedFramebufferTexture);
        CreateSamplers(1, &sampler_);
        CreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube_);
        CreateTextures(GL_TEXTURE_3D, 1, &volume_);
        CreateTextures(GL_TEXTURE_BUFFER, 1, &texels_);
        CreateTextures(GL_TEXTURE_2D, 1, &flat_);
        TextureStorage2D(flat_, 1, GL_RGBA8, 8, 8);
        CreateBuffers(1, &buffer_);
        NamedBufferData(buffer_, 4096, nullptr, GL_STATIC_DRAW);
        CreateVertexArrays(1, &vertex_array_);
        CreateFramebuffers(1, &framebuffer_);
        NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, flat_, 0);
        for (const GLenum what : capabilities) {
            Enable(what);
        }
        entry<decltype(glStencilFunc)>("glStencilFunc")(GL_NEVER, 0, 255);
        entry<decltype(glLogicOp)>("glLogicOp")(GL_CLEAR);
        entry<decltype(glBlendFunc)>("glBlendFunc")(GL_ZERO, GL_ZERO);
        entry<decltype(glPolygonMode)>("glPolygonMode")(GL_FRONT_AND_BACK, GL_POINT);
        entry<decltype(glPolygonOffset)>("glPolygonOffset")(10, 1000);
        entry<decltype(glPrimitiveRestartIndex)>("glPrimitiveRestartIndex")(1);
        entry<decltype(glColorMask)>("glColorMask")(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
        entry<decltype(glViewport)>("glViewport")(3, 4, 5, 6);
        entry<decltype(glScissor)>("glScissor")(1, 1, 2, 2);
        entry<decltype(glViewportIndexedf)>("glViewportIndexedf")(1, 7, 7, 7, 7);
        entry<decltype(glClipControl)>("glClipControl")(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        entry<decltype(glDepthRange)>("glDepthRange")(0.5, 0.25);
        entry<decltype(glDepthFunc)>("glDepthFunc")(GL_NEVER);
        entry<decltype(glDepthMask)>("glDepthMask")(GL_FALSE);
        entry<decltype(glCullFace)>("glCullFace")(GL_FRONT_AND_BACK);
        entry<decltype(glFrontFace)>("glFrontFace")(GL_CW);
        for (GLuint unit = 0; unit < 7; ++unit) {
            BindTextureUnit(unit, cube_);
            BindTextureUnit(unit, volume_);
            BindTextureUnit(unit, texels_);
            BindTextureUnit(unit, flat_);
            BindSampler(unit, sampler_);
        }
        entry<decltype(glActiveTexture)>("glActiveTexture")(GL_TEXTURE0 + 4);
        AO_ENTRY(BindImageTexture);
        AO_ENTRY(BindBufferRange);
        AO_ENTRY(BindBufferBase);
        AO_ENTRY(BindBuffer);
        BindImageTexture(0, flat_, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
        BindImageTexture(1, flat_, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
        BindBufferRange(GL_UNIFORM_BUFFER, 0, buffer_, 256, 512);
        BindBufferBase(GL_UNIFORM_BUFFER, 1, buffer_);
        BindBuffer(GL_UNIFORM_BUFFER, 0);
        for (GLuint i = 0; i < 4; ++i) {
            BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer_, 256 * i, 256);
        }
        BindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
        BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer_);
        BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer_);
        entry<decltype(glBindVertexArray)>("glBindVertexArray")(vertex_array_);
        entry<decltype(glBindFramebuffer)>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer_);
        set_unpack();
        REQUIRE(take_error() == GL_NO_ERROR);
    }
    hostile_state(const hostile_state&) = delete;
    hostile_state& operator=(const hostile_state&) = delete;
    ~hostile_state()
    {
        // A program that was deleted stays current until another one is used, and cannot be put back.
        entry<decltype(glUseProgram)>("glUseProgram")(0);
        // The other tests share the context.
        AO_ENTRY(Disable);
        for (const GLenum what : capabilities) {
            Disable(what);
        }
        entry<decltype(glPolygonMode)>("glPolygonMode")(GL_FRONT_AND_BACK, GL_FILL);
        entry<decltype(glColorMask)>("glColorMask")(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        entry<decltype(glClipControl)>("glClipControl")(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        entry<decltype(glDepthRange)>("glDepthRange")(0, 1);
        entry<decltype(glPixelStorei)>("glPixelStorei")(GL_UNPACK_SWAP_BYTES, GL_FALSE);
        entry<decltype(glBindBuffer)>("glBindBuffer")(GL_PIXEL_UNPACK_BUFFER, 0);
        entry<decltype(glDeleteSamplers)>("glDeleteSamplers")(1, &sampler_);
        for (const GLuint texture : { cube_, volume_, texels_, flat_ }) {
            entry<decltype(glDeleteTextures)>("glDeleteTextures")(1, &texture);
        }
        entry<decltype(glDeleteBuffers)>("glDeleteBuffers")(1, &buffer_);
        entry<decltype(glDeleteVertexArrays)>("glDeleteVertexArrays")(1, &vertex_array_);
        entry<decltype(glDeleteFramebuffers)>("glDeleteFramebuffers")(1, &framebuffer_);
    }
    // Again after a read-back of the test, which resets it.
    void set_unpack() const
    {
        AO_ENTRY(PixelStorei);
        PixelStorei(GL_UNPACK_ALIGNMENT, 8);
        PixelStorei(GL_UNPACK_ROW_LENGTH, 77);
        PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
        PixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
        entry<decltype(glBindBuffer)>("glBindBuffer")(GL_PIXEL_UNPACK_BUFFER, buffer_);
    }

private:
    static constexpr std::array<GLenum, 13> capabilities{
        GL_BLEND,          GL_SCISSOR_TEST,   GL_DEPTH_TEST,         GL_STENCIL_TEST,
        GL_CULL_FACE,      GL_COLOR_LOGIC_OP, GL_RASTERIZER_DISCARD, GL_CLIP_DISTANCE0,
        GL_CLIP_DISTANCE3, GL_DEPTH_CLAMP,    GL_PRIMITIVE_RESTART,  GL_POLYGON_OFFSET_FILL,
        GL_POLYGON_SMOOTH,
    };
    GLuint sampler_ = 0;
    GLuint cube_ = 0;
    GLuint volume_ = 0;
    GLuint texels_ = 0;
    GLuint flat_ = 0;
    GLuint buffer_ = 0;
    GLuint vertex_array_ = 0;
    GLuint framebuffer_ = 0;
};

} // namespace gl_test
