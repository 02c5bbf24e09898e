// The route `brute`: an invocation for a vertex and a pair of lines goes through all triangles. Rows of groups are pairs.

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_GlobalInvocationID.x;
    uint first = launch.first_line + 2u * gl_WorkGroupID.y;
    if (vertex >= launch.last_vertex) {
        return;
    }
    ao_bake_receiver receiver = ao_receiver(vertex);
    if (!receiver.baked) {
        return;
    }
    uint place = vertex - launch.base_vertex;
    ao_bake_tally tally = ao_empty_tally();
    for (uint i = first; i < min(first + 2u, launch.last_line); ++i) {
        ao_bake_line line = ao_line_at(i, place);
        real cosine = ao_bake_cosine(line, receiver.normal);
        ao_bake_rays rays = ao_rays(line, cosine, true);
        ao_bake_point start = ao_bake_seen(line, receiver.start);
        uint t = launch.first_triangle;
        while (t < launch.last_triangle && any(rays.wanted)) {
            uvec4 triangle = ao_load_triangle(t);
            if (ao_occludes(triangle.w, receiver.object)) {
                ao_bake_point a = ao_bake_seen(line, ao_load_point(triangle.x).xyz);
                ao_bake_point b = ao_bake_seen(line, ao_load_point(triangle.y).xyz);
                ao_bake_point c = ao_bake_seen(line, ao_load_point(triangle.z).xyz);
                ao_meet(rays, ao_bake_crossing_of(start, a, b, c), launch.reach);
            }
            ++t;
        }
        ao_meet_ground(rays, launch.ground, line, receiver.start, launch.reach);
        ao_count_line(tally, i, line, cosine, rays.distance, launch.reach);
    }
    ao_add_tally(place, tally);
}
