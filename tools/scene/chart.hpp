#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ao::tools {

struct chart_line {
    std::string name;
    std::vector<std::optional<double>> values; // by frame; where there is none the line has a gap
};

// Lines over the frames of an animation; the vertical axis begins at 0.
struct report_chart {
    std::string title;
    std::vector<chart_line> lines;
    std::vector<std::size_t> marks; // frames with a vertical line: cuts
};

// An <svg> element that takes its text colour from around it. Lines that lie on each other are seen as strips of each.
[[nodiscard]] std::string make_svg(const report_chart& chart);

} // namespace ao::tools
