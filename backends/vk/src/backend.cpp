#include "program.hpp"

namespace ao::vk {

program::program(std::unique_ptr<prepared> p) : prepared_(std::move(p)) {}
program::program(program&&) noexcept = default;
program& program::operator=(program&&) noexcept = default;
program::~program() = default;

binding::binding(std::unique_ptr<bound> b) : bound_(std::move(b)) {}
binding::binding(binding&&) noexcept = default;
binding& binding::operator=(binding&&) noexcept = default;
binding::~binding() = default;

backend::backend(std::unique_ptr<device> d) : device_(std::move(d)) {}
backend::backend(backend&&) noexcept = default;
backend& backend::operator=(backend&&) noexcept = default;
backend::~backend() = default;

result<backend> backend::create(const context& c)
{
    auto made = make_device(c);
    if (!made) {
        return made.error();
    }
    return backend(std::move(*made));
}

} // namespace ao::vk
