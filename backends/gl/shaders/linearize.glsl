// Resources and options of the pass that turns stored depth into eye depth.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 0) const bool ao_affine = false;
layout(constant_id = 8) const bool ao_from_position = false;

layout(std140, binding = 0) uniform ao_constants_block { ao_depth_decode ao_constants; };
layout(binding = 0) uniform sampler2D ao_stored_depth;

real ao_load_stored_depth(ivec2 pixel)
{
    vec4 texel = texelFetch(ao_stored_depth, pixel, 0);
    return ao_from_position ? texel.z : texel.x;
}

#include "ao/shared/linearize_pass.h"

vec4 ao_texel(ivec2 pixel)
{
    return vec4(ao_linearize_pass(ao_constants, pixel));
}
