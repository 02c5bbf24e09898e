// Shaders of the library as programs of the driver.
#pragma once

#include "ao/gl/options.hpp"
#include "object.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace ao::gl {

// A shader in both forms.
struct source {
    std::span<const std::uint32_t> spirv;
    std::string_view text;
    std::span<const GLuint> constant_ids; // specialisation constants that it declares
    const char* name;
};

// `chosen` is not automatic. values: by constant id; a boolean is 0 or 1.
result<object> compile(const functions& gl, shader_source chosen, GLenum stage, const source& from,
                       std::span<const GLuint> values);

result<object> link(const functions& gl, const char* name, std::span<const object> shaders);

} // namespace ao::gl
