// Of the routes `packed` and `raster`: the sums of the launch's vertices from what was found. Rows of groups are words, of 16
// lines each. With fall-off the words are distances, two a line, d then -d.
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
    uint lines = launch.last_line - launch.first_line;
    uint first = 16u * gl_WorkGroupID.y;
    uint word = ao_falloff == 0 ? ao_load_word(gl_GlobalInvocationID.x * launch.words + gl_WorkGroupID.y) : 0u;
    for (uint row = first; row < min(first + 16u, lines); ++row) {
        uint i = launch.first_line + row;
        ao_bake_line line = ao_stored_line(i);
        real cosine = ao_bake_cosine(line, receiver.normal);
        ao_bake_rays rays = ao_rays(line, cosine, true);
        if (ao_falloff == 0) {
            bvec2 blocked = bvec2((word & 1u) != 0u, (word & 2u) != 0u);
            rays.distance = mix(rays.distance, vec2(0.0), blocked);
            word >>= 2u;
        }
        else {
            uint at = 2u * (gl_GlobalInvocationID.x * lines + row);
            rays.distance = vec2(uintBitsToFloat(ao_load_word(at)), uintBitsToFloat(ao_load_word(at + 1u)));
        }
        ao_meet_ground(rays, launch.ground, line, receiver.start, launch.reach);
        ao_count_line(tally, i, line, cosine, rays.distance, launch.reach);
    }
    ao_add_tally(vertex - launch.base_vertex, tally);
}
