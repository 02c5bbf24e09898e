#version 450 core
layout(local_size_x = 1) in;
layout(binding = 0, r32f) uniform writeonly image2D out_image;
float ao_contracted(vec3 a, vec3 b) { return a.x * b.x + a.y; }
float ao_unordered(vec3 a, vec3 b) { return dot(a, normalize(b)); }
float ao_tolerant(float a) { return mix(sin(a), 1.0, 0.25); }
vec3 ao_transformed(mat3 m, vec3 a) { return m * a; }
float free_to_contract(float a) { return a * a + 1.0; }
void main()
{
    vec3 a = vec3(gl_GlobalInvocationID);
    float all = ao_contracted(a, a) + ao_unordered(a, a) + ao_tolerant(a.x) + free_to_contract(a.y);
    imageStore(out_image, ivec2(0), vec4(all) + ao_transformed(mat3(1.0), a).xyzx);
}
