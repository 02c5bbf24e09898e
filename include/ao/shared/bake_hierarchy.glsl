// The route `hierarchy`: an invocation sends the rays of a vertex along a pair of lines through the tree of boxes. Groups are of
// one vertex, whose lines are sorted, so that its rays go the same ways; rows of groups are vertices.
//     uvec4 ao_load_node(uint i)        two a node: low and first, high and count (floats as bits)
#include "ao/shared/bake_box.h"

const bool ao_find_nearest = ao_falloff != 0;

shared int ao_group_sums[7];
uint ao_own_object;

ao_bake_box ao_load_box(int node)
{
    uvec4 low = ao_load_node(2u * uint(node));
    uvec4 high = ao_load_node(2u * uint(node) + 1u);
    ao_bake_box box = { uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), int(low.w), int(high.w) };
    return box;
}

// Of triangles that do not occlude the vertex all corners are one point, which no ray meets.
vec3 ao_load_corner(int triangle, int corner)
{
    uvec4 t = ao_load_triangle(uint(triangle));
    if (!ao_occludes(t.w, ao_own_object)) {
        return vec3(0.0);
    }
    return ao_load_point(corner == 0 ? t.x : corner == 1 ? t.y : t.z).xyz;
}

#include "ao/shared/bake_trace.h"

void ao_bake_pair(ao_bake_launch launch, ao_bake_receiver receiver, uint place, uint first)
{
    ao_bake_tally tally = ao_empty_tally();
    for (uint i = first; i < min(first + 2u, launch.last_line); ++i) {
        ao_bake_line line = ao_line_at(i, place);
        real cosine = ao_bake_cosine(line, receiver.normal);
        ao_bake_rays rays = ao_rays(line, cosine, true);
        // Both only in the tangent plane.
        for (int side = 0; side < 2; ++side) {
            if (side == 0 ? rays.wanted.x : rays.wanted.y) {
                real met = ao_bake_trace(line, side == 0 ? real(1) : real(-1), receiver.start, launch.reach, true);
                real distance = met >= real(0) ? met : ao_no_occluder;
                rays.distance = side == 0 ? vec2(distance, rays.distance.y) : vec2(rays.distance.x, distance);
            }
        }
        ao_meet_ground(rays, launch.ground, line, receiver.start, launch.reach);
        ao_count_line(tally, i, line, cosine, rays.distance, launch.reach);
    }
    atomicAdd(ao_group_sums[0], tally.open);
    atomicAdd(ao_group_sums[1], tally.all);
    atomicAdd(ao_group_sums[2], tally.changes);
    atomicAdd(ao_group_sums[3], tally.count);
    if (ao_bent_normals) {
        atomicAdd(ao_group_sums[4], tally.bent.x);
        atomicAdd(ao_group_sums[5], tally.bent.y);
        atomicAdd(ao_group_sums[6], tally.bent.z);
    }
}

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_WorkGroupID.y;
    uint place = vertex - launch.base_vertex;
    for (uint i = gl_LocalInvocationID.x; i < 7u; i += gl_WorkGroupSize.x) {
        ao_group_sums[i] = 0;
    }
    barrier();
    ao_bake_receiver receiver = ao_receiver(vertex);
    ao_own_object = receiver.object;
    uint first = launch.first_line + 2u * gl_GlobalInvocationID.x;
    if (receiver.baked && first < launch.last_line) {
        ao_bake_pair(launch, receiver, place, first);
    }
    barrier();
    for (uint i = gl_LocalInvocationID.x; i < 7u; i += gl_WorkGroupSize.x) {
        if (ao_group_sums[i] != 0) {
            ao_add(8u * place + i, ao_group_sums[i]);
        }
    }
}
