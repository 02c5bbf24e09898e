// Of the route `packed`: the sums of the launch's vertices from their bits.
//     uint ao_load_word(uint i)

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_GlobalInvocationID.x;
    if (vertex >= launch.last_vertex) {
        return;
    }
    ao_bake_receiver receiver = ao_receiver(vertex);
    if (!receiver.baked) {
        return;
    }
    ao_bake_tally tally = ao_empty_tally();
    uint word = 0u;
    for (uint i = launch.first_line; i < launch.last_line; ++i) {
        uint row = i - launch.first_line;
        if (row % 16u == 0u) {
            word = ao_load_word(gl_GlobalInvocationID.x * launch.words + row / 16u);
        }
        ao_bake_line line = ao_stored_line(i);
        real cosine = ao_bake_cosine(line, receiver.normal);
        ao_bake_rays rays = ao_rays(line, cosine, true);
        bvec2 blocked = bvec2((word & 1u) != 0u, (word & 2u) != 0u);
        rays.distance = mix(rays.distance, vec2(0.0), blocked);
        word >>= 2u;
        ao_meet_ground(rays, launch.ground, line, receiver.start, launch.reach);
        ao_count_line(tally, i, line, cosine, rays.distance, launch.reach);
    }
    ao_add_tally(vertex - launch.base_vertex, tally);
}
