#pragma once

#include <stdexcept>
#include <string>

namespace ao::tools {

// What the program reports and ends with: one line, no trailing full stop, caught in main only.
struct error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Another library's message made fit for one line: control characters and runs of spaces become one space.
[[nodiscard]] std::string one_line(const std::string& text);

} // namespace ao::tools
