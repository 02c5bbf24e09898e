// Of the route `cube`: the launch's triangles into the cube maps. An invocation takes a triangle as seen from a vertex; rows of
// groups are vertices. What covers many texels is taken by the whole group, one after another.
//     void ao_least_word(uint i, uint word)   atomic minimum
#include "ao/shared/bake_cube.glsl"

const int ao_large = 64; // texels

struct ao_cube_cover {
    ao_cube_triangle triangle;
    ivec2 first;
    ivec2 size; // texels
};

shared uint ao_large_count;
shared uint ao_large_ones[6u * gl_WorkGroupSize.x]; // 8 triangle + face

// Faces that the triangle may be in, as bits: none of the planes that bound them has it behind.
uint ao_cube_faces(vec3 a, vec3 b, vec3 c)
{
    AO_PRECISE vec3 sums_a = a + a.yzx; // xy, yz, zx
    AO_PRECISE vec3 sums_b = b + b.yzx;
    AO_PRECISE vec3 sums_c = c + c.yzx;
    AO_PRECISE vec3 differences_a = a - a.yzx;
    AO_PRECISE vec3 differences_b = b - b.yzx;
    AO_PRECISE vec3 differences_c = c - c.yzx;
    bvec3 sum_up = greaterThanEqual(max(max(sums_a, sums_b), sums_c), vec3(0.0));
    bvec3 sum_down = lessThanEqual(min(min(sums_a, sums_b), sums_c), vec3(0.0));
    bvec3 up = greaterThanEqual(max(max(differences_a, differences_b), differences_c), vec3(0.0));
    bvec3 down = lessThanEqual(min(min(differences_a, differences_b), differences_c), vec3(0.0));
    uint faces = sum_up.x && up.x && sum_up.z && down.z ? 1u : 0u; // x >= y, -y, z, -z
    faces |= sum_down.x && down.x && sum_down.z && up.z ? 2u : 0u;
    faces |= sum_up.y && up.y && sum_up.x && down.x ? 4u : 0u;
    faces |= sum_down.y && down.y && sum_down.x && up.x ? 8u : 0u;
    faces |= sum_up.z && up.z && sum_up.y && down.y ? 16u : 0u;
    faces |= sum_down.z && down.z && sum_down.y && up.y ? 32u : 0u;
    return faces;
}

ao_cube_cover ao_cover_of(int face, int texels, vec3 a, vec3 b, vec3 c)
{
    vec3 p = ao_cube_seen(face, a);
    vec3 q = ao_cube_seen(face, b);
    vec3 r = ao_cube_seen(face, c);
    ao_cube_box box = ao_cube_box_of(p, q, r, texels);
    ao_cube_cover cover = { ao_cube_triangle_of(p, q, r), ivec2(box.first_x, box.first_y),
                            max(ivec2(box.last_x - box.first_x, box.last_y - box.first_y) + 1, ivec2(0)) };
    return cover;
}

void ao_take(ao_bake_launch launch, uint at, ao_cube_cover cover, ivec2 texel)
{
    int texels = int(launch.columns);
    real distance = ao_cube_distance(cover.triangle, ao_cube_middle(texel.x, texels), ao_cube_middle(texel.y, texels));
    if (distance >= real(0)) {
        ao_least_word(at + uint(texel.y * texels + texel.x), floatBitsToUint(distance));
    }
}

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_WorkGroupID.y;
    ao_bake_receiver receiver = ao_receiver(vertex);
    int texels = int(launch.columns);
    uint at = ao_cube_at(launch, vertex);
    if (gl_LocalInvocationID.x == 0u) {
        ao_large_count = 0u;
    }
    barrier();
    uint triangle = launch.first_triangle + gl_GlobalInvocationID.x;
    if (triangle < launch.last_triangle && receiver.baked) {
        uvec4 t = ao_load_triangle(triangle);
        AO_PRECISE vec3 a = ao_load_point(t.x).xyz - receiver.start;
        AO_PRECISE vec3 b = ao_load_point(t.y).xyz - receiver.start;
        AO_PRECISE vec3 c = ao_load_point(t.z).xyz - receiver.start;
        real volume = ao_dot(a, ao_cross(b, c));
        bool taken = ao_occludes(t.w, receiver.object) && (!ao_front_only || volume < real(0));
        uint faces = taken ? ao_cube_faces(a, b, c) : 0u;
        while (faces != 0u) {
            int face = findLSB(faces);
            faces &= faces - 1u;
            ao_cube_cover cover = ao_cover_of(face, texels, a, b, c);
            ivec2 size = cover.size;
            if (size.x * size.y > ao_large) {
                ao_large_ones[atomicAdd(ao_large_count, 1u)] = 8u * triangle + uint(face);
                size = ivec2(0);
            }
            uint of_face = at + uint(face * texels * texels);
            for (int i = 0; i < size.x * size.y; ++i) {
                ao_take(launch, of_face, cover, cover.first + ivec2(i % size.x, i / size.x));
            }
        }
    }
    barrier();
    for (uint k = 0u; k < ao_large_count; ++k) {
        int face = int(ao_large_ones[k] % 8u);
        uvec4 t = ao_load_triangle(ao_large_ones[k] / 8u);
        AO_PRECISE vec3 a = ao_load_point(t.x).xyz - receiver.start;
        AO_PRECISE vec3 b = ao_load_point(t.y).xyz - receiver.start;
        AO_PRECISE vec3 c = ao_load_point(t.z).xyz - receiver.start;
        ao_cube_cover cover = ao_cover_of(face, texels, a, b, c);
        ivec2 size = cover.size;
        uint of_face = at + uint(face * texels * texels);
        for (int i = int(gl_LocalInvocationID.x); i < size.x * size.y; i += int(gl_WorkGroupSize.x)) {
            ao_take(launch, of_face, cover, cover.first + ivec2(i % size.x, i / size.x));
        }
    }
}
