#pragma once

#include "scene.hpp"

namespace ao::tools {

// Any format that Assimp reads, nodes transformed to world space, one object per node and mesh. Polygons become
// triangles; points and lines are left out. Normals are the model's own; a mesh without them, and a vertex whose own
// normal has no length, gets those of its faces (split where faces differ).
// Assimp works in a child process, so that a file on which it crashes or never ends is one more error.
// Throws `error` for a file that is missing, empty, not a regular file, or unreadable to Assimp, and as `check` does.
[[nodiscard]] scene load_model(const std::string& path);

} // namespace ao::tools
