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

// The scene's textures that have a place, in that order.
std::vector<texture> placed(const scene& s, const std::vector<int>& places)
{
    std::vector<texture> read;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] != no_texture) {
            read.push_back(s.textures[i]);
        }
    }
    return read;
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

std::vector<int> read_textures(const scene& s, const draw_plan& p)
{
    std::vector<char> read(s.textures.size());
    for (const draw& d : p.draws) {
        const draw_variant& v = p.variants[static_cast<std::size_t>(d.variant)];
        const standard_material& m = s.materials[static_cast<std::size_t>(d.material)];
        if (v.alpha_map) {
            read[static_cast<std::size_t>(m.alpha_map)] = 1;
        }
        if (v.normal_map) {
            read[static_cast<std::size_t>(m.normal_map)] = 1;
        }
    }
    std::vector<int> places(read.size(), no_texture);
    int next = 0;
    for (std::size_t i = 0; i < read.size(); ++i) {
        if (read[i] != 0) {
            places[i] = next++;
        }
    }
    return places;
}

object upload_heap(buffer_maker& buffers, const scene& s, const std::vector<int>& places)
{
    const result<texel_heap> heap = make_texel_heap(placed(s, places));
    if (!heap) {
        buffers.fail(heap.error());
        return {};
    }
    return buffers.storage("the heap of textures", std::as_bytes(std::span(heap->words)), 0);
}

std::vector<object> upload_textures(buffer_maker& buffers, const functions& gl, const scene& s, const std::vector<int>& places)
{
    const plain_unpack_state plain(gl);
    std::vector<object> made;
    const GLint limit = gl.integer(GL_MAX_TEXTURE_SIZE);
    for (const texture& t : placed(s, places)) {
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

object upload_materials(buffer_maker& buffers, const scene& s, const std::vector<int>& places)
{
    const auto place = [&](int map) {
        return map == no_texture ? 0U : static_cast<std::uint32_t>(std::max(places[static_cast<std::size_t>(map)], 0));
    };
    std::vector<geometry_material> materials;
    for (const standard_material& m : s.materials) {
        materials.push_back({ m.repeat, std::max(m.repeat.x * m.repeat.x, m.repeat.y * m.repeat.y), m.alpha_cutoff,
                              place(m.alpha_map), m.alpha_from_red ? 1U : 0U, place(m.normal_map),
                              m.normal_green_down ? -1.0F : 1.0F });
    }
    return buffers.storage("the table of materials", std::as_bytes(std::span(materials)), 0);
}

} // namespace ao::gl
