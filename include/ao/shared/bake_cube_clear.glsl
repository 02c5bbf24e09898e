// Of the route `cube`: nothing is met yet. An invocation takes a texel; rows of groups are vertices.
#include "ao/shared/bake_cube.glsl"

void ao_bake_main(ao_bake_launch launch)
{
    uint vertex = launch.first_vertex + gl_WorkGroupID.y;
    if (gl_GlobalInvocationID.x < 6u * launch.columns * launch.columns) {
        ao_store_word(ao_cube_at(launch, vertex) + gl_GlobalInvocationID.x, floatBitsToUint(ao_no_occluder));
    }
}
