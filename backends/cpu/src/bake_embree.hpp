// Rays of a bake by Embree: packets of 16 directions of a vertex, neighbours on the sphere.
#pragma once

#include "bake_rays.hpp"

namespace ao::cpu::detail {

// errc::device, errc::out_of_memory from Embree; errc::unsupported_format for one-sided occluders.
make_bake_shooter embree_shooter();

} // namespace ao::cpu::detail
