// Rules on the sphere: what they integrate exactly and what not, antipodes, moments, rotations.
#include "ao/sphere_rule.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;
using batch = std::array<double, 8>;

// Sums over a rule of weight times every real spherical harmonic up to `top`, whose mean square is 1: [l (l + 1) + m]. By the
// usual recurrence of normalised Legendre functions (Press et al., Numerical Recipes, 6.7), eight points at a time.
class harmonic_sums {
public:
    explicit harmonic_sums(int top) : top_(top), sums_(place(top, top) + 1)
    {
        for (int m = 0; m <= top; ++m) {
            for (int l = m + 1; l <= top; ++l) {
                const double ll = static_cast<double>(l) * l;
                const double before = (l - 1.0) * (l - 1.0);
                const double mm = static_cast<double>(m) * m;
                const double up = std::sqrt((4 * ll - 1) / (ll - mm));
                steps_.push_back({ up, l == m + 1 ? 0 : up * std::sqrt((before - mm) / (4 * before - 1)) });
            }
        }
    }

    void add(const std::vector<ao::direction3>& directions, const std::vector<double>& weights)
    {
        for (std::size_t start = 0; start < directions.size(); start += 8) {
            batch x{};
            batch y{};
            batch z{};
            batch weight{};
            for (std::size_t i = 0; i < 8 && start + i < directions.size(); ++i) {
                x[i] = directions[start + i][0];
                y[i] = directions[start + i][1];
                z[i] = directions[start + i][2];
                weight[i] = weights[start + i];
            }
            add(x, y, z, weight);
        }
    }

    double at(int l, int m) const { return sums_[place(l, m)]; }

    // The largest sum of degrees first ... last, but for the constant's deviation from 1.
    double worst(int first, int last) const
    {
        double most = 0;
        for (int l = first; l <= last; ++l) {
            for (int m = -l; m <= l; ++m) {
                most = std::max(most, std::abs(at(l, m) - (l == 0 ? 1 : 0)));
            }
        }
        return most;
    }

private:
    static std::size_t place(int l, int m)
    {
        const int index = l * (l + 1) + m;
        return static_cast<std::size_t>(index);
    }

    void add(const batch& x, const batch& y, const batch& z, const batch& weight)
    {
        batch cosine = weight; // weight times real and imaginary part of (x + i y)^m
        batch sine{};
        double sectoral = 1;
        std::size_t step = 0;
        for (int m = 0; m <= top_; ++m) {
            batch here;
            here.fill(sectoral);
            batch before{};
            for (int l = m;; ++l) {
                double even = 0;
                double odd = 0;
                for (std::size_t i = 0; i < 8; ++i) {
                    even += cosine[i] * here[i];
                    odd += sine[i] * here[i];
                }
                sums_[place(l, m)] += even;
                if (m > 0) {
                    sums_[place(l, -m)] += odd;
                }
                if (l == top_) {
                    break;
                }
                const auto [up, back] = steps_[step];
                ++step;
                for (std::size_t i = 0; i < 8; ++i) {
                    const double next = up * z[i] * here[i] - back * before[i];
                    before[i] = here[i];
                    here[i] = next;
                }
            }
            for (std::size_t i = 0; i < 8; ++i) {
                const double next = cosine[i] * x[i] - sine[i] * y[i];
                sine[i] = cosine[i] * y[i] + sine[i] * x[i];
                cosine[i] = next;
            }
            sectoral *= std::sqrt((2.0 * m + 3) / (2.0 * m + 2) * (m == 0 ? 2 : 1));
        }
    }

    int top_;
    std::vector<double> sums_;
    std::vector<std::array<double, 2>> steps_;
};

bool opposite(const ao::direction3& a, const ao::direction3& b)
{
    return a[0] == -b[0] && a[1] == -b[1] && a[2] == -b[2];
}

