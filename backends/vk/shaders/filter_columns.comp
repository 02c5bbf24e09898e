#version 450
#extension GL_GOOGLE_include_directive : require
#define AO_TARGET AO_OUTPUT
#ifdef AO_SOFTWARE
#define AO_STORED_SOURCE rg32f
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
        imageStore(target, pixel, vec4(ao_filter_columns_pass(constants, pixel)));
    }
}
