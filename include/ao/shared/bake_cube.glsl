// The route `cube`: six depth cameras at the start of a vertex, into a cube map that its directions are looked up in. `words`
// holds the cube maps of the launch's vertices: distances (floats as bits), six faces each of columns x columns texels.
//     uint ao_load_word(uint i)
//     void ao_store_word(uint i, uint word)
#include "ao/shared/bake_cube.h"

uint ao_cube_at(ao_bake_launch launch, uint vertex)
{
    return (vertex - launch.first_vertex) * 6u * launch.columns * launch.columns;
}
