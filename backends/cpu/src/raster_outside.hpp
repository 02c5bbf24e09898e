// On which sides of a view something lies.
#pragma once

#include "raster_view.hpp"

namespace ao::cpu {

// Outside of one of the picture's sides or the depth range; a triangle whose corners share one is not seen.
enum outside : unsigned {
    left_side = 1,
    right_side = 2,
    lower_side = 4,
    upper_side = 8,
    before_near = 16,
    behind_far = 32,
    beyond_guard = 64,
    not_usable = 128, // not finite, or as good as
};
constexpr unsigned needs_clipping = before_near | behind_far | beyond_guard;

// The `outside` of a corner.
unsigned classify(const raster_view& v, const glm::vec4& c);

// Whether no triangle of the cluster can be seen: its box lies outside of one of the view's planes by more than the rounding of
// its vertices' transforms.
bool unseen(const raster_view& v, const geometry_instance& o, const triangle_cluster& c);

} // namespace ao::cpu