double dot(const ao::direction3& a, const ao::direction3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// What holds of every rule.
void check_shape(const ao::sphere_rule& rule)
{
    REQUIRE(rule.weights.size() == rule.directions.size());
    double sum = 0;
    double length_error = 0;
    std::size_t wrong_pairs = 0;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        sum += rule.weights[i];
        length_error = std::max(length_error, std::abs(std::sqrt(dot(rule.directions[i], rule.directions[i])) - 1));
        if (rule.antipodal && i % 2 == 1) {
            wrong_pairs += static_cast<std::size_t>(!opposite(rule.directions[i - 1], rule.directions[i]) ||
                                                    rule.weights[i - 1] != rule.weights[i]);
        }
    }
    CHECK(std::abs(sum - 1) < 1e-16 * static_cast<double>(rule.size()) + 1e-15);
    CHECK(length_error < 1e-15);
    CHECK(wrong_pairs == 0);
    CHECK((!rule.antipodal || rule.size() % 2 == 0));
}

} // namespace

TEST_CASE("The sums of harmonics that judge rules are those of the library's Legendre functions", "[core][rule]")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> height(-1, 1);
    for (int i = 0; i < 20; ++i) {
        const double z = height(random);
        const double angle = pi * height(random);
        const double across = std::sqrt(1 - z * z);
        harmonic_sums sums(132);
        sums.add({ { across * std::cos(angle), across * std::sin(angle), z } }, { 1 });
        for (const int l : { 0, 1, 2, 7, 64, 131, 132 }) {
            for (int m = 0; m <= l; m += 1 + l / 9) {
                const double legendre = std::sph_legendre(static_cast<unsigned>(l), static_cast<unsigned>(m), std::acos(z)) *
                                        std::sqrt((m == 0 ? 4 : 8) * pi) * (m % 2 == 0 ? 1 : -1);
                // std::acos(z) loses 1e-16 / across of the angle, and a harmonic changes by up to l^1.5 of that.
                const double most = 1e-13 + 1e-12 / across;
                CHECK(std::abs(sums.at(l, m) - legendre * std::cos(m * angle)) < most);
                CHECK((m == 0 || std::abs(sums.at(l, -m) - legendre * std::sin(m * angle)) < most));
            }
        }
    }
}

TEST_CASE("Lebedev's rules are exact for every harmonic up to their order and fail above it, however they are turned",
          "[core][rule]")
{
    for (const ao::lebedev_design& design : ao::lebedev_designs) {
        std::vector<ao::rotation3> rotations{ ao::no_rotation, ao::generic_rotation };
        if (design.order < 60) {
            rotations.push_back(ao::rotation_of_index(7));
        }
        for (const ao::rotation3& rotation : rotations) {
            const auto rule = ao::lebedev_rule(design.order, rotation, ao::negative_weights::allowed);
            REQUIRE(rule);
            INFO("order " << design.order);
            check_shape(*rule);
            CHECK(rule->antipodal);
            CHECK(rule->order == design.order);
            CHECK(static_cast<int>(rule->size()) == design.points);
            harmonic_sums sums(design.order + 1);
            sums.add(rule->directions, rule->weights);
            CHECK(sums.worst(0, design.order) < 2e-14);
            CHECK(sums.worst(design.order + 1, design.order + 1) > 0.1);
        }
    }
}

TEST_CASE("Turning a rule keeps its angles", "[core][rule]")
{
    const ao::sphere_rule plain = *ao::lebedev_rule(194, ao::no_rotation);
    for (const ao::rotation3& rotation : { ao::generic_rotation, ao::rotation_of_index(0), ao::rotation_of_index(12345) }) {
        const ao::sphere_rule turned = *ao::lebedev_rule(194, rotation);
        double worst = 0;
        double moved = 2;
        for (std::size_t i = 0; i < plain.size(); ++i) {
            moved = std::min(moved, 1 - dot(plain.directions[i], turned.directions[i]));
            for (std::size_t k = 0; k < plain.size(); ++k) {
                worst = std::max(worst, std::abs(dot(plain.directions[i], plain.directions[k]) -
                                                 dot(turned.directions[i], turned.directions[k])));
            }
        }
        CHECK(worst < 2e-15);
        CHECK(moved > 1e-6);
    }
}

