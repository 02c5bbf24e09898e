#pragma once
#include "host/gl_context.hpp"
#include "host/pixel_format.hpp"

#include <cstddef>
#include <span>

namespace ao::host {
// A 2-D texture with one level, nearest filter, clamped to its edge. Belongs to the context that was current when it
// was made; that context must be current for every call, the destructor's too.
class gl_texture {
public:
    static result<gl_texture> create(const gl_context& context, pixel_format format, extent size);
    gl_texture(gl_texture&& other) noexcept { *this = std::move(other); }
    gl_texture& operator=(gl_texture&& other) noexcept;
    ~gl_texture();

    unsigned name = 0;
    // GL_R32F and so on; d24 is GL_DEPTH24_STENCIL8, the only one whose bits can be passed unchanged.
    unsigned internal_format = 0;
    pixel_format format = pixel_format::r32f;
    extent size;

    // Rows in memory order, no flip. Leaves the pixel store at its defaults and no pixel buffer bound.
    result<done> upload(std::span<const std::byte> pixels);
    result<done> download(std::span<std::byte> pixels) const;

private:
    gl_texture() = default;
    gl_loader loader_ = nullptr;
};

unsigned gl_internal_format(pixel_format format);
}
