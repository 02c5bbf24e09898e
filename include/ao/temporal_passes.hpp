// The bodies of the temporal passes over a Resources type, as in ao/passes.hpp.
#pragma once

#include "ao/math.hpp"
#include "ao/passes.hpp"

#include "ao/detail/shared_begin.inc"

namespace ao {

// Resources: real depth(ivec2), vec4 normal(ivec2), vec4 motion(ivec2), uvec4 history(uint), vec2 rotation(ivec2), vec4
// tap(uint); and, where they are faster, real own_depth(ivec2) and std::array<uvec4, 4> history_row(uint, uint, uint, uint).
template <class Real, class Resources>
struct temporal_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"
#include "ao/shared/history_row.h"

    Resources resources;
    int ao_most_samples = 0;
    int ao_contribution = 0;
    int ao_history_format = 0;
    int ao_invalidation = 0;
    bool ao_reproject = false;
    bool ao_use_motion = false;
    bool ao_cubic = false;
    int ao_normal_source = 0;
    bool ao_rotate_normals = false;
    bool ao_parallel = false;
    bool ao_limit_thickness = false;
    int ao_slice_taps = 1;

    constexpr real ao_load_depth(ivec2 pixel)
    {
        return resources.depth(pixel);
    }
    constexpr real ao_load_own_depth(ivec2 pixel)
    {
        if constexpr (requires { resources.own_depth(pixel); }) {
            return resources.own_depth(pixel);
        }
        else {
            return resources.depth(pixel);
        }
    }
    constexpr vec4 ao_load_normal(ivec2 pixel)
    {
        return resources.normal(pixel);
    }
    constexpr vec4 ao_load_motion(ivec2 pixel)
    {
        return resources.motion(pixel);
    }
    constexpr uvec4 ao_load_history(uint pixel)
    {
        return resources.history(pixel);
    }
    constexpr ao_history_row ao_load_history_row(uint first, uint second, uint third, uint fourth)
    {
        if constexpr (requires { resources.history_row(first, second, third, fourth); }) {
            const auto row = resources.history_row(first, second, third, fourth);
            return { row[0], row[1], row[2], row[3] };
        }
        else {
            return { resources.history(first), resources.history(second), resources.history(third), resources.history(fourth) };
        }
    }
    constexpr vec2 ao_load_rotation(ivec2 pixel)
    {
        return resources.rotation(pixel);
    }
    constexpr vec4 ao_load_tap(uint index)
    {
        return resources.tap(index);
    }

    // clang-format off
#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_tap.h"
#include "ao/shared/slice_taps.h"
#include "ao/shared/history_load.h"
#include "ao/shared/temporal_pass.h"
    // clang-format on
};

// Resources: real depth(ivec2), uvec4 history(uint), real row(ivec2).
template <class Real, class Resources>
struct temporal_filter_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

    Resources resources;
    int ao_filter_radius = 0;
    int ao_history_format = 0;
    bool ao_parallel = false;

    constexpr real ao_load_depth(ivec2 pixel)
    {
        return resources.depth(pixel);
    }
    constexpr uvec4 ao_load_history(uint pixel)
    {
        return resources.history(pixel);
    }
    constexpr real ao_load_row(ivec2 pixel)
    {
        return resources.row(pixel);
    }

#include "ao/shared/history_load.h"
#include "ao/shared/temporal_filter_pass.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"
