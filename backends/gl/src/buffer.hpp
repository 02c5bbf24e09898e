// Buffers of the library, with what the driver says about their sizes.
#pragma once

#include "object.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace ao::gl {

// Makes buffers and keeps the first error.
class buffer_maker {
public:
    explicit buffer_maker(const functions& gl) : gl_(&gl) {}

    // Of at least four bytes.
    object make(const char* what, std::span<const std::byte> content, GLbitfield flags)
    {
        const bool empty = content.size() < 4;
        return allocate(what, empty ? 4 : content.size(), empty ? nullptr : content.data(), flags);
    }
    // That shaders read whole.
    object storage(const char* what, std::span<const std::byte> content, GLbitfield flags)
    {
        return fits(what, content.size()) ? make(what, content, flags) : object();
    }
    // Whose content is not defined. Precondition: size > 0.
    object storage_of_size(const char* what, std::size_t size, GLbitfield flags)
    {
        return fits(what, size) ? allocate(what, size, nullptr, flags) : object();
    }
    void fail(const error& e)
    {
        if (!failed_) {
            failed_ = e;
        }
    }
    const std::optional<error>& failed() const { return failed_; }

private:
    object allocate(const char* what, std::size_t size, const std::byte* content, GLbitfield flags)
    {
        object made = make_object(*gl_, object_type::buffer, gl_->CreateBuffers);
        gl_->NamedBufferStorage(made.name(), static_cast<GLsizeiptr>(size), content, flags);
        if (const GLenum code = gl_->take_error(); code != GL_NO_ERROR) {
            fail(gl_error(what, code));
        }
        return made;
    }
    bool fits(const char* what, std::size_t size)
    {
        const GLint limit = gl_->integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
        if (size <= static_cast<std::size_t>(limit)) {
            return true;
        }
        fail(error(errc::out_of_memory, std::string(what) + ": " + std::to_string(size / 1048576 + 1) +
                                            " MiB, the driver takes " + std::to_string(limit / 1048576) +
                                            " MiB as a storage buffer"));
        return false;
    }

    const functions* gl_;
    std::optional<error> failed_;
};

} // namespace ao::gl
