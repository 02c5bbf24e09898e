#include "raster_textures.hpp"

#include "ao/texture.hpp"
#include "unpack_state.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace ao::gl {

namespace {

GLint wrapping(wrap_mode mode)
{
    return mode == wrap_mode::repeat ? GL_REPEAT : mode == wrap_mode::clamp ? GL_CLAMP_TO_EDGE : GL_MIRRORED_REPEAT;
}

// With the levels that the heap has.
object upload_texture(const functions& gl, const texture& t, const texel_heap& heap)
{
    using layout = ao::detail::heap_layout;
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
    object made(gl, object_type::texture, name);
    const std::uint32_t* descriptor = heap.words.data() + layout::ao_heap_table;
    const auto levels = static_cast<GLsizei>(descriptor[2]);
    gl.TextureStorage2D(name, levels, t.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, t.width, t.height);
    for (GLsizei level = 0; level < levels; ++level) {
        const std::uint32_t offset = descriptor[layout::ao_descriptor_levels + level];
        gl.TextureSubImage2D(name, level, 0, 0, std::max(t.width >> level, 1), std::max(t.height >> level, 1), GL_RGBA,
                             GL_UNSIGNED_INT_8_8_8_8_REV, heap.words.data() + offset);
    }
    gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TextureParameteri(name, GL_TEXTURE_WRAP_S, wrapping(t.wrap_u));
    gl.TextureParameteri(name, GL_TEXTURE_WRAP_T, wrapping(t.wrap_v));
    return made;
}

} // namespace

object upload_heap(buffer_maker& buffers, const map_places& maps)
{
    const result<texel_heap> heap = make_texel_heap(maps.textures);
    if (!heap) {
        buffers.fail(heap.error());
        return {};
    }
    return buffers.storage("the heap of textures", std::as_bytes(std::span(heap->words)), 0);
}

std::vector<object> upload_textures(buffer_maker& buffers, const functions& gl, const map_places& maps)
{
    const plain_unpack_state plain(gl);
    std::vector<object> made;
    const GLint limit = gl.integer(GL_MAX_TEXTURE_SIZE);
    for (const texture& t : maps.textures) {
        if (t.width > limit || t.height > limit) {
            buffers.fail(error(errc::invalid_size, "a texture of " + std::to_string(t.width) + "x" + std::to_string(t.height) +
                                                       ", the driver takes " + std::to_string(limit)));
            return made;
        }
        const result<texel_heap> heap = make_texel_heap({ &t, 1 });
        if (!heap) {
            buffers.fail(heap.error());
            return made;
        }
        made.push_back(upload_texture(gl, t, *heap));
        if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
            buffers.fail(gl_error("allocating a texture", code));
            return made;
        }
    }
    return made;
}

object upload_materials(buffer_maker& buffers, const scene& s, const map_places& maps)
{
    const std::vector<drawn_material> materials = make_drawn_materials(s, maps);
    return buffers.storage("the table of materials", std::as_bytes(std::span(materials)), 0);
}

} // namespace ao::gl
