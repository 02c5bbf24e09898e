#include "ao/gl/backend.hpp"

#include "state.hpp"

#include <string>
#include <type_traits>
#include <utility>

namespace ao::gl {

static_assert(std::is_same_v<backend::image, GLuint>);

program::program(std::unique_ptr<program_state> state) : state_(std::move(state)) {}
program::program(program&&) noexcept = default;
program& program::operator=(program&&) noexcept = default;
program::~program() = default;

binding::binding(std::unique_ptr<binding_state> state) : state_(std::move(state)) {}
binding::binding(binding&&) noexcept = default;
binding& binding::operator=(binding&&) noexcept = default;
binding::~binding() = default;

backend::backend(std::unique_ptr<functions> loaded, const options& chosen) : gl_(std::move(loaded)), options_(chosen)
{
    const GLubyte* renderer = gl_->GetString(GL_RENDERER);
    device_ = renderer != nullptr ? reinterpret_cast<const char*>(renderer) : "";
}
backend::backend(backend&&) noexcept = default;
backend& backend::operator=(backend&&) noexcept = default;
backend::~backend() = default;

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

result<backend> backend::create(std::unique_ptr<functions> loaded, options chosen)
{
    loaded->take_error();
    const bool has_spirv = loaded->SpecializeShader != nullptr;
    if (chosen.source == shader_source::spirv && !has_spirv) {
        return error(errc::device, "the driver offers no SPIR-V (ARB_gl_spirv)");
    }
    if (chosen.source == shader_source::automatic) {
        chosen.source = has_spirv ? shader_source::spirv : shader_source::text;
    }
    if (chosen.route == route::compute) {
        if (const auto wrong = validate_group(*loaded, chosen)) {
            return *wrong;
        }
    }
    return backend(std::move(loaded), chosen);
}

result<backend> backend::create(get_proc_address loader, const options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

result<backend> backend::create(get_proc_address_as_data loader, const options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

} // namespace ao::gl
