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

// Of the route `cube`. Real: float.
template <class Real>
struct bake_cube_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/vector.h"

#include "ao/shared/bake_cube.h"
};

// Resources: Box box<Box>(int node), vec3 corner(int triangle, int k); uniform over lanes.
template <class Real, class Resources>
struct bake_trace_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/vector.h"

#include "ao/shared/bake_ray.h"

#include "ao/shared/bake_box.h"

    Resources resources;
    bool ao_front_only = false;
    bool ao_find_nearest = false;

    ao_bake_box ao_load_box(int node)
    {
        return resources.template box<ao_bake_box>(node);
    }
    vec3 ao_load_corner(int triangle, int k)
    {
        return resources.corner(triangle, k);
    }

#include "ao/shared/bake_trace.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"
