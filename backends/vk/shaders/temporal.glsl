// Resources and options of the temporal passes: one descriptor set layout for all of them, which linearize.comp fits too.
// AO_SOFTWARE: eye depth is the program's own picture, read as a storage image.
#extension GL_EXT_samplerless_texture_functions : require
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(local_size_x_id = 14, local_size_y_id = 15) in;

layout(constant_id = 0) const int ao_most_samples = 1;
layout(constant_id = 1) const int ao_contribution = 0;
layout(constant_id = 2) const int ao_history_format = 0;
layout(constant_id = 3) const int ao_invalidation = 0;
layout(constant_id = 4) const bool ao_reproject = false;
layout(constant_id = 5) const bool ao_use_motion = false;
layout(constant_id = 6) const bool ao_cubic = false;
layout(constant_id = 7) const int ao_normal_source = 0;
layout(constant_id = 8) const bool ao_rotate_normals = false;
layout(constant_id = 9) const bool ao_parallel = false;
layout(constant_id = 10) const bool ao_limit_thickness = false;
layout(constant_id = 13) const int ao_slice_taps = 1;
layout(constant_id = 11) const int ao_filter_radius = 0;

#ifdef AO_SOFTWARE
layout(binding = 5, r32f) uniform readonly image2D eye_depth;
real ao_load_depth(ivec2 pixel) { return imageLoad(eye_depth, pixel).x; }
#else
layout(binding = 0) uniform texture2D eye_depth;
real ao_load_depth(ivec2 pixel) { return texelFetch(eye_depth, pixel, 0).x; }
#endif
layout(binding = 1) uniform texture2D normals;
layout(binding = 2) uniform texture2D motions;
layout(binding = 3) uniform textureBuffer rotations;
layout(binding = 6, r32f) uniform readonly image2D rows;
// Texels, not storage buffers, which llvmpipe reads word by word.
layout(binding = 8) uniform textureBuffer taps;
layout(binding = 9) uniform utextureBuffer history;

vec4 ao_load_normal(ivec2 pixel) { return texelFetch(normals, pixel, 0); }
vec4 ao_load_motion(ivec2 pixel) { return texelFetch(motions, pixel, 0); }
vec2 ao_load_rotation(ivec2 texel) { return texelFetch(rotations, texel.y * ao_tile_size + texel.x).xy; }
real ao_load_row(ivec2 pixel) { return imageLoad(rows, pixel).x; }
vec4 ao_load_tap(uint index) { return texelFetch(taps, int(index)); }
uvec4 ao_load_history(uint pixel) { return texelFetch(history, int(pixel)); }

#include "ao/shared/history_load.h"

bool in_picture(ivec2 pixel, real width, real height) { return pixel.x < int(width) && pixel.y < int(height); }
