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
        object made = make_object(*gl_, object_type::buffer, gl_->CreateBuffers);
        const std::size_t size = content.size() < 4 ? 4 : content.size();
        gl_->NamedBufferStorage(made.name(), static_cast<GLsizeiptr>(size), content.size() < 4 ? nullptr : content.data(), flags);
        if (const GLenum code = gl_->take_error(); code != GL_NO_ERROR) {
            fail(gl_error(what, code));
        }
        return made;
    }
    // That shaders read whole.
    object storage(const char* what, std::span<const std::byte> content, GLbitfield flags)
    {
        const GLint limit = gl_->integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
        if (content.size() > static_cast<std::size_t>(limit)) {
            fail(error(errc::out_of_memory, std::string(what) + ": " + std::to_string(content.size() / 1048576 + 1) +
                                                " MiB, the driver takes " + std::to_string(limit / 1048576) +
                                                " MiB as a storage buffer"));
            return {};
        }
        return make(what, content, flags);
    }
    void fail(const error& e)
    {
        if (!failed_) {
            failed_ = e;
        }
    }
    const std::optional<error>& failed() const { return failed_; }

private:
    const functions* gl_;
    std::optional<error> failed_;
};

} // namespace ao::gl
