#pragma once

#include "ao/temporal_settings.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace ao::tools {

// What `ao render --temporal` was asked for besides.
struct temporal_choice {
    std::string motion;
    ao::temporal_settings settings;
};

// What the options are parsed into.
struct temporal_arguments {
    bool wanted = false;
    std::string motion = "static", samples, contribution, density, history = "precise", invalidation = "smooth";
    std::optional<int> most_weight;
    double smoothness = static_cast<double>(temporal_settings{}.smoothness);
};

// To be called once the command has the other options: some of them go together with --temporal, some do not.
void add_temporal_options(CLI::App& command, temporal_arguments& read);

// Throws `error` naming the option at fault. `common`: the settings that both kinds of ambient occlusion have.
[[nodiscard]] temporal_choice check_temporal(const temporal_arguments& a, const ao::settings& common);

} // namespace ao::tools
