// Group size, resources and options that the temporal passes have in common. Constant ids: the order of ao::temporal_options.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(local_size_x_id = 14, local_size_y_id = 15) in;
layout(constant_id = 2) const int ao_history_format = 0;
layout(constant_id = 9) const bool ao_parallel = false;

layout(binding = 0) uniform sampler2D ao_depth;
// A buffer texture, as the sequence: with storage buffers a frame of a moving camera takes 1.6 times as long on llvmpipe.
layout(binding = 4) uniform usamplerBuffer ao_history_read;

real ao_load_depth(ivec2 pixel)
{
    return texelFetch(ao_depth, pixel, 0).x;
}

uvec4 ao_load_history(uint pixel)
{
    return texelFetch(ao_history_read, int(pixel));
}

#include "ao/shared/history_load.h"
