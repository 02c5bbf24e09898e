#include "host/runner_gl_evaluate.hpp"

#include "ao_runner_shaders.hpp"

#include <GL/glcorearb.h>

#include <array>
#include <cstddef>
#include <string>

namespace ao::host {

namespace {

template <class Function>
Function load(gl_loader loader, const char* name)
{
    return reinterpret_cast<Function>(loader(name));
}

// Deletes what the evaluation made, on every way out.
struct objects {
    gl_loader loader;
    GLuint program = 0;
    std::array<GLuint, 4> buffers{};

    explicit objects(gl_loader l) : loader(l) {}
    objects(const objects&) = delete;
    objects& operator=(const objects&) = delete;
    ~objects()
    {
        load<PFNGLUSEPROGRAMPROC>(loader, "glUseProgram")(0);
        load<PFNGLDELETEPROGRAMPROC>(loader, "glDeleteProgram")(program);
        load<PFNGLDELETEBUFFERSPROC>(loader, "glDeleteBuffers")(static_cast<GLsizei>(buffers.size()), buffers.data());
    }
};

error driver_error(const std::array<char, 200>& log)
{
    const std::string text(log.data());
    return error(errc::shader, "evaluate: " + text.substr(0, text.find('\n')));
}

ao::result<success> link(gl_loader loader, gl::shader_source source, GLuint program)
{
    const GLuint shader = load<PFNGLCREATESHADERPROC>(loader, "glCreateShader")(GL_COMPUTE_SHADER);
    if (source == gl::shader_source::text) {
        const char* text = shaders_gl::runner_evaluate_comp_text.data();
        const auto length = static_cast<GLint>(shaders_gl::runner_evaluate_comp_text.size());
        load<PFNGLSHADERSOURCEPROC>(loader, "glShaderSource")(shader, 1, &text, &length);
        load<PFNGLCOMPILESHADERPROC>(loader, "glCompileShader")(shader);
    }
    else {
        const std::span<const std::uint32_t> words = shaders_gl::runner_evaluate_comp;
        load<PFNGLSHADERBINARYPROC>(loader, "glShaderBinary")(1, &shader, GL_SHADER_BINARY_FORMAT_SPIR_V, words.data(),
                                                              static_cast<GLsizei>(words.size_bytes()));
        load<PFNGLSPECIALIZESHADERPROC>(loader, "glSpecializeShader")(shader, "main", 0, nullptr, nullptr);
    }
    load<PFNGLATTACHSHADERPROC>(loader, "glAttachShader")(program, shader);
    load<PFNGLDELETESHADERPROC>(loader, "glDeleteShader")(shader); // once the program goes
    std::array<char, 200> log{};
    GLint compiled = GL_FALSE;
    load<PFNGLGETSHADERIVPROC>(loader, "glGetShaderiv")(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        load<PFNGLGETSHADERINFOLOGPROC>(loader, "glGetShaderInfoLog")(shader, static_cast<GLsizei>(log.size()), nullptr,
                                                                      log.data());
        return driver_error(log);
    }
    load<PFNGLLINKPROGRAMPROC>(loader, "glLinkProgram")(program);
    GLint linked = GL_FALSE;
    load<PFNGLGETPROGRAMIVPROC>(loader, "glGetProgramiv")(program, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        load<PFNGLGETPROGRAMINFOLOGPROC>(loader, "glGetProgramInfoLog")(program, static_cast<GLsizei>(log.size()), nullptr,
                                                                        log.data());
        return driver_error(log);
    }
    return success{};
}

} // namespace

ao::result<success> evaluate_gl(gl_loader loader, gl::shader_source source, int function, std::span<const glm::vec4> a,
                                std::span<const glm::vec4> b, std::span<glm::vec4> out)
{
    objects made(loader);
    made.program = load<PFNGLCREATEPROGRAMPROC>(loader, "glCreateProgram")();
    if (const auto linked = link(loader, source, made.program); !linked) {
        return linked.error();
    }
    const auto count = static_cast<int>(a.size());
    const std::array<int, 4> call{ function, count, 0, 0 };
    const auto size = static_cast<GLsizeiptr>(a.size_bytes());
    load<PFNGLCREATEBUFFERSPROC>(loader, "glCreateBuffers")(4, made.buffers.data());
    const auto fill = load<PFNGLNAMEDBUFFERSTORAGEPROC>(loader, "glNamedBufferStorage");
    fill(made.buffers[0], sizeof call, call.data(), 0);
    fill(made.buffers[1], size, a.data(), 0);
    fill(made.buffers[2], size, b.data(), 0);
    fill(made.buffers[3], size, out.data(), 0);
    for (GLuint i = 0; i < made.buffers.size(); ++i) {
        load<PFNGLBINDBUFFERBASEPROC>(loader, "glBindBufferBase")(GL_SHADER_STORAGE_BUFFER, i, made.buffers[i]);
    }
    load<PFNGLUSEPROGRAMPROC>(loader, "glUseProgram")(made.program);
    load<PFNGLDISPATCHCOMPUTEPROC>(loader, "glDispatchCompute")(static_cast<GLuint>((count + 63) / 64), 1, 1);
    load<PFNGLMEMORYBARRIERPROC>(loader, "glMemoryBarrier")(GL_BUFFER_UPDATE_BARRIER_BIT);
    load<PFNGLGETNAMEDBUFFERSUBDATAPROC>(loader, "glGetNamedBufferSubData")(made.buffers[3], 0, size, out.data());
    if (const GLenum code = load<PFNGLGETERRORPROC>(loader, "glGetError")(); code != GL_NO_ERROR) {
        return error(errc::device, "evaluate: GL error", static_cast<int>(code));
    }
    return success{};
}

} // namespace ao::host
