// Of the route `raster`: the launch's triangles over the starts. An invocation takes a triangle along a line; rows of groups are
// lines. Triangles over many cells are taken by their whole group, one after another.
//     void ao_or_word(uint i, uint bits)      atomic
//     void ao_least_word(uint i, uint word)   atomic minimum
#include "ao/shared/bake_raster.glsl"

const uint ao_large = 256u; // cells

struct ao_bake_cover {
    ao_bake_point a;
    ao_bake_point b;
    ao_bake_point c;
    uint object;
    uint first_column;
    uint last_column;
    uint first_row;
    uint last_row;
};

shared uint ao_large_count;
shared uint ao_large_triangles[gl_WorkGroupSize.x];

ao_bake_point ao_seen_point(uint i)
{
    vec4 stored = ao_load_seen(i);
    ao_bake_point seen = { stored.x, stored.y, stored.z };
    return seen;
}

ao_bake_cover ao_cover_of(ao_bake_launch launch, ao_bake_grid grid, uint row, uint triangle)
{
    uvec4 t = ao_load_triangle(triangle);
    uint points = row * launch.pitch;
    ao_bake_point a = ao_seen_point(points + t.x);
    ao_bake_point b = ao_seen_point(points + t.y);
    ao_bake_point c = ao_seen_point(points + t.z);
    ao_bake_cover cover = { a,
                            b,
                            c,
                            t.w,
                            ao_column(launch, grid, min(min(a.u, b.u), c.u)),
                            ao_column(launch, grid, max(max(a.u, b.u), c.u)),
                            ao_row(launch, grid, min(min(a.w, b.w), c.w)),
                            ao_row(launch, grid, max(max(a.w, b.w), c.w)) };
    return cover;
}

void ao_take(ao_bake_launch launch, uint row, ao_bake_cover cover, vec4 stored)
{
    ao_bake_point start = { stored.x, stored.y, stored.z };
    uint what = floatBitsToUint(stored.w);
    uint vertex = what >> 2;
    ao_bake_rays rays = { bvec2((what & 1u) != 0u, (what & 2u) != 0u), vec2(ao_no_occluder) };
    ao_meet(rays, ao_bake_crossing_of(start, cover.a, cover.b, cover.c), launch.reach);
    bvec2 met = lessThan(rays.distance, vec2(ao_no_occluder));
    if (any(met) && (ao_occluders == 0 || ao_occludes(cover.object, ao_receiver(launch.first_vertex + vertex).object))) {
        if (ao_falloff == 0) {
            uint bits = (met.x ? 1u : 0u) | (met.y ? 2u : 0u);
            ao_or_word(vertex * launch.words + row / 16u, bits << (2u * (row % 16u)));
        }
        else {
            // Floats that are not negative keep their order as bits.
            uint at = 2u * (vertex * ao_block_lines(launch) + row);
            ao_least_word(at, floatBitsToUint(rays.distance.x));
            ao_least_word(at + 1u, floatBitsToUint(rays.distance.y));
        }
    }
}

void ao_bake_main(ao_bake_launch launch)
{
    uint row = launch.first_row + gl_WorkGroupID.y;
    ao_bake_grid grid = ao_grid_of(launch, ao_stored_line(launch.first_line + row));
    uint cells = ao_cells_at(launch, row);
    uint samples = ao_samples_at(launch, row);
    if (gl_LocalInvocationID.x == 0u) {
        ao_large_count = 0u;
    }
    barrier();
    uint triangle = launch.first_triangle + gl_GlobalInvocationID.x;
    if (triangle < launch.last_triangle) {
        ao_bake_cover cover = ao_cover_of(launch, grid, row, triangle);
        uint rows = cover.last_row - cover.first_row + 1u;
        if (rows * (cover.last_column - cover.first_column + 1u) > ao_large) {
            ao_large_triangles[atomicAdd(ao_large_count, 1u)] = triangle;
            rows = 0u;
        }
        uint from = cells + cover.first_row * launch.columns;
        for (uint i = 0u; i < rows; ++i) {
            uint begin = ao_load_word(from + cover.first_column);
            uint end = ao_load_word(from + cover.last_column + 1u);
            for (uint k = begin; k < end; ++k) {
                ao_take(launch, row, cover, ao_load_seen(samples + k));
            }
            from += launch.columns;
        }
    }
    barrier();
    for (uint i = 0u; i < ao_large_count; ++i) {
        ao_bake_cover cover = ao_cover_of(launch, grid, row, ao_large_triangles[i]);
        uint begin = ao_load_word(cells + cover.first_row * launch.columns + cover.first_column);
        uint end = ao_load_word(cells + cover.last_row * launch.columns + cover.last_column + 1u);
        for (uint k = begin + gl_LocalInvocationID.x; k < end; k += gl_WorkGroupSize.x) {
            ao_take(launch, row, cover, ao_load_seen(samples + k));
        }
    }
}
