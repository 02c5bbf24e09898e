#include "host/gl_context.hpp"

#include <GL/glcorearb.h>

#include <algorithm>
#include <cctype>

namespace ao::host {
bool contains_ignoring_case(const std::string& text, const std::string& part)
{
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [&](char a, char b) { return lower(a) == lower(b); }) != text.end();
}

result<std::unique_ptr<gl_context>> gl_context::create(const gl_options& options)
{
    return options.platform == gl_platform::egl ? create_egl_context(options.device) : create_osmesa_context(options.device);
}

result<done> gl_context::describe()
{
    const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(loader()("glGetString"));
    const auto get_integer = reinterpret_cast<PFNGLGETINTEGERVPROC>(loader()("glGetIntegerv"));
    if (!get_string || !get_integer)
        return failure{ "no GL context: the loader finds no glGetString" };
    const auto text = [&](GLenum what) {
        const GLubyte* s = get_string(what);
        return s ? std::string(reinterpret_cast<const char*>(s)) : std::string();
    };
    vendor = text(GL_VENDOR);
    renderer = text(GL_RENDERER);
    version = text(GL_VERSION);
    GLint major = 0;
    GLint minor = 0;
    get_integer(GL_MAJOR_VERSION, &major);
    get_integer(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 45)
        return failure{ "no GL context: \"" + renderer + "\" offers OpenGL " + version + ", 4.5 is needed" };
    return done{};
}
}
