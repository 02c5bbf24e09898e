// The sampling-noise law (numerics.md 1.2): visibility of one straight occluder edge at a random place, cosine-weighted
// directions. Random taps converge like N^-0.5, the Halton kernel faster than N^-0.7.
#include "ao/kernel.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace {

// On the unit disc, to which cosine-weighted directions project uniformly: the share on the near side of a line at
// distance h from the centre.
double share(double h)
{
    return (std::acos(-h) + h * std::sqrt(1 - h * h)) / 3.14159265358979323846;
}

struct disc_point {
    double x;
    double y;
};

std::vector<disc_point> halton_directions(int count)
{
    std::vector<disc_point> points;
    const auto kernel = ao::make_kernel(ao::method::halton, count, 1);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 s(kernel[static_cast<std::size_t>(i)]);
        const double r = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
        points.push_back({ s.x / r, s.y / r });
    }
    return points;
}

std::vector<disc_point> random_directions(int count, ao::random_stream& random)
{
    std::vector<disc_point> points;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 s(
            ao::cosine_linear_offset(static_cast<double>(random.uniform()), 1.0, static_cast<double>(random.uniform())));
        points.push_back({ s.x, s.y });
    }
    return points;
}

struct error_law {
    double slope; // of log RMSE against log N
    double at_16; // RMSE
};

// N = 16 ... 512; `points` is asked anew for every problem.
template <class Points>
error_law measure(Points points)
{
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const int problems = 4000;
    std::vector<double> x;
    std::vector<double> y;
    double at_16 = 0;
    for (int count = 16; count <= 512; count *= 2) {
        double squares = 0;
        for (int i = 0; i < problems; ++i) {
            // The edge's orientation is the rotation of the pixel's frame.
            const double angle = 6.283185307179586 * unit(engine);
            const double h = 1.8 * unit(engine) - 0.9;
            int seen = 0;
            for (const disc_point& p : points(count)) {
                seen += std::cos(angle) * p.x + std::sin(angle) * p.y < h ? 1 : 0;
            }
            const double e = static_cast<double>(seen) / count - share(h);
            squares += e * e / problems;
        }
        x.push_back(std::log(static_cast<double>(count)));
        y.push_back(0.5 * std::log(squares));
        if (count == 16) {
            at_16 = std::sqrt(squares);
        }
    }
    double mean_x = 0;
    double mean_y = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / static_cast<double>(x.size());
        mean_y += y[i] / static_cast<double>(x.size());
    }
    double above = 0;
    double below = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        above += (x[i] - mean_x) * (y[i] - mean_y);
        below += (x[i] - mean_x) * (x[i] - mean_x);
    }
    return { above / below, at_16 };
}

} // namespace

TEST_CASE("Halton taps converge faster than random ones", "[core][noise]")
{
    ao::random_stream random(1);
    const error_law control = measure([&](int count) { return random_directions(count, random); });
    std::vector<std::vector<disc_point>> sets(1025);
    const error_law halton = measure([&](int count) -> const std::vector<disc_point>& {
        auto& set = sets[static_cast<std::size_t>(count)];
        if (set.empty()) {
            set = halton_directions(count);
        }
        return set;
    });
    CAPTURE(control.slope, control.at_16, halton.slope, halton.at_16);
    CHECK(control.slope > -0.53);
    CHECK(control.slope < -0.47);
    CHECK(halton.slope <= -0.70);
    CHECK(halton.at_16 < 0.7 * control.at_16);
}
