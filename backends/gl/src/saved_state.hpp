// The state of the context that a pass changes, put back when this goes out of scope.
#pragma once

#include "functions.hpp"

#include <array>
#include <cstddef>

namespace ao::gl {

// What must be off for triangles to write every pixel as it is, apart from the indexed ones (blend, scissor).
inline constexpr std::array<GLenum, 12> switched_off{
    GL_STENCIL_TEST,   GL_DITHER,         GL_COLOR_LOGIC_OP, GL_RASTERIZER_DISCARD, GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1,
    GL_CLIP_DISTANCE2, GL_CLIP_DISTANCE3, GL_CLIP_DISTANCE4, GL_CLIP_DISTANCE5,     GL_CLIP_DISTANCE6, GL_CLIP_DISTANCE7,
};
// And for meshes in depth.
inline constexpr std::array<GLenum, 5> switched_off_in_depth{ GL_DEPTH_CLAMP, GL_POLYGON_OFFSET_FILL, GL_POLYGON_SMOOTH,
                                                              GL_PRIMITIVE_RESTART, GL_PRIMITIVE_RESTART_FIXED_INDEX };

// The first so many units and bindings of each kind.
struct touched {
    GLuint textures = 0;          // 2-D, with samplers
    bool buffer_textures = false; // of the same units
    GLuint uniform_buffers = 0;
    GLuint storage_buffers = 0;
    GLuint images = 0;
    bool dispatch = false;    // indirect ones
    GLuint color_targets = 0; // 0: nothing is drawn
    bool depth = false;       // draws meshes: depth, culling, clip control, indirect draws
};

class saved_state {
public:
    saved_state(const functions& gl, const touched& what);
    saved_state(const saved_state&) = delete;
    saved_state& operator=(const saved_state&) = delete;
    ~saved_state();

private:
    static constexpr std::size_t most_textures = 6;
    static constexpr std::size_t most_uniform_buffers = 2;
    static constexpr std::size_t most_storage_buffers = 4;
    static constexpr std::size_t most_images = 2;
    static constexpr std::size_t most_color_targets = 6;

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
        std::array<std::array<GLboolean, 4>, most_color_targets> color_masks;
        GLenum polygon_mode;
        std::array<GLboolean, switched_off.size()> enabled;
        std::array<GLboolean, most_color_targets> blend;
        GLboolean scissor;
        GLboolean depth_test;
        GLboolean cull_face;
    };
    struct depth {
        GLboolean mask;
        GLenum function;
        std::array<GLdouble, 2> range;
        GLenum culled;
        GLenum front;
        GLenum clip_origin;
        GLenum clip_depth;
        GLuint indirect;
        std::array<GLboolean, switched_off_in_depth.size()> enabled;
    };

    void save_buffers(GLenum binding, GLenum start, GLenum size, GLuint count, buffer_range* into) const;
    void restore_buffers(GLenum target, GLuint count, const buffer_range* from) const;
    image_unit save_image_unit(GLuint unit) const;
    void save_raster();
    void save_depth();
    void restore_raster() const;
    void restore_depth() const;

    const functions& gl_;
    touched what_;
    GLuint program_;
    GLenum active_texture_;
    GLuint uniform_buffer_;
    GLuint storage_buffer_;
    GLuint dispatch_buffer_;
    std::array<GLuint, most_textures> textures_;
    std::array<GLuint, most_textures> samplers_;
    std::array<GLuint, most_textures> buffer_textures_;
    std::array<buffer_range, most_uniform_buffers> uniform_buffers_;
    std::array<buffer_range, most_storage_buffers> storage_buffers_;
    std::array<image_unit, most_images> image_units_;
    raster raster_;
    depth depth_;
};

} // namespace ao::gl
