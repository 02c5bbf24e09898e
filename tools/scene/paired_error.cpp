#include "paired_error.hpp"

#include <algorithm>
#include <cmath>

namespace ao::tools {

void error_sums::add(double x, double y, double a, double b)
{
    ++pixels;
    square += ((x - a) * (x - b) + (y - a) * (y - b)) / 2.0;
    systematic += ((x - a) * (y - b) + (y - a) * (x - b)) / 2.0;
    between += (x - y) * (x - y) / 2.0;
    signed_sum += (x + y - a - b) / 2.0;
}

error_sums& error_sums::operator+=(const error_sums& s)
{
    pixels += s.pixels;
    square += s.square;
    systematic += s.systematic;
    between += s.between;
    signed_sum += s.signed_sum;
    return *this;
}

paired_error error_sums::result() const
{
    paired_error e;
    e.pixels = pixels;
    if (pixels == 0)
        return e;
    const auto count = static_cast<double>(pixels);
    const auto root = [&](double sum) { return std::sqrt(std::max(0.0, sum / count)); };
    e.rmse = root(square);
    e.systematic = root(systematic);
    e.deviation = root(between);
    e.bias = signed_sum / count;
    return e;
}

class_sums compare(const picture_pair& seen, const picture_pair& truth, std::span<const pixel_class> classes)
{
    class_sums sums{};
    for (std::size_t i = 0; i < classes.size(); ++i)
        sums[static_cast<std::size_t>(classes[i])].add(static_cast<double>(seen.x[i]), static_cast<double>(seen.y[i]),
                                                       static_cast<double>(truth.x[i]), static_cast<double>(truth.y[i]));
    return sums;
}

error_sums of_surfaces(const class_sums& sums)
{
    error_sums all;
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (static_cast<pixel_class>(i) != pixel_class::background)
            all += sums[i];
    return all;
}

double log_slope(std::span<const double> x, std::span<const double> y)
{
    double mean_x = 0.0, mean_y = 0.0;
    const auto count = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += std::log(x[i]) / count;
        mean_y += std::log(y[i]) / count;
    }
    double across = 0.0, along = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = std::log(x[i]) - mean_x;
        across += dx * (std::log(y[i]) - mean_y);
        along += dx * dx;
    }
    return across / along;
}

double percentile(std::vector<double> values, double share)
{
    const auto last = static_cast<double>(values.size() - 1);
    const auto rank = static_cast<std::ptrdiff_t>(std::lround(share * last));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

} // namespace ao::tools