TEST_CASE("No rule that is not turned on purpose has points on the planes along which models are built", "[core][rule]")
{
    for (const ao::lebedev_design& design : ao::lebedev_designs) {
        const ao::sphere_rule rule = *ao::lebedev_rule(design.order, ao::generic_rotation, ao::negative_weights::allowed);
        double nearest = 1;
        for (const ao::direction3& d : rule.directions) {
            for (int code = 14; code < 27; ++code) {
                const std::array<int, 3> digits{ code / 9, code / 3 % 3, code % 3 };
                const ao::direction3 normal{ digits[0] - 1.0, digits[1] - 1.0, digits[2] - 1.0 };
                nearest = std::min(nearest, std::abs(dot(d, normal)));
            }
        }
        INFO("order " << design.order);
        CHECK(nearest * design.points > 0.04);
    }
}

TEST_CASE("Rules of rotations by index are uniform and never repeat", "[core][rule]")
{
    // Each entry of a uniform random rotation has mean 0 and mean square 1/3, whose variance is 4/45.
    constexpr int count = 20000;
    std::array<double, 9> mean{};
    std::array<double, 9> square{};
    std::set<double> seen;
    for (std::uint32_t i = 0; i < count; ++i) {
        const ao::rotation3 r = ao::rotation_of_index(i);
        const std::array<double, 9> entries{ r.xx, r.xy, r.xz, r.yx, r.yy, r.yz, r.zx, r.zy, r.zz };
        for (std::size_t k = 0; k < 9; ++k) {
            mean[k] += entries[k] / count;
            square[k] += entries[k] * entries[k] / count;
        }
        seen.insert(r.xx);
        if (i < 100) {
            for (const ao::direction3& axis :
                 { ao::direction3{ 1, 0, 0 }, ao::direction3{ 0, 1, 0 }, ao::direction3{ 0, 0, 1 } }) {
                CHECK(std::abs(dot(ao::rotated(r, axis), ao::rotated(r, axis)) - 1) < 2e-15);
            }
        }
    }
    for (std::size_t k = 0; k < 9; ++k) {
        CHECK(std::abs(mean[k]) < 4 * std::sqrt(1.0 / 3 / count));
        CHECK(std::abs(square[k] - 1.0 / 3) < 4 * std::sqrt(4.0 / 45 / count));
    }
    CHECK(seen.size() > count - 20U);
}

TEST_CASE("A rule about +z turns to any normal", "[core][rule]")
{
    std::mt19937 random(5);
    std::normal_distribution<double> component;
    std::vector<ao::direction3> normals{ { 0, 0, 1 },     { 0, 0, -1 },      { 1, 0, 0 },  { 0, -1, 0 },
                                         { 1e-9, 0, -1 }, { 0, 1e-300, -1 }, { -1, 0, 0 }, { 0, -1e-8, -1 } };
    for (int i = 0; i < 1000; ++i) {
        const ao::direction3 d{ component(random), component(random), component(random) };
        const double length = std::sqrt(dot(d, d));
        normals.push_back({ d[0] / length, d[1] / length, d[2] / length });
    }
    for (const ao::direction3& n : normals) {
        const ao::rotation3 r = ao::rotation_to(n);
        const ao::direction3 z = ao::rotated(r, { 0, 0, 1 });
        const ao::direction3 x = ao::rotated(r, { 1, 0, 0 });
        const ao::direction3 y = ao::rotated(r, { 0, 1, 0 });
        CHECK(std::abs(z[0] - n[0]) + std::abs(z[1] - n[1]) + std::abs(z[2] - n[2]) < 2e-15);
        const double handed =
            x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
        CHECK(std::abs(handed - 1) < 4e-15);
        CHECK(std::abs(dot(x, y)) + std::abs(dot(x, z)) + std::abs(dot(y, z)) < 4e-15);
    }
}

