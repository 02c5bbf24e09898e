// The pixels of a triangle, row by row.
#pragma once

#include "raster_state.hpp"
#include "raster_view.hpp"

#include <algorithm>

namespace ao::cpu {

// An edge as what a pixel centre must not exceed along its row: f(i) = limit - slope * i >= 0 with i the pixel's column.
// Everything is a whole number below 2^53 (corners lie within 2^17 pixels, so products of differences within 2^52), and so exact.
// A quotient limit / slope that is no whole number is 2^-34 or more from one, and below 2^17 rounds by no more than 2^-37:
// rounding up and down of the rounded quotient is that of the exact one.
struct row_limit {
    double slope; // per pixel; > 0: bounds on the right, < 0: on the left
    double limit;
    double step; // of the limit per row

    row_limit(std::int32_t ax, std::int32_t ay, std::int32_t bx, std::int32_t by, int row)
    {
        const std::int64_t dx = bx - ax;
        const std::int64_t dy = by - ay;
        // Centres on top and left edges belong to the triangle.
        const bool own = dy < 0 || (dy == 0 && dx > 0);
        slope = static_cast<double>(dy * subpixels);
        limit = static_cast<double>(dx * (std::int64_t{ row } * subpixels - ay) + dy * ax - (own ? 0 : 1));
        step = static_cast<double>(dx * subpixels);
    }
};

// Calls body(row, first, last) for each row of a box of pixels in which the triangle covers `first` ... `last`.
template <class Body>
void for_rows(const raster_triangle& t, int left, int top, int right, int bottom, Body body)
{
    const auto [low_y, high_y] = std::minmax({ t.y[0], t.y[1], t.y[2] });
    const auto [low_x, high_x] = std::minmax({ t.x[0], t.x[1], t.x[2] });
    const int first_row = std::max(top, (low_y + subpixels - 1) >> 8);
    const int last_row = std::min(bottom - 1, high_y >> 8);
    const int first_column = std::max(left, (low_x + subpixels - 1) >> 8);
    const int last_column = std::min(right - 1, high_x >> 8);
    if (first_row > last_row || first_column > last_column) {
        return;
    }
    std::array<row_limit, 3> edges{ row_limit(t.x[0], t.y[0], t.x[1], t.y[1], first_row),
                                    row_limit(t.x[1], t.y[1], t.x[2], t.y[2], first_row),
                                    row_limit(t.x[2], t.y[2], t.x[0], t.y[0], first_row) };
    const double before = first_column - 1;
    const double behind = last_column + 1;
    for (int row = first_row; row <= last_row; ++row) {
        int first = first_column;
        int last = last_column;
        for (row_limit& e : edges) {
            if (e.slope > 0) {
                const double q = std::clamp(e.limit / e.slope, before, behind);
                const int down = static_cast<int>(q);
                last = std::min(last, down > q ? down - 1 : down);
            }
            else if (e.slope < 0) {
                const double q = std::clamp(e.limit / e.slope, before, behind);
                const int up = static_cast<int>(q);
                first = std::max(first, up < q ? up + 1 : up);
            }
            else if (e.limit < 0) {
                last = first - 1;
            }
            e.limit += e.step;
        }
        if (first <= last) {
            body(row, first, last);
        }
    }
}

} // namespace ao::cpu
