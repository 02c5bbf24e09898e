// The courtyard's G-buffer in the pictures that a plan with linear depth reads.
#pragma once

#include "ao/picture.hpp"
#include "ao/plan.hpp"

namespace ao::bench {

struct input {
    ao::facts facts;
    ao::camera camera;
    picture depth;
    picture normal;
};

// Traced anew by each call.
input courtyard_input(int width, int height);

} // namespace ao::bench
