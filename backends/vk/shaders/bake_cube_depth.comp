#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "bake.glsl"
#include "ao/shared/bake_cube_depth.glsl"

void main() { ao_bake_main(launch); }
