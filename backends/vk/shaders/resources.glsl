// What the pass bodies ask for, answered from Vulkan's resources. All passes share one descriptor set layout and one set of
// options; a pass uses its part of both. AO_TARGET: format of the picture that the pass writes.
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x_id = 10, local_size_y_id = 11) in;

layout(constant_id = 0) const bool ao_affine = false;
layout(constant_id = 1) const int ao_tap_count = 1;
layout(constant_id = 2) const int ao_normal_source = 0;
layout(constant_id = 3) const bool ao_rotate_normals = false;
layout(constant_id = 4) const bool ao_parallel = false;
layout(constant_id = 5) const bool ao_limit_thickness = false;
layout(constant_id = 6) const bool ao_mark_background = false;
layout(constant_id = 7) const int ao_filter_radius = 0;
layout(constant_id = 8) const bool depth_in_z = false; // positions
layout(constant_id = 9) const int ao_slice_count = 1;
layout(constant_id = 12) const bool ao_coarse = false;

// The first of ao::pass::inputs. AO_DEPTH_IN_Y: it holds packed visibility and eye depth.
// AO_STORED_SOURCE: it is the program's own picture of that format, read as a storage image.
#ifdef AO_STORED_SOURCE
layout(binding = 5, AO_STORED_SOURCE) uniform readonly image2D source;
vec4 fetch_source(ivec2 pixel) { return imageLoad(source, pixel); }
#else
layout(binding = 0) uniform texture2D source;
vec4 fetch_source(ivec2 pixel) { return texelFetch(source, pixel, 0); }
#endif
layout(binding = 1) uniform texture2D normals;
layout(binding = 2, std140) uniform kernel_table { vec4 offsets[1024]; };
layout(binding = 3) uniform textureBuffer rotations;
layout(binding = 4, AO_TARGET) uniform writeonly image2D target;

real ao_load_stored_depth(ivec2 pixel)
{
    vec4 texel = fetch_source(pixel);
    return depth_in_z ? texel.z : texel.x;
}
#ifdef AO_DEPTH_IN_Y
layout(binding = 6) uniform texture2D depths; // of every pixel, where coarse
vec2 ao_load_packed(ivec2 texel) { return fetch_source(texel).xy; }
real ao_load_depth(ivec2 pixel) { return ao_coarse ? texelFetch(depths, pixel, 0).x : fetch_source(pixel).y; }
#else
real ao_load_depth(ivec2 pixel) { return fetch_source(pixel).x; }
#endif
vec4 ao_load_normal(ivec2 pixel) { return texelFetch(normals, pixel, 0); }
vec2 ao_load_rotation(ivec2 texel) { return texelFetch(rotations, texel.y * ao_tile_size + texel.x).xy; }
vec4 ao_tap(int i) { return offsets[i]; }
real ao_load_visibility(ivec2 pixel) { return fetch_source(pixel).x; }
vec2 ao_load_row_sum(ivec2 pixel) { return fetch_source(pixel).xy; }

bool in_picture(ivec2 pixel) { return all(lessThan(pixel, imageSize(target))); }
