#include "limits.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace ao::gl {

namespace {

std::optional<error> validate_group(const functions& gl, const options& chosen)
{
    GLint width = 0;
    GLint height = 0;
    gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_SIZE, 0, &width);
    gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_SIZE, 1, &height);
    const auto invocations = static_cast<unsigned>(gl.integer(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS));
    const unsigned w = chosen.group_width;
    const unsigned h = chosen.group_height;
    if (w < 1 || h < 1 || w > static_cast<unsigned>(width) || h > static_cast<unsigned>(height) || w > invocations / h) {
        return error(errc::invalid_settings, "work group of " + std::to_string(w) + "x" + std::to_string(h) +
                                                 ", the driver takes " + std::to_string(width) + "x" + std::to_string(height) +
                                                 " and " + std::to_string(invocations) + " together");
    }
    return std::nullopt;
}

} // namespace

std::optional<error> settle(const functions& gl, options& chosen)
{
    gl.take_error();
    const bool has_spirv = gl.SpecializeShader != nullptr;
    if (chosen.source == shader_source::spirv && !has_spirv) {
        return error(errc::device, "the driver offers no SPIR-V (ARB_gl_spirv)");
    }
    if (chosen.source == shader_source::automatic) {
        chosen.source = has_spirv ? shader_source::spirv : shader_source::text;
    }
    return chosen.route == route::compute ? validate_group(gl, chosen) : std::nullopt;
}

std::optional<error> check_size(const functions& gl, const options& chosen, int wanted_width, int wanted_height)
{
    GLint width = gl.integer(GL_MAX_TEXTURE_SIZE);
    GLint height = width;
    if (chosen.route == route::fragment) {
        std::array<GLint, 2> viewport{};
        gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
        width = std::min(width, viewport[0]);
        height = std::min(height, viewport[1]);
    }
    else {
        std::array<GLint, 2> groups{};
        gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &groups[0]);
        gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &groups[1]);
        width = groups[0] < width / static_cast<GLint>(chosen.group_width) ? groups[0] * static_cast<GLint>(chosen.group_width)
                                                                           : width;
        height = groups[1] < height / static_cast<GLint>(chosen.group_height)
                     ? groups[1] * static_cast<GLint>(chosen.group_height)
                     : height;
    }
    if (wanted_width < 1 || wanted_height < 1 || wanted_width > width || wanted_height > height) {
        return error(errc::invalid_size, "picture of " + std::to_string(wanted_width) + "x" + std::to_string(wanted_height) +
                                             ", the driver takes up to " + std::to_string(width) + "x" + std::to_string(height));
    }
    return std::nullopt;
}

} // namespace ao::gl
