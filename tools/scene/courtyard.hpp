#pragma once

#include "camera.hpp"
#include "motion.hpp"

namespace ao::tools {

// The bundled scene, in metres, Y up, made anew by each call and always the same: a paved court of 20 x 20 with an
// arcade and barrel vault on the left, a pergola with ivy on the right, steps to a railed terrace at the back, crates,
// a fountain, and through the gate a wall 40 away. No object touches another with a coplanar face.
// `animated`: and left of the fountain a screen wall with what moves: the objects "box", "door" and "fan".
[[nodiscard]] scene courtyard(bool animated = false);

// A view that has all of it.
[[nodiscard]] camera courtyard_camera();
// Another one, of the screen wall from near.
[[nodiscard]] camera courtyard_other_camera();

// The box slides along the screen, the door swings and the fan turns; in frame 0 all are at rest. Precondition:
// courtyard(true).
[[nodiscard]] std::vector<motion::moving_object> courtyard_motion(const scene& s);

} // namespace ao::tools
