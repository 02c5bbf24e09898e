// Runs rows and writes what they gave.
#pragma once

#include "stability/row.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stability {

struct outcome {
    const row* of = nullptr;
    std::vector<std::optional<double>> figures; // by subject; of a core row only the first
    std::optional<double> broken;               // of the spoilt first subject
    bool held = false;                          // by every figure
    bool caught = false;                        // the spoilt subject did not hold it
};

outcome run(const row& r, std::vector<subject>& subjects);

std::string rounded(double figure);
// docs/stability.md and docs/stability.json.
std::string markdown(const std::vector<outcome>& all, const std::vector<subject>& subjects);
std::string json(const std::vector<outcome>& all, const std::vector<subject>& subjects);

} // namespace stability
