// The body of the geometry pass per fragment over a Resources type, as in ao/passes.hpp. Real is float or double: fragments
// differ in control flow.
#pragma once

#include "ao/math.hpp"

#include <type_traits>

#include "ao/detail/shared_begin.inc"

namespace ao {

// Resources: uint texel(uint) of the heap; ao_geometry_material (of math<Real>) material(uint).
template <class Real, class Resources>
struct geometry_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"
    static_assert(std::is_same_v<mask, bool>);

    Resources resources;
    bool ao_use_alpha_map = false;
    bool ao_use_normal_map = false;
    int ao_normal_encoding = 0;

    constexpr uint ao_load_texel(uint index)
    {
        return resources.texel(index);
    }
    constexpr ao_geometry_material ao_load_material(uint index)
    {
        const auto m = resources.material(index);
        return { m.scale, m.footprint, m.cutoff, m.alpha_map, m.alpha_from_red, m.normal_map, m.green };
    }

#include "ao/shared/texture.h"

    constexpr vec4 ao_load_alpha_map(ao_geometry_material m, ao_map_place place)
    {
        return ao_sample(m.alpha_map, place.uv, place.footprint);
    }
    constexpr vec4 ao_load_normal_map(ao_geometry_material m, ao_map_place place)
    {
        return ao_sample(m.normal_map, place.uv, place.footprint);
    }

#include "ao/shared/geometry_pass.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"
