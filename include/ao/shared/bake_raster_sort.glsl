// Of the route `raster`: clears what is to be found along a line, and sorts the starts into its cells. A group is a line's.
//     uint ao_add_word(uint i, uint n)   atomic; what it was
#include "ao/shared/bake_raster.glsl"

shared uint ao_sum_to[gl_WorkGroupSize.x];

void ao_wait_for_group()
{
    memoryBarrierBuffer();
    barrier();
}

void ao_clear(ao_bake_launch launch, uint row)
{
    uint cells = ao_cells_at(launch, row);
    for (uint i = gl_LocalInvocationID.x; i <= launch.columns * launch.rows; i += gl_WorkGroupSize.x) {
        ao_store_word(cells + i, 0u);
    }
    for (uint i = gl_LocalInvocationID.x; i < ao_block_vertices(launch); i += gl_WorkGroupSize.x) {
        if (ao_falloff != 0) {
            uint at = 2u * (i * ao_block_lines(launch) + row);
            ao_store_word(at, floatBitsToUint(ao_no_occluder));
            ao_store_word(at + 1u, floatBitsToUint(ao_no_occluder));
        }
        else if (row % 16u == 0u) {
            ao_store_word(i * launch.words + row / 16u, 0u);
        }
    }
}

// Counts of cells, each one word on, become the words where cells begin; each one word on still.
void ao_sum_cells(uint cells, uint count)
{
    uint each = (count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint local = gl_LocalInvocationID.x;
    uint first = min(local * each, count);
    uint last = min(first + each, count);
    uint sum = 0u;
    for (uint i = first; i < last; ++i) {
        sum += ao_load_word(cells + 1u + i);
    }
    ao_sum_to[local] = sum;
    barrier();
    for (uint reach = 1u; reach < gl_WorkGroupSize.x; reach *= 2u) {
        uint before = local >= reach ? ao_sum_to[local - reach] : 0u;
        barrier();
        ao_sum_to[local] += before;
        barrier();
    }
    uint begin = ao_sum_to[local] - sum;
    for (uint i = first; i < last; ++i) {
        uint here = ao_load_word(cells + 1u + i);
        ao_store_word(cells + 1u + i, begin);
        begin += here;
    }
}

void ao_bake_main(ao_bake_launch launch)
{
    uint row = launch.first_row + gl_WorkGroupID.y;
    ao_bake_line line = ao_stored_line(launch.first_line + row);
    ao_bake_grid grid = ao_grid_of(launch, line);
    uint cells = ao_cells_at(launch, row);
    ao_clear(launch, row);
    ao_wait_for_group();
    // First they are counted, then placed, which moves the beginnings of cells on to their ends: those of the next.
    for (int turn = 0; turn < 2; ++turn) {
        for (uint i = gl_LocalInvocationID.x; i < ao_block_vertices(launch); i += gl_WorkGroupSize.x) {
            ao_bake_receiver receiver = ao_receiver(launch.first_vertex + i);
            ao_bake_rays rays = ao_rays(line, ao_bake_cosine(line, receiver.normal), receiver.baked);
            if (any(rays.wanted)) {
                ao_bake_point start = ao_bake_seen(line, receiver.start);
                uint cell = ao_row(launch, grid, start.w) * launch.columns + ao_column(launch, grid, start.u);
                uint place = ao_add_word(cells + 1u + cell, 1u);
                if (turn == 1) {
                    vec4 stored = vec4(start.u, start.w, start.d, uintBitsToFloat(ao_sample_of(i, rays.wanted)));
                    ao_store_seen(ao_samples_at(launch, row) + place, stored);
                }
            }
        }
        ao_wait_for_group();
        if (turn == 0) {
            ao_sum_cells(cells, launch.columns * launch.rows);
            ao_wait_for_group();
        }
    }
}
