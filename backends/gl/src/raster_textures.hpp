// Alpha and normal maps of a geometry pass: as a heap that shaders read, or as textures for the driver's sampler.
#pragma once

#include "buffer.hpp"
#include "raster_state.hpp"

#include <vector>

namespace ao::gl {

object upload_heap(buffer_maker& buffers, const map_places& maps);
// By place.
std::vector<object> upload_textures(buffer_maker& buffers, const functions& gl, const map_places& maps);
object upload_materials(buffer_maker& buffers, const scene& s, const map_places& maps);

} // namespace ao::gl
