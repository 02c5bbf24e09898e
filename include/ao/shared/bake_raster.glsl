// The route `raster`: what the starts of vertices meet along a line of directions, all at once. Across the line lies a grid of
// cells; starts are sorted into it (bake_raster_sort.glsl), and every triangle runs over the starts in the cells of its box
// (bake_raster_cover.glsl; Aila and Laine, "Alias-free shadow maps", 2004, without a depth map). Places and cells are floors of
// one rounded, growing function of a coordinate, so that no start within a triangle's box is in other cells than those.
//
// Of each of the launch's lines, `seen` holds the points, then the sorted starts: u, w, d, and what they are (as bits). `words`
// holds what was found: for packed bits as bake_packed.glsl, for distances two a line and vertex, d then -d; after that for every
// line where its cells begin.
//     uint ao_load_word(uint i)
//     void ao_store_word(uint i, uint word)
//     vec4 ao_load_seen(uint i)
//     void ao_store_seen(uint i, vec4 seen)

struct ao_bake_grid {
    real left;
    real top;
    real to_column;
    real to_row;
};

ao_bake_grid ao_grid_of(ao_bake_launch launch, ao_bake_line line)
{
    // Half the box of the mesh, as seen; starts and points beyond are counted to the cells at its rim.
    AO_PRECISE real u = launch.box.x * abs(line.ux) + launch.box.y * abs(line.uy) + launch.box.z * abs(line.uz);
    AO_PRECISE real w = launch.box.x * abs(line.wx) + launch.box.y * abs(line.wy) + launch.box.z * abs(line.wz);
    AO_PRECISE real across = u * ao_bake_lattice + real(1);
    AO_PRECISE real down = w * ao_bake_lattice + real(1);
    AO_PRECISE real to_column = real(launch.columns) / (real(2) * across);
    AO_PRECISE real to_row = real(launch.rows) / (real(2) * down);
    ao_bake_grid grid = { -across, -down, to_column, to_row };
    return grid;
}

uint ao_cell_along(real x, real first, real scale, uint count)
{
    AO_PRECISE real cells = (x - first) * scale;
    return uint(clamp(cells, real(0), real(count - 1u)));
}

uint ao_column(ao_bake_launch launch, ao_bake_grid grid, real u)
{
    return ao_cell_along(u, grid.left, grid.to_column, launch.columns);
}

uint ao_row(ao_bake_launch launch, ao_bake_grid grid, real w)
{
    return ao_cell_along(w, grid.top, grid.to_row, launch.rows);
}

uint ao_block_vertices(ao_bake_launch launch)
{
    return launch.last_vertex - launch.first_vertex;
}

uint ao_block_lines(ao_bake_launch launch)
{
    return launch.last_line - launch.first_line;
}

// The word before the first cell of the launch's line `row`: 0. The next is where its second cell begins.
uint ao_cells_at(ao_bake_launch launch, uint row)
{
    uint words = ao_falloff == 0 ? launch.words : 2u * ao_block_lines(launch);
    return ao_block_vertices(launch) * words + row * (launch.columns * launch.rows + 1u);
}

uint ao_samples_at(ao_bake_launch launch, uint row)
{
    return row * launch.pitch + launch.points;
}

// A start: its vertex in the block, and which ways it looks: 1 along d, 2 along -d.
uint ao_sample_of(uint vertex, bvec2 wanted)
{
    return vertex << 2 | (wanted.x ? 1u : 0u) | (wanted.y ? 2u : 0u);
}
