// Things with clocks of their own, measured against each other in one run.
#pragma once

#include "ao/result.hpp"
#include "host/result.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace ao::bench {

[[noreturn]] inline void stop(const std::string& why)
{
    std::fprintf(stderr, "ao: %s\n", why.c_str());
    std::exit(1);
}

template <class T>
T take(ao::result<T> r)
{
    if (!r) {
        stop(std::string(r.error().reason()));
    }
    return std::move(*r);
}

template <class T>
T take(host::result<T> r)
{
    if (!r) {
        stop(r.reason());
    }
    return std::move(*r);
}

// Something with a clock of its own.
struct contestant {
    std::string name;
    std::function<double()> run; // milliseconds
    std::vector<double> times;

    double median() const
    {
        std::vector<double> sorted = times;
        std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
        return sorted[sorted.size() / 2];
    }
};

// Round by round, in random order, after one round for warming up.
inline void measure(std::vector<contestant>& field, int rounds = 15)
{
    std::mt19937 engine(1);
    std::vector<std::size_t> order(field.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
        field[i].run();
    }
    for (int round = 0; round < rounds; ++round) {
        std::shuffle(order.begin(), order.end(), engine);
        for (const std::size_t i : order) {
            field[i].times.push_back(field[i].run());
        }
    }
}

// ms = start + slope * x by least squares, and the largest distance from that line relative to the greatest time.
struct line {
    double start;
    double slope;
    double bend;
};

inline line fit(const std::vector<double>& x, const std::vector<double>& y)
{
    const auto n = static_cast<double>(x.size());
    double mean_x = 0;
    double mean_y = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / n;
        mean_y += y[i] / n;
    }
    double above = 0;
    double below = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        above += (x[i] - mean_x) * (y[i] - mean_y);
        below += (x[i] - mean_x) * (x[i] - mean_x);
    }
    const double slope = above / below;
    double bend = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        bend = std::max(bend, std::abs(y[i] - mean_y - slope * (x[i] - mean_x)));
    }
    return { mean_y - slope * mean_x, slope, bend / *std::max_element(y.begin(), y.end()) };
}

} // namespace ao::bench
