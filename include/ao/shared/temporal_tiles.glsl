// The tiles, a compute group each, in which a pixel is to be filtered: resolve lists them, and the filter's passes run over the
// list by an indirect dispatch, so that what has converged costs them nothing.
// Before resolve every word is 0. AO_TILES_BINDING: the buffer's.
layout(std430, binding = AO_TILES_BINDING) buffer ao_tiles_block {
    uint ao_groups_x; // of the indirect dispatch
    uint ao_groups_y;
    uint ao_groups_z;
    uint ao_tile_count;
    uvec2 ao_tiles[]; // x: whether this tile is listed; y: where the list's element of this index lies, column + 65536 row
};

// More groups than every device takes in one direction go into further rows.
const uint ao_groups_in_row = 32768u;

void ao_list_tile()
{
    uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (ao_tiles[tile].x == 0u && atomicExchange(ao_tiles[tile].x, 1u) == 0u) {
        uint place = atomicAdd(ao_tile_count, 1u);
        ao_tiles[place].y = gl_WorkGroupID.x + 65536u * gl_WorkGroupID.y;
        atomicMax(ao_groups_x, min(place + 1u, ao_groups_in_row));
        atomicMax(ao_groups_y, place / ao_groups_in_row + 1u);
        ao_groups_z = 1u;
    }
}

// This invocation's pixel; it may lie outside the picture.
ivec2 ao_listed_pixel()
{
    uint place = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint tile = place < ao_tile_count ? ao_tiles[place].y : 0xffffffffu;
    uvec2 corner = uvec2(tile & 65535u, tile >> 16) * uvec2(gl_WorkGroupSize);
    return ivec2(corner + uvec2(gl_LocalInvocationID));
}
