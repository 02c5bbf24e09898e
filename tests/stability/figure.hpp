// Collecting figures: what is not a number is infinitely bad.
#pragma once

#include <cmath>
#include <limits>

namespace stability {

inline constexpr double endless = std::numeric_limits<double>::infinity();

// The greatest value added, at least 0.
class worst {
public:
    void add(double x)
    {
        if (!(x <= value_)) {
            value_ = std::isnan(x) ? endless : x;
        }
    }
    double value() const { return value_; }

private:
    double value_ = 0;
};

} // namespace stability
