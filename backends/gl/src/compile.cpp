#include "compile.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace ao::gl {

namespace {

std::string first_line(std::string_view log)
{
    const std::size_t begin = log.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) {
        return "no message of the driver";
    }
    return std::string(log.substr(begin, log.find_first_of("\r\n", begin) - begin));
}

template <class GetParameter, class GetLog>
error shader_error(const char* name, GLuint object, GetParameter get_parameter, GetLog get_log)
{
    GLint length = 0;
    get_parameter(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
    GLsizei written = 0;
    get_log(object, static_cast<GLsizei>(log.size()), &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return error(errc::shader, std::string(name) + ": " + first_line(log));
}

void give_spirv(const functions& gl, GLuint shader, const source& from, std::span<const GLuint> values)
{
    std::vector<GLuint> specialised;
    for (const GLuint id : from.constant_ids) {
        specialised.push_back(values[id]);
    }
    gl.ShaderBinary(1, &shader, GL_SHADER_BINARY_FORMAT_SPIR_V, from.spirv.data(), static_cast<GLsizei>(from.spirv.size_bytes()));
    gl.SpecializeShader(shader, "main", static_cast<GLuint>(from.constant_ids.size()), from.constant_ids.data(),
                        specialised.data());
}

// Constants go behind the first line, which is #version. GLSL converts integers to booleans in the constructor that the
// flattened text wraps around each macro.
void give_text(const functions& gl, GLuint shader, const source& from, std::span<const GLuint> values)
{
    std::string defines;
    for (const GLuint id : from.constant_ids) {
        defines += "#define AO_SPEC_" + std::to_string(id) + " " + std::to_string(values[id]) + "\n";
    }
    const std::size_t version_end = from.text.find('\n') + 1;
    const std::array<const GLchar*, 3> parts{ from.text.data(), defines.data(), from.text.data() + version_end };
    const std::array<GLint, 3> lengths{ static_cast<GLint>(version_end), static_cast<GLint>(defines.size()),
                                        static_cast<GLint>(from.text.size() - version_end) };
    gl.ShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), lengths.data());
    gl.CompileShader(shader);
}

} // namespace

result<object> compile(const functions& gl, shader_source chosen, GLenum stage, const source& from,
                       std::span<const GLuint> values)
{
    object shader(gl, object_type::shader, gl.CreateShader(stage));
    if (chosen == shader_source::spirv) {
        give_spirv(gl, shader.name(), from, values);
    }
    else {
        give_text(gl, shader.name(), from, values);
    }
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        return shader_error(from.name, shader.name(), gl.GetShaderiv, gl.GetShaderInfoLog);
    }
    return shader;
}

result<object> link(const functions& gl, const char* name, std::span<const object> shaders)
{
    object program(gl, object_type::program, gl.CreateProgram());
    for (const object& each : shaders) {
        gl.AttachShader(program.name(), each.name());
    }
    gl.LinkProgram(program.name());
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        return shader_error(name, program.name(), gl.GetProgramiv, gl.GetProgramInfoLog);
    }
    for (const object& each : shaders) {
        gl.DetachShader(program.name(), each.name());
    }
    return program;
}

} // namespace ao::gl
