#include "bake_state.hpp"
#include "buffer.hpp"
#include "saved_state.hpp"

#include <optional>
#include <string>

namespace ao::gl {

namespace {

// A buffer of texels of four words.
std::optional<error> make_texels(const functions& gl, const char* what, const object& buffer, GLenum format, std::size_t texels,
                                 object& made)
{
    const auto limit = static_cast<std::size_t>(gl.integer(GL_MAX_TEXTURE_BUFFER_SIZE));
    if (texels > limit) {
        return error(errc::out_of_memory, std::string(what) + ": " + std::to_string(texels) + " texels, the driver takes " +
                                              std::to_string(limit) + " in a buffer texture");
    }
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    made = object(gl, object_type::texture, name);
    gl.TextureBuffer(name, format, buffer.name());
    return std::nullopt;
}

} // namespace

result<bake_buffers> make_bake_buffers(const functions& gl, const bake_job& job, const bake_request& part, bake_route route,
                                       const detail::bake_room& room)
{
    const detail::bake_gpu_tables t = detail::make_bake_gpu_tables(job, part);
    struct table {
        bake_unit unit;
        const char* name;
        std::span<const std::byte> content;
        GLenum format;
    };
    const std::array<table, nodes_unit + 1> tables{
        { { vertices_unit, "the vertices of the bake", std::as_bytes(std::span(t.vertices)), GL_RGBA32UI },
          { triangles_unit, "the triangles of the bake", std::as_bytes(std::span(t.triangles)), GL_RGBA32UI },
          { points_unit, "the points of the bake", std::as_bytes(std::span(t.points)), GL_RGBA32F },
          { lines_unit, "the lines of the bake", std::as_bytes(std::span(t.lines)), GL_RGBA32F },
          { rotations_unit, "the rotations of the bake", std::as_bytes(std::span(t.rotations)), GL_RGBA32F },
          { nodes_unit, "the tree of the bake", std::as_bytes(t.nodes), GL_RGBA32UI } }
    };
    const auto read = std::span(tables).first(route == bake_route::hierarchy ? tables.size() : tables.size() - 1);
    bake_buffers made;
    buffer_maker buffers(gl);
    for (const table& each : read) {
        made.tables[each.unit] = buffers.make(each.name, each.content, 0);
        if (auto wrong = make_texels(gl, each.name, made.tables[each.unit], each.format, each.content.size() / 16,
                                     made.textures[each.unit])) {
            return *wrong;
        }
    }
    const std::size_t vertices = part.last_vertex - part.first_vertex;
    const std::vector<bake_sum> none(vertices);
    made.sums = buffers.storage("the sums of the bake", std::as_bytes(std::span(none)), 0);
    if (room.lines > 0) {
        const char* what = "the points along lines of the bake";
        made.tables[seen_unit] = buffers.storage_of_size(what, room.texels() * sizeof(glm::vec4), 0);
        if (buffers.failed()) {
            return *buffers.failed();
        }
        if (auto wrong = make_texels(gl, what, made.tables[seen_unit], GL_RGBA32F, room.texels(), made.textures[seen_unit])) {
            return *wrong;
        }
    }
    if (room.words > 0) {
        made.words = buffers.storage_of_size("what the bake finds", room.words * sizeof(std::uint32_t), 0);
    }
    const detail::bake_launch empty;
    made.launch = buffers.make("a launch of the bake", std::as_bytes(std::span(&empty, 1)), GL_DYNAMIC_STORAGE_BIT);
    if (buffers.failed()) {
        return *buffers.failed();
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("allocating the tables of the bake", code);
    }
    return made;
}

std::optional<error> launch_bake(const bake_state& state, const bake_buffers& buffers, GLuint program,
                                 const detail::bake_launch& launch, std::uint32_t x, std::uint32_t y)
{
    const functions& gl = *state.gl;
    std::optional<saved_state> before;
    if (state.chosen.restore_state) {
        before.emplace(gl, touched{ .textures = bake_unit_count,
                                    .buffer_textures = true,
                                    .uniform_buffers = 1,
                                    .storage_buffers = bake_storage_count });
    }
    gl.NamedBufferSubData(buffers.launch.name(), 0, sizeof launch, &launch);
    gl.UseProgram(program);
    // Units that a shader does not read get whatever fits: name 0 would unbind textures of other targets too.
    std::array<GLuint, bake_unit_count> textures{};
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const GLuint own = buffers.textures[i].name();
        textures[i] = own != 0 ? own : buffers.textures[points_unit].name();
    }
    const std::array<GLuint, bake_unit_count> samplers{};
    gl.BindTextures(0, bake_unit_count, textures.data());
    gl.BindSamplers(0, bake_unit_count, samplers.data());
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, buffers.launch.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, sums_storage, buffers.sums.name());
    if (buffers.words.name() != 0) {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, words_storage, buffers.words.name());
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, seen_storage, buffers.tables[seen_unit].name());
    }
    gl.DispatchCompute(x, y, 1);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    // Waits.
    GLuint word = 0;
    gl.GetNamedBufferSubData(buffers.sums.name(), 0, sizeof word, &word);
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("a launch of the bake", code);
    }
    return std::nullopt;
}

} // namespace ao::gl
