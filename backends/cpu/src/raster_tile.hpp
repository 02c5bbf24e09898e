// Hidden surfaces and targets of a tile.
#pragma once

#include "kernels.hpp"
#include "raster_fragments.hpp"

namespace ao::cpu {

// Writes all pixels of tile `index` of the grid, from all bins, in order.
void draw_tile(const raster_frame& frame, const raster_targets_state& targets, int index, tile_memory& memory);

} // namespace ao::cpu
