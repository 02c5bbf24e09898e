// The entry points of OpenGL that the backend calls, found through the host's loader. Named as GL names them.
#pragma once

#include "ao/result.hpp"

// For the types of the functions only; nothing is linked.
#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES 1
#endif
#include <GL/glcorearb.h>

#include <optional>

#define AO_GL_FUNCTIONS(X)                                                                                                       \
    X(ActiveTexture)                                                                                                             \
    X(AttachShader)                                                                                                              \
    X(BindBuffer)                                                                                                                \
    X(BindBufferBase)                                                                                                            \
    X(BindBufferRange)                                                                                                           \
    X(BindFramebuffer)                                                                                                           \
    X(BindImageTexture)                                                                                                          \
    X(BindSamplers)                                                                                                              \
    X(BindTexture)                                                                                                               \
    X(BindTextures)                                                                                                              \
    X(BindVertexArray)                                                                                                           \
    X(CheckNamedFramebufferStatus)                                                                                               \
    X(ClearNamedBufferData)                                                                                                      \
    X(ClearNamedFramebufferfv)                                                                                                   \
    X(ClearNamedFramebufferuiv)                                                                                                  \
    X(ClipControl)                                                                                                               \
    X(ColorMaski)                                                                                                                \
    X(CompileShader)                                                                                                             \
    X(CreateBuffers)                                                                                                             \
    X(CreateFramebuffers)                                                                                                        \
    X(CreateProgram)                                                                                                             \
    X(CreateSamplers)                                                                                                            \
    X(CreateShader)                                                                                                              \
    X(CreateTextures)                                                                                                            \
    X(CreateVertexArrays)                                                                                                        \
    X(CullFace)                                                                                                                  \
    X(DeleteBuffers)                                                                                                             \
    X(DeleteFramebuffers)                                                                                                        \
    X(DeleteProgram)                                                                                                             \
    X(DeleteSamplers)                                                                                                            \
    X(DeleteShader)                                                                                                              \
    X(DeleteTextures)                                                                                                            \
    X(DeleteVertexArrays)                                                                                                        \
    X(DepthFunc)                                                                                                                 \
    X(DepthMask)                                                                                                                 \
    X(DepthRangeIndexed)                                                                                                         \
    X(DetachShader)                                                                                                              \
    X(Disable)                                                                                                                   \
    X(Disablei)                                                                                                                  \
    X(DispatchCompute)                                                                                                           \
    X(DispatchComputeIndirect)                                                                                                   \
    X(DrawArrays)                                                                                                                \
    X(Enable)                                                                                                                    \
    X(EnableVertexArrayAttrib)                                                                                                   \
    X(Enablei)                                                                                                                   \
    X(FrontFace)                                                                                                                 \
    X(GenTextures)                                                                                                               \
    X(GetBooleani_v)                                                                                                             \
    X(GetBooleanv)                                                                                                               \
    X(GetDoublei_v)                                                                                                              \
    X(GetError)                                                                                                                  \
    X(GetFloati_v)                                                                                                               \
    X(GetInteger64i_v)                                                                                                           \
    X(GetIntegeri_v)                                                                                                             \
    X(GetIntegerv)                                                                                                               \
    X(GetNamedBufferSubData)                                                                                                     \
    X(GetProgramInfoLog)                                                                                                         \
    X(GetProgramiv)                                                                                                              \
    X(GetShaderInfoLog)                                                                                                          \
    X(GetShaderiv)                                                                                                               \
    X(GetString)                                                                                                                 \
    X(GetStringi)                                                                                                                \
    X(GetTextureLevelParameteriv)                                                                                                \
    X(GetTextureParameteriv)                                                                                                     \
    X(IsEnabled)                                                                                                                 \
    X(IsEnabledi)                                                                                                                \
    X(IsTexture)                                                                                                                 \
    X(LinkProgram)                                                                                                               \
    X(MemoryBarrier)                                                                                                             \
    X(MultiDrawElementsIndirect)                                                                                                 \
    X(NamedBufferStorage)                                                                                                        \
    X(NamedBufferSubData)                                                                                                        \
    X(NamedFramebufferDrawBuffers)                                                                                               \
    X(NamedFramebufferTexture)                                                                                                   \
    X(PixelStorei)                                                                                                               \
    X(PolygonMode)                                                                                                               \
    X(SamplerParameteri)                                                                                                         \
    X(ShaderBinary)                                                                                                              \
    X(ShaderSource)                                                                                                              \
    X(TextureBuffer)                                                                                                             \
    X(TextureParameteri)                                                                                                         \
    X(TextureStorage2D)                                                                                                          \
    X(TextureStorage3D)                                                                                                          \
    X(TextureSubImage2D)                                                                                                         \
    X(TextureView)                                                                                                               \
    X(UseProgram)                                                                                                                \
    X(VertexArrayAttribBinding)                                                                                                  \
    X(VertexArrayAttribFormat)                                                                                                   \
    X(VertexArrayAttribIFormat)                                                                                                  \
    X(VertexArrayBindingDivisor)                                                                                                 \
    X(VertexArrayElementBuffer)                                                                                                  \
    X(VertexArrayVertexBuffer)                                                                                                   \
    X(ViewportIndexedfv)

namespace ao::gl {

struct functions {
#define AO_GL_DECLARE(name) decltype(&::gl##name) name = nullptr;
    AO_GL_FUNCTIONS(AO_GL_DECLARE)
#undef AO_GL_DECLARE
    // Core from 4.6 on, of ARB_gl_spirv before; null where the driver has no SPIR-V.
    decltype(&::glSpecializeShader) SpecializeShader = nullptr;

    GLint integer(GLenum what) const
    {
        GLint value = 0;
        GetIntegerv(what, &value);
        return value;
    }

    // GL_NO_ERROR, or the first error since the last call. A lost context reports for ever, hence the bound.
    GLenum take_error() const
    {
        const GLenum first = GetError();
        for (int i = 0; i < 16 && GetError() != GL_NO_ERROR; ++i) {}
        return first;
    }
};

// `loader` returns a pointer to a function, as one or as void*.
template <class Loader>
std::optional<error> load(functions& into, Loader loader);

// errc::device or errc::out_of_memory with `what` as the reason.
error gl_error(const char* what, GLenum code);

} // namespace ao::gl
