// A name of a GL object, deleted with its owner.
#pragma once

#include "functions.hpp"

#include <utility>

namespace ao::gl {

enum class object_type { texture, buffer, sampler, framebuffer, vertex_array, program, shader };

class object {
public:
    object() = default;
    object(const functions& gl, object_type type, GLuint name) : gl_(&gl), type_(type), name_(name) {}
    object(object&& other) noexcept : gl_(other.gl_), type_(other.type_), name_(std::exchange(other.name_, 0)) {}
    object& operator=(object&& other) noexcept
    {
        std::swap(gl_, other.gl_);
        std::swap(type_, other.type_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~object()
    {
        if (name_ == 0) {
            return;
        }
        switch (type_) {
        case object_type::texture:
            gl_->DeleteTextures(1, &name_);
            break;
        case object_type::buffer:
            gl_->DeleteBuffers(1, &name_);
            break;
        case object_type::sampler:
            gl_->DeleteSamplers(1, &name_);
            break;
        case object_type::framebuffer:
            gl_->DeleteFramebuffers(1, &name_);
            break;
        case object_type::vertex_array:
            gl_->DeleteVertexArrays(1, &name_);
            break;
        case object_type::program:
            gl_->DeleteProgram(name_);
            break;
        case object_type::shader:
            gl_->DeleteShader(name_);
            break;
        }
    }

    GLuint name() const { return name_; }

private:
    const functions* gl_ = nullptr;
    object_type type_{};
    GLuint name_ = 0;
};

// For the glCreate functions that make several names.
inline object make_object(const functions& gl, object_type type, void(APIENTRY* function)(GLsizei, GLuint*))
{
    GLuint name = 0;
    function(1, &name);
    return object(gl, type, name);
}

} // namespace ao::gl
