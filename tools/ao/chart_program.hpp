#pragma once

#include "ao/chart_options.hpp"

namespace ao::tools {

// `ao chart`: every configuration over every view on every backend, as numbers. Throws `error`.
void chart(const chart_options& o);

} // namespace ao::tools
