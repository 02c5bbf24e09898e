#include "ao/gl/backend.hpp"
#include "state.hpp"

#include <array>
#include <string>
#include <utility>

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

std::optional<error> validate(const functions& gl, GLuint texture, const char* role, pixel_format format, const facts& f)
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
    const GLint width = level_parameter(gl, texture, GL_TEXTURE_WIDTH);
    const GLint height = level_parameter(gl, texture, GL_TEXTURE_HEIGHT);
    if (width != f.width || height != f.height) {
        return error(errc::invalid_size, what + " is " + std::to_string(width) + "x" + std::to_string(height) + ", the plan is " +
                                             std::to_string(f.width) + "x" + std::to_string(f.height));
    }
    return std::nullopt;
}

// Whether a fetch returns the texels as they are stored.
bool reads_plainly(const functions& gl, GLuint texture, pixel_format format)
{
    const bool depth = format == pixel_format::d24 || format == pixel_format::d32f;
    return parameter(gl, texture, GL_TEXTURE_SWIZZLE_R) == GL_RED && parameter(gl, texture, GL_TEXTURE_SWIZZLE_G) == GL_GREEN &&
           parameter(gl, texture, GL_TEXTURE_SWIZZLE_B) == GL_BLUE && parameter(gl, texture, GL_TEXTURE_BASE_LEVEL) == 0 &&
           (!depth || parameter(gl, texture, GL_DEPTH_STENCIL_TEXTURE_MODE) == GL_DEPTH_COMPONENT);
}

// A texture to read the host's one by: a view with parameters of its own where GL allows one, else the name itself.
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

} // namespace

result<binding> backend::bind(program& prepared, const plan& p, const host_images<image>& images)
{
    const functions& gl = *gl_;
    gl.take_error();
    const facts& f = p.facts;
    const program_state& from = *prepared.state_;
    if (from.passes.size() != p.passes.size() ||
        from.formats[index_of(image_id::visibility)] != internal_format(f.output_format)) {
        return error(errc::plan_mismatch, "the program was prepared for another plan");
    }

    auto state = std::make_unique<binding_state>();
    for (std::size_t i = 0; i < image_count; ++i) {
        state->images[i] = from.images[i].name();
    }
    const auto read = [&](GLuint texture, image_id id, const char* role, pixel_format format,
                          object& view) -> std::optional<error> {
        if (const auto wrong = validate(gl, texture, role, format, f)) {
            return wrong;
        }
        const result<GLuint> readable = make_readable(gl, texture, role, format, view);
        if (!readable) {
            return readable.error();
        }
        state->images[index_of(id)] = *readable;
        return std::nullopt;
    };
    if (const auto wrong = read(images.depth, image_id::depth, "depth", f.depth_format, state->depth_view)) {
        return *wrong;
    }
    if (f.normals != normal_source::from_depth) {
        if (const auto wrong = read(images.normal, image_id::normal, "normal", f.normal_format, state->normal_view)) {
            return *wrong;
        }
    }
    if (const auto wrong = validate(gl, images.visibility, "visibility", f.output_format, f)) {
        return *wrong;
    }
    state->images[index_of(image_id::visibility)] = images.visibility;
    if (options_.route == route::fragment) {
        result<object> framebuffer = make_framebuffer(gl, images.visibility);
        if (!framebuffer) {
            return framebuffer.error();
        }
        state->framebuffer = std::move(*framebuffer);
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("binding the textures", code);
    }
    return binding(std::move(state));
}

} // namespace ao::gl
