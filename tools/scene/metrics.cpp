#include "metrics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ao::tools {
namespace {

template <class Picture>
picture_error measure(Picture x, std::span<const float> a, std::span<const float> b, std::span<const std::uint8_t> mask)
{
    picture_error e;
    double square = 0.0, difference = 0.0;
    std::vector<double> sizes;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] == 0)
            continue;
        const double to_a = x(i) - static_cast<double>(a[i]);
        const double to_b = x(i) - static_cast<double>(b[i]);
        square += to_a * to_b;
        difference += (to_a + to_b) / 2.0;
        sizes.push_back(std::abs(to_a + to_b) / 2.0);
    }
    e.pixels = sizes.size();
    if (sizes.empty())
        return e;
    const auto count = static_cast<double>(sizes.size());
    e.rmse = std::sqrt(std::max(0.0, square / count));
    e.bias = difference / count;
    e.p99 = percentile_99(std::move(sizes));
    return e;
}

} // namespace

picture_error error_against(std::span<const float> x, std::span<const float> a, std::span<const float> b,
                            std::span<const std::uint8_t> mask)
{
    return measure([&](std::size_t i) { return static_cast<double>(x[i]); }, a, b, mask);
}

picture_error error_of_best_constant(std::span<const float> a, std::span<const float> b, std::span<const std::uint8_t> mask)
{
    const double minus_best = measure([](std::size_t) { return 0.0; }, a, b, mask).bias;
    return measure([&](std::size_t) { return -minus_best; }, a, b, mask);
}

agreement agreement_of(std::span<const float> x, std::span<const float> y)
{
    agreement result;
    result.pixels = x.size();
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (std::bit_cast<std::uint32_t>(x[i]) == std::bit_cast<std::uint32_t>(y[i]))
            continue;
        ++result.differing;
        const double size = std::abs(static_cast<double>(x[i]) - static_cast<double>(y[i]));
        result.largest = std::max(result.largest, size >= 0.0 ? size : std::numeric_limits<double>::infinity());
    }
    return result;
}

double mean_of(std::span<const double> values)
{
    double sum = 0.0;
    for (const double v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double percentile_99(std::vector<double> values)
{
    const std::size_t rank = (values.size() * 99 + 99) / 100 - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
    return values[rank];
}

} // namespace ao::tools
