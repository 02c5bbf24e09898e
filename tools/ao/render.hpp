#pragma once

#include "ao/options.hpp"

namespace ao::tools {

// `ao render`: G-buffer, every backend, truth, tables, files. Throws `error`.
void render(const render_options& o);

} // namespace ao::tools
