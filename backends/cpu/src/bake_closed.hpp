// Where half of the triangles need not be looked at. A closed surface, seen along a line, is entered as often as it is left by
// any ray that starts outside of it: what is hit at all is hit by a triangle that is entered. docs/numerics.md, "Per vertex".
#pragma once

#include "bake_memory.hpp"

namespace ao::cpu::detail {

// Steps of the lattice that a start must lie off a closed surface for the rounding of no line to put it on the other side.
inline constexpr double bake_outside_steps = 15;

// Fills group.closed and group.apart; leaves them empty where nothing is gained. Precondition: add_corner_places.
void find_closed_surfaces(bake_group& group);

} // namespace ao::cpu::detail
