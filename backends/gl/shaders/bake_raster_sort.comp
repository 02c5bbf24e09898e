#version 450
#extension GL_GOOGLE_include_directive : require
#define AO_COHERENT coherent
#include "bake.glsl"
#include "ao/shared/bake_raster_sort.glsl"

void main()
{
    ao_bake_main(ao_launch);
}
