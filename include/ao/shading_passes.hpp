// The bodies of the shading passes over a Resources type, as in ao/passes.hpp. Real is float or double: pixels differ in
// control flow, so there is no version of them for lanes.
#pragma once

#include "ao/math.hpp"

#include <type_traits>

#include "ao/detail/shared_begin.inc"

namespace ao {

// Resources: vec4 geometry, normal, surface, frame (ivec2), uvec2 ids(ivec2), real visibility(ivec2), vec3 bent_normal(ivec2),
// vec4 target(int, ivec2), uint word(uint) of the table, uint texel(uint) of the heap, void count_clamped(uint).
template <class Real, class Resources>
struct shading_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"
    static_assert(std::is_same_v<mask, bool>);

    Resources resources;
    bool ao_stored_position = false;
    bool ao_parallel = false;
    int ao_normal_source = 0;
    bool ao_use_visibility = false;
    bool ao_use_maps = false;
    bool ao_use_reflections = false;
    bool ao_use_frames = false;
    bool ao_use_blends = false;
    bool ao_use_bent_normal = false;
    bool ao_use_bounces = false;

    constexpr vec4 ao_load_geometry(ivec2 pixel)
    {
        return resources.geometry(pixel);
    }
    constexpr vec4 ao_load_normal(ivec2 pixel)
    {
        return resources.normal(pixel);
    }
    constexpr vec4 ao_load_surface(ivec2 pixel)
    {
        return resources.surface(pixel);
    }
    constexpr vec4 ao_load_frame(ivec2 pixel)
    {
        return resources.frame(pixel);
    }
    constexpr uvec2 ao_load_ids(ivec2 pixel)
    {
        return resources.ids(pixel);
    }
    constexpr real ao_load_visibility(ivec2 pixel)
    {
        return resources.visibility(pixel);
    }
    constexpr vec3 ao_load_bent_normal(ivec2 pixel)
    {
        return resources.bent_normal(pixel);
    }
    constexpr vec4 ao_load_target(int target, ivec2 pixel)
    {
        return resources.target(target, pixel);
    }
    constexpr uint ao_load_word(uint index)
    {
        return resources.word(index);
    }
    constexpr uint ao_load_texel(uint index)
    {
        return resources.texel(index);
    }
    constexpr void ao_count_clamped(uint count)
    {
        resources.count_clamped(count);
    }

#include "ao/shared/shade_pass.h"
#include "ao/shared/shade_tables.h"
#include "ao/shared/texture.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"
