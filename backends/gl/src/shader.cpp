#include "shader.hpp"

#include "ao_gl_shaders.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ao::gl {

namespace {

// constant_id of the shaders and their values; a boolean is 0 or 1.
constexpr std::size_t pass_constant_count = 9;
constexpr std::size_t group_constant_count = 2; // compute only, behind those of the passes
using constant_values = std::array<GLuint, pass_constant_count + group_constant_count>;

struct source {
    std::span<const std::uint32_t> spirv;
    std::string_view text;
    std::span<const GLuint> constant_ids;
    const char* name;
};

constexpr std::array<GLuint, 4> linearize_ids{ 0, 8, 9, 10 };
constexpr std::array<GLuint, 8> occlusion_ids{ 1, 2, 3, 4, 5, 6, 9, 10 };
constexpr std::array<GLuint, 3> filter_ids{ 7, 9, 10 };

source source_of(pass_type type, route by)
{
    using namespace shaders;
    const bool compute = by == route::compute;
    const auto pick = [&](source s) {
        if (!compute) {
            s.constant_ids = s.constant_ids.first(s.constant_ids.size() - group_constant_count);
        }
        return s;
    };
    switch (type) {
    case pass_type::linearize:
        return pick({ compute ? linearize_comp : linearize_frag, compute ? linearize_comp_text : linearize_frag_text,
                      linearize_ids, "linearize" });
    case pass_type::occlusion:
        return pick({ compute ? occlusion_comp : occlusion_frag, compute ? occlusion_comp_text : occlusion_frag_text,
                      occlusion_ids, "occlusion" });
    case pass_type::filter_rows:
        return pick({ compute ? filter_rows_comp : filter_rows_frag, compute ? filter_rows_comp_text : filter_rows_frag_text,
                      filter_ids, "filter rows" });
    case pass_type::filter_columns:
        break;
    }
    return pick({ compute ? filter_columns_comp : filter_columns_frag,
                  compute ? filter_columns_comp_text : filter_columns_frag_text, filter_ids, "filter columns" });
}

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

void give_spirv(const functions& gl, GLuint shader, const source& from, const constant_values& values)
{
    std::array<GLuint, std::tuple_size_v<constant_values>> specialised{};
    for (std::size_t i = 0; i < from.constant_ids.size(); ++i) {
        specialised[i] = values[from.constant_ids[i]];
    }
    gl.ShaderBinary(1, &shader, GL_SHADER_BINARY_FORMAT_SPIR_V, from.spirv.data(), static_cast<GLsizei>(from.spirv.size_bytes()));
    gl.SpecializeShader(shader, "main", static_cast<GLuint>(from.constant_ids.size()), from.constant_ids.data(),
                        specialised.data());
}

// Constants go behind the first line, which is #version. GLSL converts integers to booleans in the constructor that the
// flattened text wraps around each macro.
void give_text(const functions& gl, GLuint shader, const source& from, const constant_values& values)
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

result<object> compile(const functions& gl, const options& chosen, GLenum stage, const source& from,
                       const constant_values& values)
{
    object shader(gl, object_type::shader, gl.CreateShader(stage));
    if (chosen.source == shader_source::spirv) {
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

} // namespace

result<object> link_pass(const functions& gl, const options& chosen, const pass& p, bool from_position)
{
    const pass_options& o = p.options;
    const constant_values values{ o.affine,
                                  static_cast<GLuint>(o.tap_count),
                                  static_cast<GLuint>(o.normal_source),
                                  o.rotate_normals,
                                  o.parallel,
                                  o.limit_thickness,
                                  o.mark_background,
                                  static_cast<GLuint>(o.filter_radius),
                                  from_position,
                                  chosen.group_width,
                                  chosen.group_height };
    const bool compute = chosen.route == route::compute;
    const source from = source_of(p.type, chosen.route);

    object program(gl, object_type::program, gl.CreateProgram());
    result<object> main = compile(gl, chosen, compute ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER, from, values);
    if (!main) {
        return main.error();
    }
    gl.AttachShader(program.name(), main->name());
    object vertex;
    if (!compute) {
        const source triangle{ shaders::full_screen_vert, shaders::full_screen_vert_text, {}, "full-screen triangle" };
        result<object> compiled = compile(gl, chosen, GL_VERTEX_SHADER, triangle, values);
        if (!compiled) {
            return compiled.error();
        }
        vertex = std::move(*compiled);
        gl.AttachShader(program.name(), vertex.name());
    }
    gl.LinkProgram(program.name());
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        return shader_error(from.name, program.name(), gl.GetProgramiv, gl.GetProgramInfoLog);
    }
    gl.DetachShader(program.name(), main->name());
    if (!compute) {
        gl.DetachShader(program.name(), vertex.name());
    }
    return program;
}

} // namespace ao::gl
