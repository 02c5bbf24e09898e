#pragma once

#include "ao/bake_options.hpp"

namespace ao::tools {

// `ao bake`. Throws `error`; what was done of the bake is in the part's file then. False where another process of the same mpirun
// has failed, and says so.
[[nodiscard]] bool bake(const bake_options& o);

} // namespace ao::tools
