// Resources of the bake's passes. AO_HIERARCHY: there is a tree of boxes instead of points as seen.
// AO_COHERENT: what invocations of a group write, the others read.
#ifndef AO_COHERENT
#define AO_COHERENT
#endif
#include "ao/shared/prelude.glsl"
#include "ao/shared/vector.h"
#include "ao/shared/bake_ray.h"
#include "ao/shared/bake_weight.h"

// Buffer textures where they are only read: llvmpipe reads storage buffers word by word.
layout(binding = 0) uniform usamplerBuffer ao_vertices;
layout(binding = 1) uniform usamplerBuffer ao_triangles;
layout(binding = 2) uniform samplerBuffer ao_points;
layout(binding = 3) uniform samplerBuffer ao_lines;
layout(binding = 4) uniform samplerBuffer ao_rotations;
#ifdef AO_HIERARCHY
layout(binding = 5) uniform usamplerBuffer ao_nodes;

uvec4 ao_load_node(uint i)
{
    return texelFetch(ao_nodes, int(i));
}
#else
layout(binding = 5) uniform samplerBuffer ao_seen_points;

vec4 ao_load_seen(uint i)
{
    return texelFetch(ao_seen_points, int(i));
}
#endif

layout(std430, binding = 0) buffer ao_sums_block { int ao_sums[]; };
layout(std430, binding = 1) AO_COHERENT buffer ao_words_block { uint ao_words[]; };
layout(std430, binding = 2) writeonly buffer ao_seen_block { vec4 ao_seen_stored[]; };

uvec4 ao_load_vertex(uint i)
{
    return texelFetch(ao_vertices, int(i));
}

uvec4 ao_load_triangle(uint i)
{
    return texelFetch(ao_triangles, int(i));
}

vec4 ao_load_point(uint i)
{
    return texelFetch(ao_points, int(i));
}

vec4 ao_load_line(uint i)
{
    return texelFetch(ao_lines, int(i));
}

vec4 ao_load_rotation(uint i)
{
    return texelFetch(ao_rotations, int(i));
}

void ao_add(uint i, int value)
{
    atomicAdd(ao_sums[i], value);
}

void ao_store_seen(uint i, vec4 seen)
{
    ao_seen_stored[i] = seen;
}

uint ao_load_word(uint i)
{
    return ao_words[i];
}

void ao_store_word(uint i, uint word)
{
    ao_words[i] = word;
}

uint ao_add_word(uint i, uint n)
{
    return atomicAdd(ao_words[i], n);
}

void ao_or_word(uint i, uint bits)
{
    atomicOr(ao_words[i], bits);
}

void ao_least_word(uint i, uint word)
{
    atomicMin(ao_words[i], word);
}

#include "ao/shared/bake_gpu.glsl"

layout(std140, binding = 0) uniform ao_launch_block { ao_bake_launch ao_launch; };
