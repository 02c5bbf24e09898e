#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ao::tools {

// Of a picture x against two independent references a and b of the same truth, over the pixels of the mask.
// Mean square error = mean((x - a)(x - b)): the references' own noise, being independent, averages out of it instead of
// adding to it. It can come out slightly below zero; the root is then 0.
struct picture_error {
    std::size_t pixels = 0;
    double rmse = 0.0;
    double bias = 0.0; // mean(x - (a+b)/2), > 0: too bright
    double p99 = 0.0;  // of |x - (a+b)/2|, nearest rank; the references' noise is still in this one
};

// Preconditions: equal lengths. All zero for an empty mask.
[[nodiscard]] picture_error error_against(std::span<const float> x, std::span<const float> a, std::span<const float> b,
                                          std::span<const std::uint8_t> mask);

// The control: the error of the one constant picture that suits the references best. Who does not beat it has no signal.
[[nodiscard]] picture_error error_of_best_constant(std::span<const float> a, std::span<const float> b,
                                                   std::span<const std::uint8_t> mask);

struct agreement {
    std::size_t pixels = 0;
    std::size_t differing = 0; // in any bit, so +0 and -0 differ and a NaN agrees with itself
    double largest = 0.0;      // |x - y| over the differing pixels; infinite where either is NaN
};

[[nodiscard]] agreement agreement_of(std::span<const float> x, std::span<const float> y);

// Precondition for these: not empty.
[[nodiscard]] double mean_of(std::span<const double> values);
// The upper one of two.
[[nodiscard]] double median(std::vector<double> values);
// Nearest rank.
[[nodiscard]] double percentile_99(std::vector<double> values);

} // namespace ao::tools
