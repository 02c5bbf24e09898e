#include "ao/gl/temporal.hpp"

#include "limits.hpp"
#include "temporal_state.hpp"

#include <cassert>
#include <utility>

namespace ao::gl {

temporal_program::temporal_program(std::unique_ptr<temporal_program_state> state) : state_(std::move(state)) {}
temporal_program::temporal_program(temporal_program&&) noexcept = default;
temporal_program& temporal_program::operator=(temporal_program&&) noexcept = default;
temporal_program::~temporal_program() = default;

unsigned int temporal_program::history(int which) const
{
    assert(which == 0 || which == 1);
    return state_->histories[static_cast<std::size_t>(which)].name();
}

temporal_binding::temporal_binding(std::unique_ptr<temporal_binding_state> state) : state_(std::move(state)) {}
temporal_binding::temporal_binding(temporal_binding&&) noexcept = default;
temporal_binding& temporal_binding::operator=(temporal_binding&&) noexcept = default;
temporal_binding::~temporal_binding() = default;

temporal::temporal(std::unique_ptr<functions> loaded, const options& chosen) : gl_(std::move(loaded)), options_(chosen) {}
temporal::temporal(temporal&&) noexcept = default;
temporal& temporal::operator=(temporal&&) noexcept = default;
temporal::~temporal() = default;

result<temporal> temporal::create(std::unique_ptr<functions> loaded, options chosen)
{
    chosen.route = route::compute;
    if (const auto wrong = settle(*loaded, chosen)) {
        return *wrong;
    }
    return temporal(std::move(loaded), chosen);
}

result<temporal> temporal::create(backend::get_proc_address loader, const options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

result<temporal> temporal::create(backend::get_proc_address_as_data loader, const options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

} // namespace ao::gl
