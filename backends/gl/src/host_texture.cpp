#include "host_texture.hpp"

#include "state.hpp"

#include <string>

namespace ao::gl {

namespace {

bool fits(GLenum internal, pixel_format format)
{
    return internal == internal_format(format) || (format == pixel_format::d24 && internal == GL_DEPTH24_STENCIL8) ||
           (format == pixel_format::d32f && internal == GL_DEPTH32F_STENCIL8);
}

GLint parameter(const functions& gl, GLuint texture, GLenum what)
{
    GLint value = 0;
    gl.GetTextureParameteriv(texture, what, &value);
    return value;
}

GLint level_parameter(const functions& gl, GLuint texture, GLenum what)
{
    GLint value = 0;
    gl.GetTextureLevelParameteriv(texture, 0, what, &value);
    return value;
}

std::string hexadecimal(GLenum value)
{
    std::string digits;
    for (int shift = 12; shift >= 0; shift -= 4) {
        digits += "0123456789abcdef"[(value >> static_cast<unsigned>(shift)) & 15U];
    }
    return "0x" + digits;
}

// Whether a fetch returns the texels as they are stored.
bool reads_plainly(const functions& gl, GLuint texture, pixel_format format)
{
    const bool depth = format == pixel_format::d24 || format == pixel_format::d32f;
    return parameter(gl, texture, GL_TEXTURE_SWIZZLE_R) == GL_RED && parameter(gl, texture, GL_TEXTURE_SWIZZLE_G) == GL_GREEN &&
           parameter(gl, texture, GL_TEXTURE_SWIZZLE_B) == GL_BLUE && parameter(gl, texture, GL_TEXTURE_BASE_LEVEL) == 0 &&
           (!depth || parameter(gl, texture, GL_DEPTH_STENCIL_TEXTURE_MODE) == GL_DEPTH_COMPONENT);
}

} // namespace

std::optional<error> check_texture(const functions& gl, GLuint texture, const char* role, pixel_format format, int width,
                                   int height)
{
    const std::string what = std::string(role) + " texture " + std::to_string(texture);
    if (texture == 0 || gl.IsTexture(texture) == GL_FALSE) {
        return error(errc::device, what + " is not a texture of the current context");
    }
    if (parameter(gl, texture, GL_TEXTURE_TARGET) != GL_TEXTURE_2D) {
        return error(errc::unsupported_format, what + " is not GL_TEXTURE_2D");
    }
    const auto internal = static_cast<GLenum>(level_parameter(gl, texture, GL_TEXTURE_INTERNAL_FORMAT));
    if (!fits(internal, format)) {
        return error(errc::unsupported_format, what + " has internal format " + hexadecimal(internal) + ", the plan has " +
                                                   hexadecimal(internal_format(format)));
    }
    const GLint across = level_parameter(gl, texture, GL_TEXTURE_WIDTH);
    const GLint down = level_parameter(gl, texture, GL_TEXTURE_HEIGHT);
    if (across != width || down != height) {
        return error(errc::invalid_size, what + " is " + std::to_string(across) + "x" + std::to_string(down) + ", the plan is " +
                                             std::to_string(width) + "x" + std::to_string(height));
    }
    return std::nullopt;
}

result<GLuint> make_readable(const functions& gl, GLuint texture, const char* role, pixel_format format, object& view)
{
    if (parameter(gl, texture, GL_TEXTURE_IMMUTABLE_FORMAT) == GL_FALSE) {
        if (!reads_plainly(gl, texture, format)) {
            return error(errc::unsupported_format, std::string(role) + " texture " + std::to_string(texture) +
                                                       " has a swizzle, a base level or stencil mode; immutable textures may");
        }
        return texture;
    }
    GLuint name = 0;
    gl.GenTextures(1, &name);
    const auto internal = static_cast<GLenum>(level_parameter(gl, texture, GL_TEXTURE_INTERNAL_FORMAT));
    gl.TextureView(name, GL_TEXTURE_2D, texture, internal, 0, 1, 0, 1);
    view = object(gl, object_type::texture, name);
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("making a view of a texture", code);
    }
    return name;
}

} // namespace ao::gl
