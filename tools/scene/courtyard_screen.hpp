#pragma once

#include "mesh_builder.hpp"

namespace ao::tools::parts {

// A wall across the court with a doorway and an opening, a coping on it, and the objects "box" at its foot, "door" and "fan".
void screen(mesh_builder& m, scene& s);

} // namespace ao::tools::parts
