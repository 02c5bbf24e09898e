// What the driver can do.
#pragma once

#include "ao/gl/options.hpp"
#include "functions.hpp"

#include <optional>

namespace ao::gl {

// Decides what is left to the driver; fails as backend::create does. Drops errors that the host left pending.
std::optional<error> settle(const functions& gl, options& chosen);

// errc::invalid_size for pictures that the route cannot write.
std::optional<error> check_size(const functions& gl, const options& chosen, int wanted_width, int wanted_height);

} // namespace ao::gl
