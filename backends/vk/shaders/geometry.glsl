// Options and resources of both stages of the geometry pass. What is off is neither read nor written.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 0) const bool ao_use_alpha_map = false;
layout(constant_id = 1) const bool ao_use_normal_map = false;
layout(constant_id = 2) const bool use_uvs = false;
layout(constant_id = 3) const bool fill_frame = false;
layout(constant_id = 4) const bool deforming = false;
layout(constant_id = 5) const bool write_position = false;
layout(constant_id = 6) const bool write_normal = false;
layout(constant_id = 7) const bool write_motion = false;
layout(constant_id = 8) const bool write_ids = false;
layout(constant_id = 9) const bool write_surface = false;
layout(constant_id = 10) const bool write_frame = false;
layout(constant_id = 11) const int ao_normal_encoding = 0; // normal_source

layout(binding = 0, std140) uniform camera_block { ao_geometry_camera camera; };
