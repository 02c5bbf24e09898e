// Resources and options of the occlusion pass.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 1) const int ao_tap_count = 32;
layout(constant_id = 2) const int ao_normal_source = 0;
layout(constant_id = 3) const bool ao_rotate_normals = false;
layout(constant_id = 4) const bool ao_parallel = false;
layout(constant_id = 5) const bool ao_limit_thickness = false;
layout(constant_id = 6) const bool ao_mark_background = false;

#include "occlusion_resources.glsl"
#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_tap.h"
#include "ao/shared/occlusion_constants.h"
#include "ao/shared/occlusion_pass.h"

layout(std140, binding = 0) uniform ao_constants_block { ao_occlusion_constants ao_constants; };

vec4 ao_texel(ivec2 pixel)
{
    return vec4(ao_occlusion_pass(ao_constants, pixel));
}
