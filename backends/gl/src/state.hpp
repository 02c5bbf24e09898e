// What program and binding hold.
#pragma once

#include "ao/gl/backend.hpp"
#include "object.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ao::gl {

// Texture units, image unit and uniform buffer bindings of the shaders.
inline constexpr GLsizei max_inputs = 3;
inline constexpr GLuint constants_index = 0;
inline constexpr GLuint taps_index = 1;

// Every driver's GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT is at most this.
inline constexpr GLintptr constants_stride = 256;

struct linked_pass {
    pass_type type{};
    object program;
    object framebuffer; // fragment route, output of the program's own
    std::array<std::byte, 128> uploaded{};
    bool has_uploaded = false;
};

inline constexpr std::size_t image_count = static_cast<std::size_t>(image_id::none);
inline constexpr std::size_t index_of(image_id id)
{
    return static_cast<std::size_t>(id);
}

struct program_state {
    std::vector<linked_pass> passes;
    std::array<object, image_count> images; // rotations and the plan's own pictures, by image_id
    std::array<GLenum, image_count> formats{};
    object constants;
    object taps;
    object sampler;
    object vertex_array; // fragment route
};

struct binding_state {
    object depth_view; // unless the host's texture is mutable
    object normal_view;
    object framebuffer;                       // fragment route
    std::array<GLuint, image_count> images{}; // every picture of the plan, by image_id
};

constexpr GLenum internal_format(pixel_format format)
{
    switch (format) {
    case pixel_format::r32f:
        return GL_R32F;
    case pixel_format::rg32f:
        return GL_RG32F;
    case pixel_format::rgba16f:
        return GL_RGBA16F;
    case pixel_format::rgba32f:
        return GL_RGBA32F;
    case pixel_format::rgb10a2:
        return GL_RGB10_A2;
    case pixel_format::rg16:
        return GL_RG16;
    case pixel_format::d32f:
        return GL_DEPTH_COMPONENT32F;
    case pixel_format::d24:
        return GL_DEPTH_COMPONENT24;
    case pixel_format::r8:
        return GL_R8;
    case pixel_format::rg32ui:
        return GL_RG32UI;
    }
    return GL_NONE;
}

object make_texture(const functions& gl, GLenum format, int width, int height);

// Fetches need no filter, but a texture without the levels of its own filter would be incomplete, and one with a
// comparison undefined.
object make_sampler(const functions& gl);

// A tile of tile_size squared texels, GL_RG32F.
object make_tile_texture(const functions& gl, std::span<const glm::vec2> tile);

// A framebuffer with level 0 of a texture as its only color.
result<object> make_framebuffer(const functions& gl, GLuint texture);

} // namespace ao::gl
