// The route `tiled`: as `brute`, but a group's triangles pass through its shared memory, projected once for all its vertices
// where they share the line. Every invocation goes all the way, for the barriers.

// Corners as seen along the line, or as they are where every vertex has its own line.
shared vec4 ao_tile[3u * gl_WorkGroupSize.x];
shared uint ao_tile_objects[gl_WorkGroupSize.x];
shared uint ao_alive[2]; // whether any ray goes on, by turns

vec4 ao_tile_corner(ao_bake_line line, uint point)
{
    vec4 p = ao_load_point(point);
    if (ao_turned) {
        return p;
    }
    ao_bake_point seen = ao_bake_seen(line, p.xyz);
    return vec4(seen.u, seen.w, seen.d, 0.0);
}

ao_bake_point ao_corner_of_tile(ao_bake_line line, uint i)
{
    vec4 p = ao_tile[i];
    if (ao_turned) {
        return ao_bake_seen(line, p.xyz);
    }
    ao_bake_point seen = { p.x, p.y, p.z };
    return seen;
}

void ao_fill_tile(ao_bake_line line, uint triangle, uint last)
{
    uint slot = gl_LocalInvocationID.x;
    if (triangle < last) {
        uvec4 t = ao_load_triangle(triangle);
        ao_tile[3u * slot] = ao_tile_corner(line, t.x);
        ao_tile[3u * slot + 1u] = ao_tile_corner(line, t.y);
        ao_tile[3u * slot + 2u] = ao_tile_corner(line, t.z);
        ao_tile_objects[slot] = t.w;
    }
}

ao_bake_rays ao_rays_through_tiles(ao_bake_launch launch, ao_bake_line line, ao_bake_receiver receiver, ao_bake_rays rays)
{
    uint local = gl_LocalInvocationID.x;
    ao_bake_point start = ao_bake_seen(line, receiver.start);
    barrier();
    if (local == 0u) {
        ao_alive[0] = 0u;
    }
    barrier();
    uint turn = 0u;
    for (uint first = launch.first_triangle; first < launch.last_triangle; first += gl_WorkGroupSize.x) {
        if (any(rays.wanted)) {
            ao_alive[turn] = 1u;
        }
        if (local == 0u) {
            ao_alive[1u - turn] = 0u;
        }
        ao_fill_tile(line, first + local, launch.last_triangle);
        barrier();
        if (ao_alive[turn] == 0u) {
            break;
        }
        uint count = min(gl_WorkGroupSize.x, launch.last_triangle - first);
        uint i = 0u;
        while (i < count && any(rays.wanted)) {
            if (ao_occludes(ao_tile_objects[i], receiver.object)) {
                ao_bake_point a = ao_corner_of_tile(line, 3u * i);
                ao_bake_point b = ao_corner_of_tile(line, 3u * i + 1u);
                ao_bake_point c = ao_corner_of_tile(line, 3u * i + 2u);
                ao_meet(rays, ao_bake_crossing_of(start, a, b, c), launch.reach);
            }
            ++i;
        }
        barrier();
        turn = 1u - turn;
    }
    return rays;
}

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_GlobalInvocationID.x;
    uint first = launch.first_line + 2u * gl_WorkGroupID.y;
    ao_bake_receiver receiver = ao_receiver(min(vertex, launch.last_vertex - 1u));
    receiver.baked = receiver.baked && vertex < launch.last_vertex;
    uint place = min(vertex, launch.last_vertex - 1u) - launch.base_vertex;
    ao_bake_tally tally = ao_empty_tally();
    for (uint i = first; i < min(first + 2u, launch.last_line); ++i) {
        ao_bake_line line = ao_line_at(i, place);
        real cosine = ao_bake_cosine(line, receiver.normal);
        ao_bake_rays rays = ao_rays_through_tiles(launch, line, receiver, ao_rays(line, cosine, receiver.baked));
        ao_meet_ground(rays, launch.ground, line, receiver.start, launch.reach);
        ao_count_line(tally, i, line, cosine, rays.distance, launch.reach);
    }
    if (receiver.baked) {
        ao_add_tally(place, tally);
    }
}
