// Of the route `cube`: the sums of the launch's vertices from their cube maps. An invocation takes a pair of lines; rows of groups
// are vertices.
#include "ao/shared/bake_cube.glsl"

real ao_cube_found(ao_bake_launch launch, uint vertex, vec3 direction)
{
    int texels = int(launch.columns);
    int face = ao_cube_face_of(direction);
    vec3 seen = ao_cube_seen(face, direction);
    AO_PRECISE real x = seen.x / seen.z;
    AO_PRECISE real y = seen.y / seen.z;
    int texel = (face * texels + ao_cube_texel(y, texels)) * texels + ao_cube_texel(x, texels);
    return uintBitsToFloat(ao_load_word(ao_cube_at(launch, vertex) + uint(texel)));
}

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_WorkGroupID.y;
    uint place = vertex - launch.base_vertex;
    ao_bake_receiver receiver = ao_receiver(vertex);
    uint first = launch.first_line + 2u * gl_GlobalInvocationID.x;
    if (!receiver.baked || first >= launch.last_line) {
        return;
    }
    ao_bake_tally tally = ao_empty_tally();
    for (uint i = first; i < min(first + 2u, launch.last_line); ++i) {
        ao_bake_line line = ao_line_at(i, place);
        real cosine = ao_bake_cosine(line, receiver.normal);
        ao_bake_rays rays = ao_rays(line, cosine, true);
        vec3 direction = vec3(line.dx, line.dy, line.dz);
        vec2 found = vec2(ao_cube_found(launch, vertex, direction), ao_cube_found(launch, vertex, -direction));
        rays.distance = mix(rays.distance, found, lessThanEqual(found, vec2(launch.reach)));
        ao_meet_ground(rays, launch.ground, line, receiver.start, launch.reach);
        ao_count_line(tally, i, line, cosine, rays.distance, launch.reach);
    }
    ao_add_tally(place, tally);
}
