// From the objects of a model to the triangles of each tile.
#pragma once

#include "raster_view.hpp"

namespace ao::cpu {

// Transforms, clips, culls and sorts into tiles the triangles of one batch. Reads nothing of other batches.
void set_up_batch(const raster_model_state& model, const raster_view& view, std::size_t batch, const tile_grid& grid,
                  triangle_bins& into);

} // namespace ao::cpu
