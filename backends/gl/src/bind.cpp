#include "ao/gl/backend.hpp"
#include "host_texture.hpp"
#include "state.hpp"

#include <utility>

namespace ao::gl {

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
        if (const auto wrong = check_texture(gl, texture, role, format, f.width, f.height)) {
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
    if (const auto wrong = check_texture(gl, images.visibility, "visibility", f.output_format, f.width, f.height)) {
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
