#version 450 core
#extension GL_GOOGLE_include_directive : require
layout(local_size_x_id = 7) in;
layout(constant_id = 3) const int taps = 32;
layout(constant_id = 4) const bool halved = true; // what a driver refuses in a comment: ö “;” [#]
layout(binding = 0, r32f) uniform writeonly image2D out_image;
#include "once.glsl"
#include "nested.h"
#include "nested.h"
void main()
{
    imageStore(out_image, ivec2(gl_GlobalInvocationID.xy),
               vec4(float(twice(taps) + nested) * (halved ? 0.5 : 1.0) + float(gl_GlobalInvocationID.x)));
}
