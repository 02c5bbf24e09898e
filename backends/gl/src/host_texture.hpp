// Textures that the host hands over: whether they are what a plan says, and how to read them.
#pragma once

#include "ao/plan.hpp"
#include "object.hpp"

#include <optional>

namespace ao::gl {

// errc::device, errc::unsupported_format or errc::invalid_size; `role` names the texture in the reason.
std::optional<error> check_texture(const functions& gl, GLuint texture, const char* role, pixel_format format, int width,
                                   int height);

// A texture to read the host's one by: a view with parameters of its own where GL allows one, else the name itself.
// Precondition: it was checked.
result<GLuint> make_readable(const functions& gl, GLuint texture, const char* role, pixel_format format, object& view);

} // namespace ao::gl
