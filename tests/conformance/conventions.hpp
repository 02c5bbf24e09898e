// The 32 conventions a projection may follow, and one scene for all of them.
#pragma once

#include "ao/conformance/pictures.hpp"
#include "ao/plan.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

struct convention {
    std::string name;
    ao::projection_options options;
    // Whether the first row in memory shows the bottom of the view.
    bool bottom_first = false;
};

inline std::vector<convention> all_conventions()
{
    std::vector<convention> all;
    for (int bits = 0; bits < 32; ++bits) {
        convention c;
        c.options.parallel = (bits & 1) != 0;
        c.options.range = (bits & 2) != 0 ? ao::depth_range::minus_one_to_one : ao::depth_range::zero_to_one;
        c.options.reversed = (bits & 4) != 0;
        c.options.y_down = (bits & 8) != 0;
        c.options.rows = (bits & 16) != 0 ? ao::first_row::at_ndc_plus_one : ao::first_row::at_ndc_minus_one;
        // The first row shows NDC y = -1 or +1, and NDC y grows upwards or downwards.
        c.bottom_first = (c.options.rows == ao::first_row::at_ndc_minus_one) != c.options.y_down;
        c.name = std::string(c.options.parallel ? "parallel" : "perspective") + ((bits & 2) != 0 ? ", z -1..1" : ", z 0..1") +
                 (c.options.reversed ? ", reversed" : "") + (c.options.y_down ? ", y down" : ", y up") +
                 ((bits & 16) != 0 ? ", rows from +1" : ", rows from -1");
        all.push_back(c);
    }
    return all;
}

inline ao::camera_projection projection_of(const convention& c, bool infinite = false)
{
    const double extent = c.options.parallel ? 3.0 : 0.7;
    const double far = infinite ? std::numeric_limits<double>::infinity() : 60;
    return ao::make_projection({ -extent, 1.25 * extent, -0.75 * extent, 0.5 * extent, 0.25, far }, c.options);
}

inline ao::conformance::surfaces upside_down(ao::conformance::surfaces s)
{
    for (int y = 0; y < s.height / 2; ++y) {
        for (int x = 0; x < s.width; ++x) {
            const auto upper = static_cast<std::size_t>(y * s.width + x);
            const auto lower = static_cast<std::size_t>((s.height - 1 - y) * s.width + x);
            std::swap(s.depth[upper], s.depth[lower]);
            std::swap(s.normals[upper], s.normals[lower]);
        }
    }
    return s;
}

// The same view in every convention: only the order of its rows differs.
inline ao::conformance::surfaces scene_in(const convention& c, int width, int height)
{
    convention top_first = c;
    top_first.options.y_down = false;
    top_first.options.rows = ao::first_row::at_ndc_plus_one;
    const ao::conformance::surfaces seen = ao::conformance::make_scene(width, height, projection_of(top_first));
    return c.bottom_first ? upside_down(seen) : seen;
}
