// What the GPU routes of ambient occlusion per vertex have in common: options, tables and sums. The API's shader says first how
// tables are loaded; `launch` is a block of ao_bake_launch. Behaviour: ao/conformance/bake_reference.hpp.
//     uvec4 ao_load_vertex(uint i)      two a vertex: start and object, normal and whether it is baked (floats as bits)
//     uvec4 ao_load_triangle(uint i)    points, object
//     vec4 ao_load_point(uint i)
//     vec4 ao_load_line(uint i)         three a line
//     vec4 ao_load_rotation(uint i)     three a vertex
//     void ao_add(uint i, int value)    to word i of the sums, eight a vertex
// bake_settings and bake_job, in the order of ao/detail/bake_gpu.hpp.
layout(constant_id = 0) const int ao_falloff = 0;
layout(constant_id = 1) const bool ao_by_cosine = false;
layout(constant_id = 2) const bool ao_bent_normals = false;
layout(constant_id = 3) const bool ao_front_only = false;
layout(constant_id = 4) const int ao_occluders = 0;
layout(constant_id = 5) const bool ao_has_ground = false;
layout(constant_id = 6) const bool ao_turned = false;
layout(local_size_x_id = 7) in;

struct ao_bake_launch {
    uint first_vertex;
    uint last_vertex;
    uint first_line;
    uint last_line;
    uint first_triangle;
    uint last_triangle;
    uint base_vertex; // of the sums and rotations
    uint points;
    vec4 ground;
    real reach;
    uint words;     // of a vertex: bits of 16 lines each
    uint first_row; // among the lines whose points are kept
    uint pitch;     // texels of such a line
    vec4 box;       // half the mesh's, xyz
    uint columns;   // of the raster's grid
    uint rows;
    uint reserved;
    uint more_reserved;
};

const real ao_no_occluder = real(1e30); // farther than any

struct ao_bake_receiver {
    vec3 start;
    vec3 normal;
    uint object;
    bool baked;
};

ao_bake_receiver ao_receiver(uint vertex)
{
    uvec4 start = ao_load_vertex(2u * vertex);
    uvec4 normal = ao_load_vertex(2u * vertex + 1u);
    ao_bake_receiver receiver = { uintBitsToFloat(start.xyz), uintBitsToFloat(normal.xyz), start.w, normal.w != 0u };
    return receiver;
}

ao_bake_line ao_stored_line(uint i)
{
    vec4 u = ao_load_line(3u * i);
    vec4 w = ao_load_line(3u * i + 1u);
    vec4 d = ao_load_line(3u * i + 2u);
    ao_bake_line line = { u.x, u.y, u.z, u.w, w.x, w.y, w.z, w.w, d.x, d.y, d.z, d.w };
    return line;
}

// `place` of the vertex among the rotations.
ao_bake_line ao_line_at(uint i, uint place)
{
    ao_bake_line line = ao_stored_line(i);
    if (ao_turned) {
        vec4 x = ao_load_rotation(3u * place);
        vec4 y = ao_load_rotation(3u * place + 1u);
        vec4 z = ao_load_rotation(3u * place + 2u);
        ao_rotation turn = { x.x, x.y, x.z, x.w, y.x, y.y, y.z, y.w, z.x, z.y, z.z, z.w };
        line = ao_bake_turned(turn, line);
    }
    return line;
}

bool ao_occludes(uint object, uint own)
{
    return ao_occluders == 0 || (ao_occluders == 1) == (object == own);
}

// The two rays of a vertex along a line: x along d, y along -d.
struct ao_bake_rays {
    bvec2 wanted;  // and not known yet
    vec2 distance; // to the nearest occluder; 0 for any where there is no fall-off
};

ao_bake_rays ao_rays(ao_bake_line line, real cosine, bool baked)
{
    ao_bake_rays rays = { bvec2(baked && cosine >= real(0), baked && line.opposite > real(0) && cosine <= real(0)),
                          vec2(ao_no_occluder) };
    return rays;
}

