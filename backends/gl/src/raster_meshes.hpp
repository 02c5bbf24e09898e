// The meshes of a scene as the arrays that the driver draws from.
#pragma once

#include "raster_state.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace ao::gl {

struct placed_mesh {
    GLuint first_index = 0;
    GLuint index_count = 0;
    GLint base_vertex = 0;
};

struct mesh_arrays {
    // Floats by attribute; those that no variant reads are empty, others have zeros for meshes that lack them.
    std::array<std::vector<float>, attribute_count> streams;
    std::vector<std::uint32_t> indices;
    std::vector<placed_mesh> meshes; // of the scene; those that no draw uses have no indices
    bool too_large = false;          // for 32-bit vertex numbers
};

mesh_arrays gather_meshes(const scene& s, const draw_plan& p);

} // namespace ao::gl
