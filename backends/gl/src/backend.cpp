#include "ao/gl/backend.hpp"

#include "limits.hpp"
#include "state.hpp"

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

result<backend> backend::create(std::unique_ptr<functions> loaded, options chosen)
{
    if (const auto wrong = settle(*loaded, chosen)) {
        return *wrong;
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
