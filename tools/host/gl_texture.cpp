#include "host/gl_texture.hpp"

#include <GL/glcorearb.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace ao::host {
namespace {
struct layout {
    GLenum internal;
    GLenum format;
    GLenum type;
};

layout layout_of(pixel_format format)
{
    switch (format) {
    case pixel_format::r8:
        return { GL_R8, GL_RED, GL_UNSIGNED_BYTE };
    case pixel_format::r32f:
        return { GL_R32F, GL_RED, GL_FLOAT };
    case pixel_format::rg32f:
        return { GL_RG32F, GL_RG, GL_FLOAT };
    case pixel_format::rgba16f:
        return { GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT };
    case pixel_format::rgba32f:
        return { GL_RGBA32F, GL_RGBA, GL_FLOAT };
    case pixel_format::rgb10a2:
        return { GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV };
    case pixel_format::rg16:
        return { GL_RG16, GL_RG, GL_UNSIGNED_SHORT };
    case pixel_format::d32f:
        return { GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT };
    case pixel_format::d24:
        return { GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8 };
    case pixel_format::rg32ui:
        return { GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT };
    }
    return { 0, 0, 0 };
}

template <class Function>
Function load(gl_loader loader, const char* name)
{
    return reinterpret_cast<Function>(loader(name));
}

// Returns the first error since the last call, so that an old one is not blamed on the next.
GLenum take_error(gl_loader loader)
{
    const auto get_error = load<PFNGLGETERRORPROC>(loader, "glGetError");
    const GLenum first = get_error();
    for (int i = 0; i < 16 && get_error() != GL_NO_ERROR; ++i) {}
    return first;
}

failure gl_failure(const std::string& what, GLenum code)
{
    return { what + (code == GL_OUT_OF_MEMORY ? ": out of memory" : " failed with GL error " + std::to_string(code)) };
}

// The packed GL type has the depth in the high 24 bits, our memory in the low ones.
void shift_words(std::span<std::byte> words, bool up)
{
    for (std::size_t i = 0; i + 4 <= words.size(); i += 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, &words[i], 4);
        word = up ? word << 8 : word >> 8;
        std::memcpy(&words[i], &word, 4);
    }
}

void reset_pixel_store(gl_loader loader, GLint alignment)
{
    const auto pixel_store = load<PFNGLPIXELSTOREIPROC>(loader, "glPixelStorei");
    const auto bind_buffer = load<PFNGLBINDBUFFERPROC>(loader, "glBindBuffer");
    bind_buffer(GL_PIXEL_PACK_BUFFER, 0);
    bind_buffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const GLenum parameter : { GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_UNPACK_ROW_LENGTH,
                                    GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS })
        pixel_store(parameter, 0);
    pixel_store(GL_PACK_ALIGNMENT, alignment);
    pixel_store(GL_UNPACK_ALIGNMENT, alignment);
}
}

unsigned gl_internal_format(pixel_format format)
{
    return layout_of(format).internal;
}

result<gl_texture> gl_texture::create(const gl_context& context, pixel_format format, extent size)
{
    const gl_loader loader = context.loader();
    const std::string what =
        std::string("a ") + host::name(format) + " texture of " + std::to_string(size.width) + "x" + std::to_string(size.height);
    GLint limit = 0;
    load<PFNGLGETINTEGERVPROC>(loader, "glGetIntegerv")(GL_MAX_TEXTURE_SIZE, &limit);
    if (size.width == 0 || size.height == 0)
        return failure{ what + " has no pixels" };
    if (size.width > static_cast<unsigned>(limit) || size.height > static_cast<unsigned>(limit))
        return failure{ what + " exceeds the limit of the device, " + std::to_string(limit) };

    gl_texture self;
    self.loader_ = loader;
    self.format = format;
    self.size = size;
    self.internal_format = layout_of(format).internal;
    take_error(loader);
    load<PFNGLCREATETEXTURESPROC>(loader, "glCreateTextures")(GL_TEXTURE_2D, 1, &self.name);
    load<PFNGLTEXTURESTORAGE2DPROC>(loader, "glTextureStorage2D")(
        self.name, 1, self.internal_format, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height));
    const auto parameter = load<PFNGLTEXTUREPARAMETERIPROC>(loader, "glTextureParameteri");
    parameter(self.name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    parameter(self.name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    parameter(self.name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    parameter(self.name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (const GLenum code = take_error(loader); code != GL_NO_ERROR)
        return gl_failure(what, code);
    return self;
}

gl_texture& gl_texture::operator=(gl_texture&& other) noexcept
{
    std::swap(name, other.name);
    std::swap(internal_format, other.internal_format);
    std::swap(format, other.format);
    std::swap(size, other.size);
    std::swap(loader_, other.loader_);
    return *this;
}

gl_texture::~gl_texture()
{
    if (loader_ && name)
        load<PFNGLDELETETEXTURESPROC>(loader_, "glDeleteTextures")(1, &name);
}

result<done> gl_texture::upload(std::span<const std::byte> pixels)
{
    if (pixels.size() != byte_count(format, size))
        return failure{ "upload: " + std::to_string(pixels.size()) + " bytes for a texture of " +
                        std::to_string(byte_count(format, size)) };
    std::vector<std::byte> shifted;
    if (format == pixel_format::d24) {
        shifted.assign(pixels.begin(), pixels.end());
        shift_words(shifted, true);
        pixels = shifted;
    }
    const layout as = layout_of(format);
    take_error(loader_);
    reset_pixel_store(loader_, 1);
    load<PFNGLTEXTURESUBIMAGE2DPROC>(loader_, "glTextureSubImage2D")(
        name, 0, 0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height), as.format, as.type, pixels.data());
    reset_pixel_store(loader_, 4);
    if (const GLenum code = take_error(loader_); code != GL_NO_ERROR)
        return gl_failure(std::string("uploading ") + host::name(format), code);
    return done{};
}

result<done> gl_texture::download(std::span<std::byte> pixels) const
{
    if (pixels.size() != byte_count(format, size))
        return failure{ "download: " + std::to_string(pixels.size()) + " bytes for a texture of " +
                        std::to_string(byte_count(format, size)) };
    const layout as = layout_of(format);
    take_error(loader_);
    reset_pixel_store(loader_, 1);
    load<PFNGLGETTEXTUREIMAGEPROC>(loader_, "glGetTextureImage")(name, 0, as.format, as.type, static_cast<GLsizei>(pixels.size()),
                                                                 pixels.data());
    reset_pixel_store(loader_, 4);
    if (const GLenum code = take_error(loader_); code != GL_NO_ERROR)
        return gl_failure(std::string("downloading ") + host::name(format), code);
    if (format == pixel_format::d24)
        shift_words(pixels, false);
    return done{};
}
}
