// The state of the context that a pass changes, put back when this goes out of scope.
#pragma once

#include "ao/gl/options.hpp"
#include "state.hpp"

#include <array>

namespace ao::gl {

// What must be off for a full-screen triangle to write every pixel as it is, apart from the indexed ones (blend, scissor).
inline constexpr std::array<GLenum, 14> switched_off{
    GL_DEPTH_TEST,         GL_STENCIL_TEST,   GL_CULL_FACE,      GL_DITHER,         GL_COLOR_LOGIC_OP,
    GL_RASTERIZER_DISCARD, GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1, GL_CLIP_DISTANCE2, GL_CLIP_DISTANCE3,
    GL_CLIP_DISTANCE4,     GL_CLIP_DISTANCE5, GL_CLIP_DISTANCE6, GL_CLIP_DISTANCE7,
};
inline constexpr std::array<GLenum, 2> switched_off_indexed{ GL_BLEND, GL_SCISSOR_TEST };

class saved_state {
public:
    saved_state(const functions& gl, route by);
    saved_state(const saved_state&) = delete;
    saved_state& operator=(const saved_state&) = delete;
    ~saved_state();

private:
    struct buffer_range {
        GLuint name;
        GLint64 start;
        GLint64 size;
    };
    struct image_unit {
        GLuint texture;
        GLint level;
        GLboolean layered;
        GLint layer;
        GLenum access;
        GLenum format;
    };
    struct raster {
        GLuint vertex_array;
        GLuint framebuffer;
        std::array<GLfloat, 4> viewport;
        std::array<GLboolean, 4> color_mask;
        GLenum polygon_mode;
        std::array<GLboolean, switched_off.size()> enabled;
        std::array<GLboolean, switched_off_indexed.size()> enabled_indexed;
    };

    void save_image_unit();
    void save_raster();
    void restore_raster() const;

    const functions& gl_;
    route route_;
    GLuint program_;
    GLenum active_texture_;
    GLuint uniform_buffer_;
    std::array<GLuint, max_inputs> textures_;
    std::array<GLuint, max_inputs> samplers_;
    std::array<buffer_range, 2> uniform_buffers_;
    image_unit image_unit_;
    raster raster_;
};

} // namespace ao::gl
