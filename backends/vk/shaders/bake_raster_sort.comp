#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#define AO_COHERENT coherent
#include "bake.glsl"
#include "ao/shared/bake_raster_sort.glsl"

void main() { ao_bake_main(launch); }
