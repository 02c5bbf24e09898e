#pragma once

#include "camera.hpp"

namespace ao::tools {

// The bundled scene, in metres, Y up, made anew by each call and always the same: a paved court of 20 x 20 with an
// arcade and barrel vault on the left, a pergola with ivy on the right, steps to a railed terrace at the back, crates,
// a fountain, and through the gate a wall 40 away. No object touches another with a coplanar face.
[[nodiscard]] scene courtyard();

// A view that has all of it.
[[nodiscard]] camera courtyard_camera();

} // namespace ao::tools
