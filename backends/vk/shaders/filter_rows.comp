#version 450
#extension GL_GOOGLE_include_directive : require
#define AO_TARGET rg32f
#ifdef AO_SOFTWARE
#define AO_STORED_SOURCE r32f
#endif
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"
#include "resources.glsl"
#include "ao/shared/filter_pass.h"

layout(push_constant) uniform pass_constants { ao_filter_constants constants; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (in_picture(pixel)) {
        imageStore(target, pixel, vec4(ao_filter_rows_pass(constants, pixel), 0, 0));
    }
}
