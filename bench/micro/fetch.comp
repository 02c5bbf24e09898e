#version 450
// The cost of texelFetch alone: as many fetches of a R32F texture as a pass has taps, at pseudo-random texels near the pixel, summed.
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int fetches = 32;
layout(binding = 0) uniform sampler2D source;
layout(binding = 1, r32f) uniform writeonly image2D target;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(target);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    uint state = uint(pixel.x) * 747796405u + uint(pixel.y) * 2891336453u;
    float sum = 0.0;
    for (int i = 0; i < fetches; ++i) {
        state = state * 747796405u + 2891336453u;
        ivec2 near = pixel + ivec2(state >> 26, (state >> 20) & 63u) - 32;
        sum += texelFetch(source, clamp(near, ivec2(0), size - 1), 0).x;
    }
    imageStore(target, pixel, vec4(sum));
}
