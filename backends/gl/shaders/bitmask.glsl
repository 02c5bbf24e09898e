// Resources and options of the bitmask pass.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 1) const int ao_tap_count = 4;
layout(constant_id = 2) const int ao_normal_source = 0;
layout(constant_id = 3) const bool ao_rotate_normals = false;
layout(constant_id = 4) const bool ao_parallel = false;
layout(constant_id = 6) const bool ao_mark_background = false;
layout(constant_id = 11) const int ao_slice_count = 1;
layout(constant_id = 12) const bool ao_coarse = false;

#include "occlusion_resources.glsl"
#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_constants.h"
#include "ao/shared/slice_taps.h"
#include "ao/shared/bitmask_pass.h"

layout(std140, binding = 0) uniform ao_constants_block { ao_occlusion_constants ao_constants; };

vec4 ao_texel(ivec2 pixel)
{
    if (ao_mark_background) {
        return vec4(ao_bitmask_packed_pass(ao_constants, pixel), 0.0, 0.0);
    }
    return vec4(ao_bitmask_pass(ao_constants, pixel).visibility);
}
