// The route `packed`: which rays meet any of the launch's triangles, one bit a ray; 16 lines a word, d then -d. An invocation
// makes a word of a vertex; rows of groups are words. Launches go from the first triangle on.
//     vec4 ao_load_seen(uint i)         of bake_project.glsl
//     uint ao_load_word(uint i)
//     void ao_store_word(uint i, uint word)

ao_bake_point ao_seen_point(uint i)
{
    vec4 stored = ao_load_seen(i);
    ao_bake_point seen = { stored.x, stored.y, stored.z };
    return seen;
}

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_GlobalInvocationID.x;
    if (vertex >= launch.last_vertex) {
        return;
    }
    ao_bake_receiver receiver = ao_receiver(vertex);
    uint place = gl_GlobalInvocationID.x * launch.words + gl_WorkGroupID.y;
    uint word = launch.first_triangle > 0u ? ao_load_word(place) : 0u;
    uint first_row = 16u * gl_WorkGroupID.y;
    uint rows = min(16u, launch.last_line - launch.first_line - first_row);
    for (uint j = 0u; j < rows; ++j) {
        uint row = first_row + j;
        ao_bake_line line = ao_stored_line(launch.first_line + row);
        ao_bake_rays rays = ao_rays(line, ao_bake_cosine(line, receiver.normal), receiver.baked);
        bvec2 blocked = bvec2((word >> (2u * j) & 1u) != 0u, (word >> (2u * j) & 2u) != 0u);
        rays.wanted = bvec2(rays.wanted.x && !blocked.x, rays.wanted.y && !blocked.y);
        ao_bake_point start = ao_bake_seen(line, receiver.start);
        uint base = row * launch.pitch;
        uint t = launch.first_triangle;
        while (t < launch.last_triangle && any(rays.wanted)) {
            uvec4 triangle = ao_load_triangle(t);
            if (ao_occludes(triangle.w, receiver.object)) {
                ao_bake_point a = ao_seen_point(base + triangle.x);
                ao_bake_point b = ao_seen_point(base + triangle.y);
                ao_bake_point c = ao_seen_point(base + triangle.z);
                ao_meet(rays, ao_bake_crossing_of(start, a, b, c), launch.reach);
            }
            ++t;
        }
        uint met = (rays.distance.x == real(0) ? 1u : 0u) | (rays.distance.y == real(0) ? 2u : 0u);
        word |= met << (2u * j);
    }
    ao_store_word(place, word);
}
