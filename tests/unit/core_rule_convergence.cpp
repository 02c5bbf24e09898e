// How errors fall with the number of directions: on visibility, which jumps, as N^-3/4 for every evenly spread rule and as N^-1/2
// for independent random directions; on smooth functions Lebedev's rules fall faster than any power.
#include "ao/sphere_rule.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;

double dot(const ao::direction3& a, const ao::direction3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ao::direction3 cross(const ao::direction3& a, const ao::direction3& b)
{
    return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

struct triangle {
    std::array<ao::direction3, 3> edges; // inside where all products are positive
    double part;                         // of the sphere
};

// Random spherical triangles, with the solid angle by A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30, 1983.
std::vector<triangle> triangles(int count)
{
    std::mt19937 random(1);
    std::normal_distribution<double> component;
    std::vector<triangle> made;
    while (static_cast<int>(made.size()) < count) {
        std::array<ao::direction3, 3> corners{};
        for (ao::direction3& c : corners) {
            c = { component(random), component(random), component(random) };
            const double length = std::sqrt(dot(c, c));
            c = { c[0] / length, c[1] / length, c[2] / length };
        }
        const auto& [a, b, c] = corners;
        const double volume = dot(a, cross(b, c));
        if (volume > 0) {
            const double angle = 2 * std::atan2(volume, 1 + dot(a, b) + dot(b, c) + dot(c, a));
            made.push_back({ { cross(a, b), cross(b, c), cross(c, a) }, angle / (4 * pi) });
        }
    }
    return made;
}

// Root mean square error over the triangles.
double error_of(const ao::sphere_rule& rule, const std::vector<triangle>& all)
{
    double squares = 0;
    for (const triangle& t : all) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.size(); ++i) {
            const ao::direction3& d = rule.directions[i];
            sum += dot(d, t.edges[0]) > 0 && dot(d, t.edges[1]) > 0 && dot(d, t.edges[2]) > 0 ? rule.weights[i] : 0;
        }
        squares += (sum - t.part) * (sum - t.part);
    }
    return std::sqrt(squares / static_cast<double>(all.size()));
}

// Of the line through (log N, log error), by least squares.
double slope(const std::vector<std::array<double, 2>>& points)
{
    double x = 0;
    double y = 0;
    double xx = 0;
    double xy = 0;
    for (const auto& [size, error] : points) {
        const double u = std::log(size);
        const double v = std::log(error);
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const auto n = static_cast<double>(points.size());
    return (n * xy - x * y) / (n * xx - x * x);
}

} // namespace

TEST_CASE("Errors on visibility fall as N^-3/4 for spread rules, as N^-1/2 for random ones", "[core][rule]")
{
    struct kind {
        const char* name;
        std::function<ao::sphere_rule(int)> make;
        double power;
    };
    const std::vector<kind> kinds{
        { "lebedev", [](int n) { return *ao::lebedev_rule(n); }, -0.75 },
        { "lebedev turned at random", [](int n) { return *ao::lebedev_rule(n, ao::rotation_of_index(17)); }, -0.75 },
        { "fibonacci", [](int n) { return *ao::fibonacci_rule(n); }, -0.75 },
        { "fibonacci pairs", [](int n) { return *ao::fibonacci_pairs_rule(n); }, -0.75 },
        { "marsaglia", [](int n) { return *ao::marsaglia_rule(n, 5); }, -0.5 },
    };
    const std::vector<triangle> all = triangles(2000);
    for (const kind& k : kinds) {
        std::vector<std::array<double, 2>> points;
        for (const int n : { 86, 194, 434, 974, 2354, 5810 }) {
            points.push_back({ static_cast<double>(n), error_of(k.make(n), all) });
        }
        INFO(k.name << ": error " << points.back()[1] << " at " << points.back()[0]);
        CAPTURE(slope(points));
        // Six errors of one rule each. A random set's error scatters by some 10 % (its triangles share directions), which over a
        // factor of 68 in N moves the slope by 0.03; spread sets scatter less.
        CHECK(std::abs(slope(points) - k.power) < (k.power == -0.75 ? 0.03 : 0.06));
        if (k.power == -0.75) {
            // Of 5810 directions, from vertex-ao.md 5.1 for real meshes: 1e-3 of half the directions, so half of that here.
            CHECK(points.back()[1] < 1e-3);
        }
        else {
            CHECK(points.back()[1] > 3e-3);
        }
    }
}

TEST_CASE("On a smooth function Lebedev's rules are exact to rounding at 194 points, others keep their powers", "[core][rule]")
{
    // The mean of exp(5 u.x) is sinh(5) / 5.
    const double exact = std::sinh(5.0) / 5;
    const auto worst = [&](const ao::sphere_rule& rule) {
        double most = 0;
        for (std::uint32_t k = 0; k < 20; ++k) {
            const ao::direction3 u = ao::rotated(ao::rotation_of_index(k), { 0, 0, 1 });
            double sum = 0;
            for (std::size_t i = 0; i < rule.size(); ++i) {
                sum += rule.weights[i] * std::exp(5 * dot(u, rule.directions[i]));
            }
            most = std::max(most, std::abs(sum / exact - 1));
        }
        return most;
    };
    CHECK(worst(*ao::lebedev_rule(38)) < 3e-3);
    CHECK(worst(*ao::lebedev_rule(194)) < 1e-13);
    CHECK(worst(*ao::fibonacci_rule(194)) > 1e-5);
    CHECK(worst(*ao::marsaglia_rule(194, 2)) > 1e-2);
}
