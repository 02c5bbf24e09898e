#pragma once

#include "ao/gl/options.hpp"
#include "ao/plan.hpp"
#include "object.hpp"

namespace ao::gl {

// The linked program of a pass. `chosen.source` is not automatic.
result<object> link_pass(const functions& gl, const options& chosen, const pass& p, bool from_position);

} // namespace ao::gl
