#pragma once

#include "scene.hpp"

namespace ao::tools {

// A scene as bytes and back, within one machine and one build; for passing it between processes.
[[nodiscard]] std::string to_bytes(const scene& s);
// Throws `error` where the bytes end early.
[[nodiscard]] scene scene_from_bytes(const std::string& bytes);

} // namespace ao::tools
