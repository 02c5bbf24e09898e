#include "functions.hpp"

#include "ao/gl/backend.hpp"

#include <string>
#include <string_view>

namespace ao::gl {

namespace {

// What a context must answer before it can be asked for the rest.
std::optional<error> check_version(const functions& gl)
{
    if (gl.GetString == nullptr || gl.GetIntegerv == nullptr || gl.GetStringi == nullptr) {
        return error(errc::device, "the loader finds no OpenGL entry points");
    }
    const GLubyte* version = gl.GetString(GL_VERSION);
    if (version == nullptr) {
        return error(errc::device, "no OpenGL context is current");
    }
    const GLint number = gl.integer(GL_MAJOR_VERSION) * 10 + gl.integer(GL_MINOR_VERSION);
    if (number < 45) {
        return error(errc::device,
                     "OpenGL 4.5 is needed, the context has " + std::string(reinterpret_cast<const char*>(version)));
    }
    return std::nullopt;
}

bool offers_spirv(const functions& gl)
{
    if (gl.integer(GL_MAJOR_VERSION) * 10 + gl.integer(GL_MINOR_VERSION) >= 46) {
        return true;
    }
    const GLint count = gl.integer(GL_NUM_EXTENSIONS);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (name != nullptr && std::string_view(reinterpret_cast<const char*>(name)) == "GL_ARB_gl_spirv") {
            return true;
        }
    }
    return false;
}

} // namespace

template <class Loader>
std::optional<error> load(functions& into, Loader loader)
{
    if (loader == nullptr) {
        return error(errc::device, "no loader for OpenGL entry points");
    }
    const char* missing = nullptr;
    const auto find = [&]<class F>(F& function, const char* name) {
        function = reinterpret_cast<F>(loader(name));
        if (function == nullptr && missing == nullptr) {
            missing = name;
        }
    };
#define AO_GL_LOAD(name) find(into.name, "gl" #name);
    AO_GL_FUNCTIONS(AO_GL_LOAD)
#undef AO_GL_LOAD
    if (const auto wrong = check_version(into)) {
        return wrong;
    }
    if (missing != nullptr) {
        return error(errc::device, "OpenGL entry point " + std::string(missing) + " is missing");
    }
    if (offers_spirv(into)) {
        find(into.SpecializeShader, "glSpecializeShader");
        if (into.SpecializeShader == nullptr) {
            find(into.SpecializeShader, "glSpecializeShaderARB");
        }
    }
    return std::nullopt;
}

template std::optional<error> load(functions&, backend::get_proc_address);
template std::optional<error> load(functions&, backend::get_proc_address_as_data);

error gl_error(const char* what, GLenum code)
{
    if (code == GL_OUT_OF_MEMORY) {
        return error(errc::out_of_memory, std::string(what) + ": out of memory", static_cast<int>(code));
    }
    return error(errc::device, std::string(what) + " failed with OpenGL error " + std::to_string(code), static_cast<int>(code));
}

} // namespace ao::gl
