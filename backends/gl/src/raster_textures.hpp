// Alpha and normal maps of a geometry pass: as a heap that shaders read, or as textures for the driver's sampler.
#pragma once

#include "buffer.hpp"
#include "raster_state.hpp"

#include <vector>

namespace ao::gl {

// By scene texture: its place among those that the plan's draws read, or no_texture.
std::vector<int> read_textures(const scene& s, const draw_plan& p);

object upload_heap(buffer_maker& buffers, const scene& s, const std::vector<int>& places);
// By place.
std::vector<object> upload_textures(buffer_maker& buffers, const functions& gl, const scene& s, const std::vector<int>& places);
object upload_materials(buffer_maker& buffers, const scene& s, const std::vector<int>& places);

} // namespace ao::gl
