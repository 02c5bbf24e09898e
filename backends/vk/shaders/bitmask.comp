#version 450
#extension GL_GOOGLE_include_directive : require
#define AO_TARGET AO_OUTPUT
#ifdef AO_SOFTWARE
#extension GL_EXT_control_flow_attributes : require
#define AO_UNROLL [[unroll]]
#define AO_STORED_SOURCE r32f
#endif
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"
#include "resources.glsl"
#include "ao/shared/normal_pass.h"
#include "ao/shared/occlusion_constants.h"
#include "ao/shared/slice_taps.h"
#include "ao/shared/bitmask_pass.h"

layout(push_constant) uniform pass_constants { ao_occlusion_constants constants; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (in_picture(pixel)) {
#if defined(AO_PACKED) && defined(AO_BENT)
        imageStore(target, pixel, ao_bitmask_bent_packed_pass(constants, pixel));
#elif defined(AO_BENT)
        imageStore(target, pixel, ao_bitmask_bent_pass(constants, pixel));
#elif defined(AO_PACKED)
        imageStore(target, pixel, vec4(ao_bitmask_packed_pass(constants, pixel), 0, 0));
#else
        imageStore(target, pixel, vec4(ao_bitmask_pass(constants, pixel).visibility));
#endif
    }
}
