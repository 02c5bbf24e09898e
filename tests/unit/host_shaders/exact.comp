#version 450 core
layout(local_size_x = 1) in;
layout(binding = 0, r32f) uniform writeonly image2D out_image;
float ao_exact(vec3 a, vec3 b)
{
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    precise float root = sqrt(abs(sum));
    return floor(root);
}
void main()
{
    vec3 a = vec3(gl_GlobalInvocationID);
    imageStore(out_image, ivec2(0), vec4(ao_exact(a, a * 3.0 + 1.0)));
}
