// The spatial filter of temporal ambient occlusion (paper 2, eq. 10 and 11), as a pass along the rows and one along the columns:
// mean of the neighbours' values by convergence and world distance. It vanishes as the pixel itself converges. Callbacks: real
// ao_load_depth(ivec2), as in temporal_pass.h; uvec4 ao_load_history(uint): of this frame (history_load.h);
//            real ao_load_row(ivec2): what the first pass returned.
// Options:   int ao_filter_radius, bool ao_parallel.

struct ao_temporal_filter_constants {
    ao_projection projection;
    real width; // pixels
    real height;
    real most_weight; // w_max
    real c_spatial;   // convergence from which on there is no filter
    real support;     // of the filter in the world where nothing has converged, scene units
    real reserved_0;
    real reserved_1;
    real reserved_2;
};

// Whether a pixel's value is to be filtered. What is not keeps its value in both passes: wherever no pixel of a tile is, neither
// need run there, given that the value is there already.
AO_FN mask ao_to_be_filtered(ao_temporal_filter_constants c, ao_history h)
{
    mask filtered = ao_filter_support(ao_convergence(h.weight, c.most_weight), c.c_spatial) > real(0) && h.depth > real(0);
    return filtered;
}

AO_PASS vec3 ao_filter_position(ao_temporal_filter_constants c, ivec2 pixel, real d)
{
    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    return ao_view_point(c.projection, centre, d, ao_parallel);
}

// One of the two passes: `rows` reads the history's own values, else those of the first pass.
AO_PASS real ao_temporal_filter(ao_temporal_filter_constants c, ivec2 pixel, bool rows)
{
    ao_history h = ao_history_at(pixel, c.width);
    mask filtered = ao_to_be_filtered(c, h);
    real own = rows ? h.value : mix(h.value, ao_load_row(pixel), filtered);
    real share = ao_filter_support(ao_convergence(h.weight, c.most_weight), c.c_spatial);
    AO_PRECISE real support = share * c.support;
    AO_PRECISE real squared_support = support * support;
    real d = mix(real(1), ao_load_depth(pixel), h.depth > real(0));
    vec3 position = ao_filter_position(c, pixel, d);
    real sum = real(0);
    real weights = real(0);
    // Not unrolled: llvmpipe leaves out what a loop does not reach, but not what an if does not.
    int reach = ao_any(filtered) ? ao_filter_radius : -1;
    for (int i = -reach; i <= reach; ++i) {
        integer column = pixel.x + integer(rows ? i : 0);
        integer row = pixel.y + integer(rows ? 0 : i);
        mask inside = column >= integer(0) && real(column) < c.width && row >= integer(0) && real(row) < c.height;
        ivec2 at = ivec2(mix(pixel.x, column, inside), mix(pixel.y, row, inside));
        ao_history there = ao_history_at(at, c.width);
        mask used = inside && there.depth > real(0);
        vec3 other = ao_filter_position(c, at, mix(real(1), ao_load_depth(at), used));
        AO_PRECISE vec3 offset = vec3(other.x - position.x, other.y - position.y, other.z - position.z);
        AO_PRECISE real near = ao_filter_weight(ao_dot(offset, offset), squared_support);
        AO_PRECISE real weight = mix(real(0), near * ao_convergence(there.weight, c.most_weight), used);
        // What was not filtered along its row may never have been written there.
        real value = rows ? there.value : mix(there.value, ao_load_row(at), ao_to_be_filtered(c, there));
        AO_PRECISE real next_sum = sum + weight * value;
        AO_PRECISE real next_weights = weights + weight;
        sum = next_sum;
        weights = next_weights;
    }
    mask any = weights > real(0);
    AO_PRECISE real mean = sum / mix(real(1), weights, any);
    return mix(own, mean, filtered && any);
}

AO_PASS real ao_temporal_rows_pass(ao_temporal_filter_constants c, ivec2 pixel)
{
    return ao_temporal_filter(c, pixel, true);
}

// Visibility, 1 on background.
AO_PASS real ao_visibility_of(real occlusion)
{
    AO_PRECISE real visibility = max(real(1) - occlusion, real(0));
    return min(visibility, real(1));
}

AO_PASS real ao_temporal_columns_pass(ao_temporal_filter_constants c, ivec2 pixel)
{
    return ao_visibility_of(ao_temporal_filter(c, pixel, false));
}

// Before the filter, or without one.
AO_PASS real ao_temporal_resolve_pass(ao_temporal_filter_constants c, ivec2 pixel)
{
    return ao_visibility_of(ao_history_at(pixel, c.width).value);
}
