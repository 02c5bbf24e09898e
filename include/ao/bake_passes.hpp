// The shared bodies of ambient occlusion per vertex for one Real type, float or lanes of floats.
#pragma once

#include "ao/math.hpp"

#include "ao/detail/shared_begin.inc"

namespace ao {

template <class Real>
struct bake_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/vector.h"

#include "ao/shared/bake_ray.h"

#include "ao/shared/bake_weight.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"
