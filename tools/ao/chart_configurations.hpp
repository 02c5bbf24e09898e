#pragma once

#include "ao/chart_options.hpp"
#include "ao/plan.hpp"
#include "ao/temporal_settings.hpp"

#include <string>
#include <vector>

namespace ao::tools {

// One choice of settings and storage that is charted.
struct chart_configuration {
    std::string name;   // unique
    std::string method; // one color
    // What it is there for: "taps", "presets", "resolution", "convergence", "filter", "depth", "normals", "output", "thickness".
    std::string varies;
    ao::settings settings;
    ao::facts facts; // without a size
    bool timed = true;
};

struct temporal_configuration {
    std::string name;
    std::string method;
    ao::temporal_settings settings;
};

// Of single frames and over time.
[[nodiscard]] std::vector<std::string> chart_methods();

[[nodiscard]] std::vector<chart_configuration> single_configurations(const chart_options& o);
[[nodiscard]] std::vector<temporal_configuration> temporal_configurations(const chart_options& o);

// The same estimate with as many samples as there can be, of another seed and without a filter: what the method converges to.
[[nodiscard]] ao::settings limit_of(ao::settings s);

} // namespace ao::tools