TEST_CASE("Marsaglia's points have the moments of uniform independent ones", "[core][rule]")
{
    constexpr int count = 40000;
    const auto rule = ao::marsaglia_rule(count, 11);
    REQUIRE(rule);
    check_shape(*rule);
    CHECK(rule->order == -1);
    CHECK_FALSE(rule->antipodal);
    harmonic_sums sums(4);
    sums.add(rule->directions, rule->weights);
    for (int l = 1; l <= 4; ++l) {
        for (int m = -l; m <= l; ++m) {
            // Mean square 1, so a standard error of N^-1/2.
            CHECK(std::abs(sums.at(l, m)) < 4 / std::sqrt(static_cast<double>(count)));
        }
    }
    CHECK(sums.worst(1, 4) > 0.2 / std::sqrt(static_cast<double>(count))); // far from evenly spread
    CHECK(ao::marsaglia_rule(10, 1)->directions != ao::marsaglia_rule(10, 2)->directions);
    CHECK(ao::marsaglia_rule(10, 1)->directions == ao::marsaglia_rule(10, 1)->directions);
}

TEST_CASE("Fibonacci points of any number cover every cap evenly", "[core][rule]")
{
    for (const bool pairs : { false, true }) {
        for (const int count : { 2, 8, 98, 1000, 20002 }) {
            const auto rule = pairs ? ao::fibonacci_pairs_rule(count) : ao::fibonacci_rule(count);
            REQUIRE(rule);
            REQUIRE(static_cast<int>(rule->size()) == count);
            check_shape(*rule);
            CHECK(rule->antipodal == pairs);
            std::mt19937 random(3);
            std::normal_distribution<double> component;
            double worst = 0;
            for (int i = 0; i < 50; ++i) {
                const ao::direction3 axis{ component(random), component(random), component(random) };
                const double length = std::sqrt(dot(axis, axis));
                for (const double edge : { -0.5, 0.0, 0.7 }) {
                    const auto inside = std::count_if(rule->directions.begin(), rule->directions.end(),
                                                      [&](const auto& d) { return dot(d, axis) > edge * length; });
                    worst = std::max(worst, std::abs(static_cast<double>(inside) / count - (1 - edge) / 2));
                }
            }
            // C N^-3/4: the spherical cap discrepancy of evenly spread points, C about 1 (Aistleitner, Brauchart and Dick, 2012).
            CHECK(worst < 1.5 * std::pow(count, -0.75));
        }
    }
    CHECK(ao::fibonacci_rule(1)->size() == 1);
}

TEST_CASE("Halton points fill the hemisphere uniformly or by its cosine", "[core][rule]")
{
    for (const bool cosine : { false, true }) {
        const auto rule = ao::halton_rule(4096, cosine ? ao::rule_domain::cosine_hemisphere : ao::rule_domain::hemisphere);
        REQUIRE(rule);
        check_shape(*rule);
        double above = 0;
        double z = 0;
        double zz = 0;
        double x = 0;
        double xx = 0;
        for (const ao::direction3& d : rule->directions) {
            above += d[2] > 0 ? 1 : 0;
            z += d[2] / 4096;
            zz += d[2] * d[2] / 4096;
            x += d[0] / 4096;
            xx += d[0] * d[0] / 4096;
        }
        CHECK(above == 4096);
        // Discrepancy of 4096 Halton points, (log2 N)^2 / N with the constant of bases 2 and 3 (below 0.4).
        const double most = 0.4 * 144 / 4096;
        CHECK(std::abs(z - (cosine ? 2.0 / 3 : 1.0 / 2)) < most);
        CHECK(std::abs(zz - (cosine ? 1.0 / 2 : 1.0 / 3)) < most);
        CHECK(std::abs(x) < most);
        CHECK(std::abs(xx - (cosine ? 1.0 / 4 : 1.0 / 3)) < most);
    }
}
