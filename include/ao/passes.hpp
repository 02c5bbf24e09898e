// The pass bodies for one Real type over a Resources type, which answers the callbacks named in each ao/shared/*_pass.h.
// A backend in C++ derives nothing: it fills in the options and calls the body per pixel, or per N pixels with lanes.
#pragma once

#include "ao/math.hpp"

#include "ao/detail/shared_begin.inc"

namespace ao {

// Answers nothing: names a pass's constants and options without a way to run it.
struct no_resources {};

// Resources: real stored_depth(ivec2).
template <class Real, class Resources>
struct linearize_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

    Resources resources;
    bool ao_affine = false;

    constexpr real ao_load_stored_depth(ivec2 pixel)
    {
        return resources.stored_depth(pixel);
    }

#include "ao/shared/linearize_pass.h"
};

// Resources: real depth(ivec2), vec4 normal(ivec2), vec2 rotation(ivec2), vec4 tap(int).
template <class Real, class Resources>
struct occlusion_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

    Resources resources;
    int ao_tap_count = 0;
    int ao_normal_source = 0;
    bool ao_rotate_normals = false;
    bool ao_parallel = false;
    bool ao_limit_thickness = false;
    bool ao_mark_background = false;

    constexpr real ao_load_depth(ivec2 pixel)
    {
        return resources.depth(pixel);
    }
    constexpr vec4 ao_load_normal(ivec2 pixel)
    {
        return resources.normal(pixel);
    }
    constexpr vec2 ao_load_rotation(ivec2 pixel)
    {
        return resources.rotation(pixel);
    }
    constexpr vec4 ao_tap(int i)
    {
        return resources.tap(i);
    }

#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_constants.h"
#include "ao/shared/occlusion_pass.h"
#include "ao/shared/occlusion_tap.h"
};

// Resources: real depth(ivec2), vec4 normal(ivec2), vec2 rotation(ivec2), vec4 tap(int).
template <class Real, class Resources>
struct bitmask_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

    Resources resources;
    int ao_tap_count = 0;
    int ao_slice_count = 1;
    int ao_normal_source = 0;
    bool ao_rotate_normals = false;
    bool ao_parallel = false;
    bool ao_mark_background = false;
    bool ao_coarse = false;

    constexpr real ao_load_depth(ivec2 pixel)
    {
        return resources.depth(pixel);
    }
    constexpr vec4 ao_load_normal(ivec2 pixel)
    {
        return resources.normal(pixel);
    }
    constexpr vec2 ao_load_rotation(ivec2 pixel)
    {
        return resources.rotation(pixel);
    }
    constexpr vec4 ao_tap(int i)
    {
        return resources.tap(i);
    }

#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_constants.h"

#include "ao/shared/slice_taps.h"

#include "ao/shared/bitmask_pass.h"
};

// Resources: vec2 packed(ivec2), real depth(ivec2), vec4 normal(ivec2).
template <class Real, class Resources>
struct denoise_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

    Resources resources;
    int ao_filter_radius = 0;
    int ao_normal_source = 0;
    bool ao_rotate_normals = false;
    bool ao_parallel = false;
    bool ao_coarse = false;

    constexpr vec2 ao_load_packed(ivec2 pixel)
    {
        return resources.packed(pixel);
    }
    constexpr real ao_load_depth(ivec2 pixel)
    {
        return resources.depth(pixel);
    }
    constexpr vec4 ao_load_normal(ivec2 pixel)
    {
        return resources.normal(pixel);
    }

#include "ao/shared/normal_pass.h"

#include "ao/shared/denoise_pass.h"
};

// Resources: real visibility(ivec2), vec2 row_sum(ivec2); each of the two passes needs one of them.
template <class Real, class Resources>
struct filter_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

    Resources resources;
    int ao_filter_radius = 0;

    constexpr real ao_load_visibility(ivec2 pixel)
    {
        return resources.visibility(pixel);
    }
    constexpr vec2 ao_load_row_sum(ivec2 pixel)
    {
        return resources.row_sum(pixel);
    }

#include "ao/shared/filter_pass.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"
