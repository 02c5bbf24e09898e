#pragma once

#include "ao/gl/options.hpp"
#include "ao/result.hpp"
#include "host/gl_context.hpp"

#include <glm/vec4.hpp>

#include <span>

namespace ao::host {

// The shared functions as this driver compiles them, in a compute shader. The context is current.
ao::result<success> evaluate_gl(gl_loader loader, gl::shader_source source, int function, std::span<const glm::vec4> a,
                                std::span<const glm::vec4> b, std::span<glm::vec4> out);

} // namespace ao::host
