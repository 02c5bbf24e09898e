#version 450
#extension GL_GOOGLE_include_directive : require
#include "denoise_columns.glsl"

layout(location = 0) out vec4 ao_picture;

void main()
{
    ao_picture = ao_texel(ivec2(gl_FragCoord));
}
