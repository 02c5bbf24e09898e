#pragma once

#include <functional>
#include <string>

namespace ao::tools {

// What `work` returns, worked out in a child process: a library that crashes or never ends on a damaged file takes the
// child with it and nobody else. Throws `error`: the child's own when `work` threw one, or one that begins with `what`
// when the child died or used more than `seconds` of processor time.
[[nodiscard]] std::string run_apart(const std::string& what, unsigned seconds, const std::function<std::string()>& work);

} // namespace ao::tools
