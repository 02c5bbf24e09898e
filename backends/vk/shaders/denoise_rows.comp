#version 450
#extension GL_GOOGLE_include_directive : require
#ifdef AO_BENT
#define AO_PACKED_FORMAT rgba32f
#else
#define AO_PACKED_FORMAT rg32f
#endif
#define AO_TARGET AO_PACKED_FORMAT
#define AO_DEPTH_IN_Y
#ifdef AO_SOFTWARE
#define AO_STORED_SOURCE AO_PACKED_FORMAT
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
        imageStore(target, pixel, ao_denoise_rows_bent_pass(constants, pixel));
#else
        imageStore(target, pixel, vec4(ao_denoise_rows_pass(constants, pixel), 0, 0));
#endif
    }
}
