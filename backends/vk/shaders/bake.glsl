// Resources of the bake's passes: one descriptor set layout for all of them. AO_HIERARCHY: there is a tree of boxes instead of
// points as seen.
// AO_COHERENT: what invocations of a group write, the others read.
#ifndef AO_COHERENT
#define AO_COHERENT
#endif
#include "ao/shared/prelude.glsl"
#include "ao/shared/vector.h"
#include "ao/shared/bake_ray.h"
#include "ao/shared/bake_weight.h"

// Texels where they are only read: llvmpipe reads storage buffers word by word.
layout(binding = 0) uniform utextureBuffer vertices;
layout(binding = 1) uniform utextureBuffer triangles;
layout(binding = 2) uniform textureBuffer corners;
layout(binding = 3) uniform textureBuffer lines;
layout(binding = 4) uniform textureBuffer rotations;
#ifdef AO_HIERARCHY
layout(binding = 5) uniform utextureBuffer nodes;
uvec4 ao_load_node(uint i) { return texelFetch(nodes, int(i)); }
#else
layout(binding = 5) uniform textureBuffer seen_points;
vec4 ao_load_seen(uint i) { return texelFetch(seen_points, int(i)); }
#endif
layout(binding = 6, std430) buffer sums_block { int sums[]; };
layout(binding = 7, std430) AO_COHERENT buffer words_block { uint words[]; };
layout(binding = 8, std430) writeonly buffer seen_block { vec4 seen_stored[]; };

uvec4 ao_load_vertex(uint i) { return texelFetch(vertices, int(i)); }
uvec4 ao_load_triangle(uint i) { return texelFetch(triangles, int(i)); }
vec4 ao_load_point(uint i) { return texelFetch(corners, int(i)); }
vec4 ao_load_line(uint i) { return texelFetch(lines, int(i)); }
vec4 ao_load_rotation(uint i) { return texelFetch(rotations, int(i)); }
void ao_add(uint i, int value) { atomicAdd(sums[i], value); }
void ao_store_seen(uint i, vec4 seen) { seen_stored[i] = seen; }
uint ao_load_word(uint i) { return words[i]; }
void ao_store_word(uint i, uint word) { words[i] = word; }
uint ao_add_word(uint i, uint n) { return atomicAdd(words[i], n); }
void ao_or_word(uint i, uint bits) { atomicOr(words[i], bits); }
void ao_least_word(uint i, uint word) { atomicMin(words[i], word); }

#include "ao/shared/bake_gpu.glsl"

layout(push_constant) uniform pass_constants { ao_bake_launch launch; };