void ao_meet(inout ao_bake_rays rays, ao_bake_crossing crossing, real reach)
{
    bool ahead = rays.wanted.x && ao_bake_ahead(crossing, reach) && (!ao_front_only || crossing.turned);
    bool behind = rays.wanted.y && ao_bake_behind(crossing, reach) && (!ao_front_only || !crossing.turned);
    if (ao_falloff == 0) {
        rays.distance = mix(rays.distance, vec2(0.0), bvec2(ahead, behind));
        rays.wanted = bvec2(rays.wanted.x && !ahead, rays.wanted.y && !behind);
    }
    else if (ahead || behind) {
        real distance = ao_bake_distance(crossing);
        rays.distance = mix(rays.distance, min(rays.distance, vec2(distance)), bvec2(ahead, behind));
    }
}

void ao_meet_ground(inout ao_bake_rays rays, vec4 ground, ao_bake_line line, vec3 start, real reach)
{
    if (ao_has_ground) {
        vec2 distance = vec2(ao_bake_ground(ground, line, start, real(1)), ao_bake_ground(ground, line, start, real(-1)));
        bvec2 meets = bvec2(distance.x >= real(0) && distance.x <= reach, distance.y >= real(0) && distance.y <= reach);
        rays.distance = mix(rays.distance, min(rays.distance, distance), meets);
    }
}

real ao_open(real distance, real reach)
{
    return distance < ao_no_occluder ? ao_bake_openness(distance, reach, ao_falloff) : real(1);
}

// Of one vertex: bake_sum.
struct ao_bake_tally {
    int open;
    int all;
    int changes;
    int count;
    ivec3 bent;
    real last_cosine; // of the line before, 0 where it has no neighbour
    real last_open;
};

ao_bake_tally ao_empty_tally()
{
    ao_bake_tally tally = { 0, 0, 0, 0, ivec3(0), real(0), real(0) };
    return tally;
}

void ao_count_ray(inout ao_bake_tally tally, ao_bake_line line, real cosine, real side, real open)
{
    AO_PRECISE real towards = cosine * side;
    real weight = ao_bake_weight(line.weight, towards, ao_by_cosine);
    real part = ao_bake_part(weight, open);
    tally.all += int(weight);
    tally.open += int(part);
    tally.count += cosine != real(0) ? 1 : 0;
    if (ao_bent_normals) {
        AO_PRECISE vec3 d = vec3(line.dx * side, line.dy * side, line.dz * side);
        tally.bent += ivec3(int(ao_bake_part(part, d.x)), int(ao_bake_part(part, d.y)), int(ao_bake_part(part, d.z)));
    }
}

// Lines of a vertex in their order, from an even one on.
void ao_count_line(inout ao_bake_tally tally, uint i, ao_bake_line line, real cosine, vec2 distance, real reach)
{
    bool both = line.opposite > real(0);
    real seen = real(0);
    if (cosine >= real(0)) {
        seen = ao_open(distance.x, reach);
        ao_count_ray(tally, line, cosine, real(1), seen);
    }
    if (both && cosine <= real(0)) {
        seen = ao_open(distance.y, reach);
        ao_count_ray(tally, line, cosine, real(-1), seen);
    }
    real counted = both || cosine > real(0) ? cosine : real(0);
    bool same_side = (tally.last_cosine > real(0) && counted > real(0)) || (tally.last_cosine < real(0) && counted < real(0));
    if (i % 2u == 1u && same_side) {
        tally.changes += int(ao_bake_change(tally.last_open, seen, counted, ao_by_cosine));
    }
    tally.last_cosine = counted;
    tally.last_open = seen;
}

// `place` of the vertex among the sums. Whole numbers: any order gives the same.
void ao_add_tally(uint place, ao_bake_tally tally)
{
    uint word = 8u * place;
    ao_add(word, tally.open);
    ao_add(word + 1u, tally.all);
    ao_add(word + 2u, tally.changes);
    ao_add(word + 3u, tally.count);
    if (ao_bent_normals) {
        ao_add(word + 4u, tally.bent.x);
        ao_add(word + 5u, tally.bent.y);
        ao_add(word + 6u, tally.bent.z);
    }
}
