#pragma once

#include "ao/view.hpp"

#include "ao/texture.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace ao::tools {

// What rays saw as a geometry pass would have drawn it: the depth or position and the normal that the effect reads, and for
// shading the other targets that `f` asks for. Footprints are exact.
[[nodiscard]] picture_set pictures_of_rays(const tools::scene& s, const ao::scene& drawn, const tools::gbuffer& g,
                                           const tools::camera& c, const tools::frustum& seen, const ao::gbuffer_facts& f,
                                           const ao::camera_projection& projection);

// Turns the normals that rays saw as the materials' normal maps say.
void apply_normal_maps(tools::gbuffer& g, const tools::scene& s, const ao::scene& drawn, const ao::texel_heap& heap,
                       const tools::camera& c, const tools::frustum& seen);

} // namespace ao::tools
