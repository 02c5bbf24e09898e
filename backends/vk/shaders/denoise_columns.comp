#version 450
#extension GL_GOOGLE_include_directive : require
#define AO_TARGET AO_OUTPUT
#define AO_DEPTH_IN_Y
#ifdef AO_SOFTWARE
#ifdef AO_BENT
#define AO_STORED_SOURCE rgba32f
#else
#define AO_STORED_SOURCE rg32f
#endif
#endif
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"
#include "resources.glsl"
#include "ao/shared/normal_pass.h"
#include "ao/shared/denoise_pass.h"

layout(push_constant) uniform pass_constants { ao_denoise_constants constants; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (in_picture(pixel)) {
#ifdef AO_BENT
        imageStore(target, pixel, ao_denoise_columns_bent_pass(constants, pixel));
#else
        imageStore(target, pixel, vec4(ao_denoise_columns_pass(constants, pixel)));
#endif
    }
}
