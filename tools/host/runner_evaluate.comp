#version 450
#extension GL_GOOGLE_include_directive : require
// Conformance: the shared functions over a list of inputs.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

#include "ao/shared/evaluate.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer ao_call
{
    int ao_function;
    int ao_count;
};
layout(std430, binding = 1) readonly buffer ao_first_arguments { vec4 ao_a[]; };
layout(std430, binding = 2) readonly buffer ao_second_arguments { vec4 ao_b[]; };
layout(std430, binding = 3) writeonly buffer ao_results { vec4 ao_out[]; };

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i < ao_count) {
        ao_out[i] = ao_evaluate(ao_function, ao_a[i], ao_b[i]);
    }
}
