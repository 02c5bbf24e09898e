#pragma once

#include "pixel_classes.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace ao::tools {

// Two pictures x and y of one method, which differ in their seeds alone, against two independent references a and b of the same
// truth (numerics: error without the references' noise). Roots of means over the pixels; a square that comes out below zero has
// the root 0. rmse^2 = systematic^2 + deviation^2, exactly.
struct paired_error {
    std::size_t pixels = 0;
    double rmse = 0.0;       // mean((x - a)(x - b)), and of y, averaged
    double systematic = 0.0; // mean((x - a)(y - b)), symmetric: what more seeds would not average out
    double deviation = 0.0;  // mean((x - y)^2) / 2: what they would
    double bias = 0.0;       // signed, > 0: too bright
};

// Sums before the roots are taken: those of parts of a picture, or of several, add.
struct error_sums {
    std::size_t pixels = 0;
    double square = 0.0;
    double systematic = 0.0;
    double between = 0.0;
    double signed_sum = 0.0;

    void add(double x, double y, double a, double b);
    error_sums& operator+=(const error_sums& s);
    [[nodiscard]] paired_error result() const;
};

struct picture_pair {
    std::span<const float> x;
    std::span<const float> y;
};

// By class of pixel. Precondition: equal lengths.
using class_sums = std::array<error_sums, pixel_class_count>;
[[nodiscard]] class_sums compare(const picture_pair& seen, const picture_pair& truth, std::span<const pixel_class> classes);
// All classes but the background.
[[nodiscard]] error_sums of_surfaces(const class_sums& sums);

// Slope of log(y) over log(x) by least squares. Precondition: at least two different x, all values > 0.
[[nodiscard]] double log_slope(std::span<const double> x, std::span<const double> y);

// Nearest rank; share in [0, 1]. Precondition: not empty.
[[nodiscard]] double percentile(std::vector<double> values, double share);

} // namespace ao::tools
