// Uploads from host memory, tightly packed, whatever the host's pixel store and unpack buffer are; puts them back.
#pragma once

#include "functions.hpp"

#include <array>
#include <cstddef>

namespace ao::gl {

class plain_unpack_state {
public:
    explicit plain_unpack_state(const functions& gl) : gl_(gl)
    {
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            before_[i] = gl.integer(parameters[i]);
            gl.PixelStorei(parameters[i], parameters[i] == GL_UNPACK_ALIGNMENT ? 4 : 0);
        }
        buffer_ = gl.integer(GL_PIXEL_UNPACK_BUFFER_BINDING);
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    }
    plain_unpack_state(const plain_unpack_state&) = delete;
    plain_unpack_state& operator=(const plain_unpack_state&) = delete;
    ~plain_unpack_state()
    {
        gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(buffer_));
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            gl_.PixelStorei(parameters[i], before_[i]);
        }
    }

private:
    static constexpr std::array<GLenum, 8> parameters{ GL_UNPACK_SWAP_BYTES,  GL_UNPACK_LSB_FIRST,   GL_UNPACK_ROW_LENGTH,
                                                       GL_UNPACK_SKIP_ROWS,   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_IMAGE_HEIGHT,
                                                       GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT };
    const functions& gl_;
    std::array<GLint, parameters.size()> before_{};
    GLint buffer_ = 0;
};

} // namespace ao::gl
