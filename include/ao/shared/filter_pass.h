// Box filter of the visibility (paper 1, stage 3) over an odd number of pixels a side, as a pass along the rows and one along
// the columns. Normalised by the pixels present: those outside the picture and background pixels do not count.
// Callbacks: real ao_load_visibility(ivec2): visibility, negative for background;
//            vec2 ao_load_row_sum(ivec2): what the first pass returned.
// Options:   int ao_filter_radius.

struct ao_filter_constants {
    real width; // pixels
    real height;
    real reserved_x;
    real reserved_y;
};

// Sum of the visibilities of the row's window and their number, the number negative or 0 where the centre is background.
AO_PASS vec2 ao_filter_rows_pass(ao_filter_constants c, ivec2 pixel)
{
    mask covered = ao_load_visibility(pixel) >= real(0);
    real sum = real(0);
    real count = real(0);
    for (int i = -ao_filter_radius; i <= ao_filter_radius; ++i) {
        integer column = pixel.x + integer(i);
        mask inside = column >= integer(0) && real(column) < c.width;
        real value = ao_load_visibility(ivec2(mix(pixel.x, column, inside), pixel.y));
        mask used = inside && value >= real(0);
        AO_PRECISE real next_sum = sum + mix(real(0), value, used);
        AO_PRECISE real next_count = count + mix(real(0), real(1), used);
        sum = next_sum;
        count = next_count;
    }
    return vec2(sum, mix(-count, count, covered));
}

// Mean visibility of the window, 1 on background.
AO_PASS real ao_filter_columns_pass(ao_filter_constants c, ivec2 pixel)
{
    mask covered = ao_load_row_sum(pixel).y > real(0);
    real sum = real(0);
    real count = real(0);
    for (int i = -ao_filter_radius; i <= ao_filter_radius; ++i) {
        integer row = pixel.y + integer(i);
        mask inside = row >= integer(0) && real(row) < c.height;
        vec2 part = ao_load_row_sum(ivec2(pixel.x, mix(pixel.y, row, inside)));
        AO_PRECISE real next_sum = sum + mix(real(0), part.x, inside);
        AO_PRECISE real next_count = count + mix(real(0), abs(part.y), inside);
        sum = next_sum;
        count = next_count;
    }
    AO_PRECISE real mean = sum / mix(real(1), count, covered);
    return mix(real(1), min(mean, real(1)), covered);
}
