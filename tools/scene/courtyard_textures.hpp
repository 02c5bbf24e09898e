#pragma once

#include "scene.hpp"

namespace ao::tools::courtyard_textures {

// All of them are made with integers alone, so they have the same bytes on every machine. All but the leaf tile.

// A leaf, its stem below, its tip on top; alpha cuts it out of the rhombus between the middles of the picture's edges.
[[nodiscard]] scene_texture leaf();

// Four by four slabs of stone, joints along the picture's edges, and how they are chiselled.
[[nodiscard]] scene_texture paving();
[[nodiscard]] scene_texture paving_normals();

// Grit in tar, some of it bright.
[[nodiscard]] scene_texture asphalt();
[[nodiscard]] scene_texture asphalt_normals();

[[nodiscard]] scene_texture snow();

// Where snow lies: 0 nowhere, 1 wholly; soft drifts, half of the area or so.
[[nodiscard]] scene_texture drifts();

} // namespace ao::tools::courtyard_textures
