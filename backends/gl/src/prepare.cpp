#include "ao/gl/backend.hpp"
#include "ao/kernel.hpp"
#include "shader.hpp"
#include "state.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace ao::gl {

namespace {

std::optional<error> validate_size(const functions& gl, const options& chosen, const facts& f)
{
    GLint width = gl.integer(GL_MAX_TEXTURE_SIZE);
    GLint height = width;
    if (chosen.route == route::fragment) {
        std::array<GLint, 2> viewport{};
        gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
        width = std::min(width, viewport[0]);
        height = std::min(height, viewport[1]);
    }
    else {
        std::array<GLint, 2> groups{};
        gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &groups[0]);
        gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &groups[1]);
        width = groups[0] < width / static_cast<GLint>(chosen.group_width) ? groups[0] * static_cast<GLint>(chosen.group_width)
                                                                           : width;
        height = groups[1] < height / static_cast<GLint>(chosen.group_height)
                     ? groups[1] * static_cast<GLint>(chosen.group_height)
                     : height;
    }
    if (f.width < 1 || f.height < 1 || f.width > width || f.height > height) {
        return error(errc::invalid_size, "picture of " + std::to_string(f.width) + "x" + std::to_string(f.height) +
                                             ", the driver takes up to " + std::to_string(width) + "x" + std::to_string(height));
    }
    return std::nullopt;
}

object make_texture(const functions& gl, GLenum format, int width, int height)
{
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
    gl.TextureStorage2D(name, 1, format, width, height);
    return object(gl, object_type::texture, name);
}

// Independent of the host's pixel store and unpack buffer, which it puts back.
void upload(const functions& gl, GLuint texture, int side, const void* texels)
{
    constexpr std::array<GLenum, 8> parameters{ GL_UNPACK_SWAP_BYTES,  GL_UNPACK_LSB_FIRST,   GL_UNPACK_ROW_LENGTH,
                                                GL_UNPACK_SKIP_ROWS,   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_IMAGE_HEIGHT,
                                                GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT };
    std::array<GLint, parameters.size()> before{};
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        before[i] = gl.integer(parameters[i]);
        gl.PixelStorei(parameters[i], parameters[i] == GL_UNPACK_ALIGNMENT ? 4 : 0);
    }
    const GLint buffer = gl.integer(GL_PIXEL_UNPACK_BUFFER_BINDING);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.TextureSubImage2D(texture, 0, 0, 0, side, side, GL_RG, GL_FLOAT, texels);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(buffer));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        gl.PixelStorei(parameters[i], before[i]);
    }
}

// Fetches need no filter, but a texture without the levels of its own filter would be incomplete, and one with a
// comparison undefined.
object make_sampler(const functions& gl)
{
    object sampler = make_object(gl, object_type::sampler, gl.CreateSamplers);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
    return sampler;
}

void make_tables(const functions& gl, program_state& state, const settings& s)
{
    const auto taps = make_kernel(s.kernel, s.taps, s.seed);
    state.taps = make_object(gl, object_type::buffer, gl.CreateBuffers);
    gl.NamedBufferStorage(state.taps.name(), sizeof taps, taps.data(), 0);

    const auto tile = make_rotation_tile(s.seed);
    object& rotations = state.images[index_of(image_id::rotation)];
    rotations = make_texture(gl, GL_RG32F, tile_size, tile_size);
    upload(gl, rotations.name(), tile_size, tile.data());
}

} // namespace

result<object> make_framebuffer(const functions& gl, GLuint texture)
{
    object framebuffer = make_object(gl, object_type::framebuffer, gl.CreateFramebuffers);
    gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture, 0);
    const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return error(errc::device, "the driver does not render to a picture of the passes", static_cast<int>(status));
    }
    return framebuffer;
}

result<program> backend::prepare(const plan& p)
{
    const functions& gl = *gl_;
    gl.take_error();
    if (const auto wrong = validate_size(gl, options_, p.facts)) {
        return *wrong;
    }
    auto state = std::make_unique<program_state>();
    for (const transient_image& each : p.transients) {
        state->images[index_of(each.id)] = make_texture(gl, internal_format(each.format), p.facts.width, p.facts.height);
        state->formats[index_of(each.id)] = internal_format(each.format);
    }
    state->formats[index_of(image_id::visibility)] = internal_format(p.facts.output_format);
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("allocating the pictures of the passes", code);
    }
    make_tables(gl, *state, p.settings);
    state->constants = make_object(gl, object_type::buffer, gl.CreateBuffers);
    gl.NamedBufferStorage(state->constants.name(), constants_stride * static_cast<GLsizeiptr>(p.passes.size()), nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
    state->sampler = make_sampler(gl);
    if (options_.route == route::fragment) {
        state->vertex_array = make_object(gl, object_type::vertex_array, gl.CreateVertexArrays);
    }
    for (const pass& each : p.passes) {
        result<object> linked = link_pass(gl, options_, each, p.facts.depth == depth_source::position);
        if (!linked) {
            return linked.error();
        }
        linked_pass made;
        made.type = each.type;
        made.program = std::move(*linked);
        if (options_.route == route::fragment && each.output != image_id::visibility) {
            result<object> framebuffer = make_framebuffer(gl, state->images[index_of(each.output)].name());
            if (!framebuffer) {
                return framebuffer.error();
            }
            made.framebuffer = std::move(*framebuffer);
        }
        state->passes.push_back(std::move(made));
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("preparing the passes", code);
    }
    return program(std::move(state));
}

} // namespace ao::gl
