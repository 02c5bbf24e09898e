// Options and resources of both stages of the geometry pass. What is off is neither read nor written.
#include "ao/shared/prelude.glsl"
#include "ao/shared/functions.h"

layout(constant_id = 0) const bool ao_use_alpha_map = false;
layout(constant_id = 1) const bool ao_use_normal_map = false;
layout(constant_id = 2) const bool ao_use_uvs = false;
layout(constant_id = 3) const bool ao_fill_frame = false;
layout(constant_id = 4) const bool ao_deforming = false;
layout(constant_id = 5) const bool ao_write_position = false;
layout(constant_id = 6) const bool ao_write_normal = false;
layout(constant_id = 7) const bool ao_write_motion = false;
layout(constant_id = 8) const bool ao_write_ids = false;
layout(constant_id = 9) const bool ao_write_surface = false;
layout(constant_id = 10) const bool ao_write_frame = false;
layout(constant_id = 11) const int ao_normal_encoding = 0; // normal_source
layout(constant_id = 12) const bool ao_hardware_sampling = false;
