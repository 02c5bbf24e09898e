// Rules on the sphere: what they integrate exactly and what not, antipodes, moments, text.
#include "ao/octahedral_order.hpp"
#include "ao/rule_text.hpp"
#include "ao/sphere_rule.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;
using batch = std::array<double, 8>;

// Sums over a rule of weight times every real spherical harmonic up to `top`, whose mean square is 1: [l (l + 1) + m]. By the
// usual recurrence of normalised Legendre functions (Press et al., Numerical Recipes, 6.7), eight points at a time.
class harmonic_sums {
public:
    explicit harmonic_sums(int top) : top_(top), sums_(static_cast<std::size_t>((top + 1) * (top + 1)))
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

    double at(int l, int m) const { return sums_[static_cast<std::size_t>(l * (l + 1) + m)]; }

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
                sums_[static_cast<std::size_t>(l * (l + 1) + m)] += even;
                if (m > 0) {
                    sums_[static_cast<std::size_t>(l * (l + 1) - m)] += odd;
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

std::string reason(const ao::result<ao::sphere_rule>& rule)
{
    return rule ? "no error" : std::string(rule.error().reason());
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
        for (const ao::rotation3& rotation : { ao::no_rotation, ao::generic_rotation, ao::rotation_of_index(7) }) {
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
                const ao::direction3 normal{ code / 9 - 1.0, code / 3 % 3 - 1.0, code % 3 - 1.0 };
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
    CHECK(reason(ao::fibonacci_pairs_rule(9)) == "pairs of antipodes need an even number of points, not 9");
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
    CHECK(reason(ao::halton_rule(16, ao::rule_domain::sphere)) == "Halton rules are for hemispheres");
}

TEST_CASE("Rules that do not exist or would be unsafe are refused with a reason", "[core][rule]")
{
    CHECK(reason(ao::lebedev_rule(33)) ==
          "there is no Lebedev rule of order 33; nearest: order 31, 350 points or order 35, 434 points");
    CHECK(reason(ao::lebedev_rule(100)) ==
          "there is no Lebedev rule of 100 points; nearest: order 15, 86 points or order 17, 110 points");
    CHECK(reason(ao::lebedev_rule(1)) == "there is no Lebedev rule of order 1; nearest: order 3, 6 points");
    CHECK(reason(ao::lebedev_rule(-4)) == "there is no Lebedev rule of -4 points; nearest: order 3, 6 points");
    CHECK(reason(ao::lebedev_rule(10000)) == "there is no Lebedev rule of 10000 points; nearest: order 131, 5810 points");
    for (const int number : { 13, 74, 25, 230, 27, 266 }) {
        CHECK(reason(ao::lebedev_rule(number)).find("negative weights") != std::string::npos);
        CHECK(ao::lebedev_rule(number, ao::generic_rotation, ao::negative_weights::allowed));
    }
    for (const ao::lebedev_design& design : ao::lebedev_designs) {
        CHECK(ao::lebedev_rule(design.order).has_value() == !design.negative);
        CHECK(ao::lebedev_rule(design.points).has_value() == !design.negative);
    }
    const int most = ao::max_rule_points;
    for (const int count : { -1, 0, most + 1 }) {
        const std::string text = "a rule of " + std::to_string(count) + " points; 1 to 4194304 are possible";
        CHECK(reason(ao::fibonacci_rule(count)) == text);
        CHECK(reason(ao::fibonacci_pairs_rule(count)) == text);
        CHECK(reason(ao::marsaglia_rule(count, 1)) == text);
        CHECK(reason(ao::halton_rule(count, ao::rule_domain::hemisphere)) == text);
    }
}

TEST_CASE("Rules have names", "[core][rule]")
{
    CHECK(ao::named_rule("lebedev:5810")->order == 131);
    CHECK(ao::named_rule("lebedev:131")->size() == 5810);
    CHECK(ao::named_rule("lebedev:13", ao::negative_weights::allowed)->size() == 74);
    CHECK(ao::named_rule("fibonacci:77")->directions == ao::fibonacci_rule(77)->directions);
    CHECK(ao::named_rule("fibonacci-pairs:78")->antipodal);
    CHECK(ao::named_rule("marsaglia:9")->directions == ao::marsaglia_rule(9, 1)->directions);
    CHECK(ao::named_rule("marsaglia:9:4")->directions == ao::marsaglia_rule(9, 4)->directions);
    CHECK(ao::named_rule("halton:5")->domain == ao::rule_domain::hemisphere);
    CHECK(ao::named_rule("halton-cosine:5")->domain == ao::rule_domain::cosine_hemisphere);
    CHECK(reason(ao::named_rule("lebedev:13")).find("negative weights") != std::string::npos);
    CHECK(reason(ao::named_rule("lebedev")) == "'' is not a whole number");
    CHECK(reason(ao::named_rule("lebedev:")) == "'' is not a whole number");
    CHECK(reason(ao::named_rule("lebedev:12x")) == "'12x' is not a whole number");
    CHECK(reason(ao::named_rule("fibonacci:99999999999")) == "'99999999999' is not a whole number");
    CHECK(reason(ao::named_rule("fibonacci:5:6")) == "'5:6' is not a whole number");
    CHECK(reason(ao::named_rule("marsaglia:5:")) == "'' is not a whole number");
    CHECK(reason(ao::named_rule("")).find("there is no rule ''") == 0);
    CHECK(reason(ao::named_rule("sobol:5")).find("there is no rule 'sobol'; there are lebedev") == 0);
}

TEST_CASE("A rule that was written down is read back, paired and normalised", "[core][rule]")
{
    const ao::sphere_rule rule = *ao::lebedev_rule(50);
    std::string text = "# fifty points\n\n";
    std::mt19937 random(2);
    std::vector<std::size_t> order(rule.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t i : order) {
        char line[200];
        std::snprintf(line, sizeof line, " %.17g\t%.17g,%.17g %.17g # point\r\n", rule.directions[i][0], rule.directions[i][1],
                      rule.directions[i][2], rule.weights[i] * 4 * pi);
        text += line;
    }
    text.pop_back();
    const auto read = ao::parse_rule(text);
    INFO(reason(read));
    REQUIRE(read);
    CHECK(read->antipodal);
    check_shape(*read);
    harmonic_sums sums(12);
    sums.add(read->directions, read->weights);
    CHECK(sums.worst(0, 11) < 2e-14);
    CHECK(sums.worst(12, 12) > 0.1);
}

TEST_CASE("A rule without antipodes stays in its order", "[core][rule]")
{
    const auto three = ao::parse_rule("0 0 1 2\n1 0 0 1\n0 1 0 1");
    REQUIRE(three);
    CHECK_FALSE(three->antipodal);
    CHECK(three->weights == std::vector<double>{ 0.5, 0.25, 0.25 });
    CHECK(three->directions[1] == ao::direction3{ 1, 0, 0 });
    const auto unequal = ao::parse_rule("0 0 1 2\n0 0 -1 1\n");
    REQUIRE(unequal);
    CHECK_FALSE(unequal->antipodal);
    const auto twice = ao::parse_rule("0 0 1 1\n0 0 1 1\n");
    REQUIRE(twice);
    CHECK_FALSE(twice->antipodal);
    // Signed zeros and pairs that occur twice.
    const auto zeros = ao::parse_rule("0 -0 1 1\n-0 0 -1 1\n0 0 1 1\n0 0 -1 1");
    REQUIRE(zeros);
    CHECK(zeros->antipodal);
    check_shape(*zeros);
}

TEST_CASE("What is not a rule is refused with its line", "[core][rule]")
{
    const std::map<std::string, std::string> cases{
        { "", "the rule has no points" },
        { "# nothing\n\n  \n", "the rule has no points" },
        { "0 0 1 1\n0 0 1\n", "rule, line 2: needs four numbers, x y z and a weight" },
        { "0 0 1 1 1", "rule, line 1: needs four numbers, x y z and a weight" },
        { "x y z w", "rule, line 1: needs four numbers, x y z and a weight" },
        { "0 0 1 1e", "rule, line 1: needs four numbers, x y z and a weight" },
        { "0 0 1 1;", "rule, line 1: needs four numbers, x y z and a weight" },
        { std::string("0 0 1 1\0", 8), "rule, line 1: needs four numbers, x y z and a weight" },
        { "0 0 1 1e999", "rule, line 1: needs four numbers, x y z and a weight" },
        { "\n\nnan 0 1 1", "rule, line 3: a number is not finite" },
        { "0 0 1 inf", "rule, line 1: a number is not finite" },
        { "0 0 1.1 1", "rule, line 1: the direction is not of length 1" },
        { "0 0 0 1", "rule, line 1: the direction is not of length 1" },
        { "1e300 1e300 0 1", "rule, line 1: the direction is not of length 1" },
        { "0 0 1 -1", "rule, line 1: the weight is negative: occlusion can leave [0, 1]; it must be asked for" },
        { "0 0 1 0\n1 0 0 0", "the rule's weights have no positive, finite sum" },
        { "0 0 1 1e308\n1 0 0 1e308", "the rule's weights have no positive, finite sum" },
        { "0 0 1 1e-320", "the rule's weights have no positive, finite sum" },
    };
    for (const auto& [text, what] : cases) {
        CHECK(reason(ao::parse_rule(text)) == what);
    }
    CHECK(reason(ao::parse_rule("0 0 1 -1\n1 0 0 1", ao::negative_weights::allowed)) ==
          "the rule's weights have no positive, finite sum");
    CHECK(ao::parse_rule("0 0 1 -1\n1 0 0 3", ao::negative_weights::allowed)->weights == std::vector<double>{ -0.5, 1.5 });
    std::string many;
    many.reserve((static_cast<std::size_t>(ao::max_rule_points) + 1) * 8);
    for (int i = 0; i <= ao::max_rule_points; ++i) {
        many += "0 0 1 1\n";
    }
    CHECK(reason(ao::parse_rule(many)) == "rule, line 4194305: more than 4194304 points");
}

TEST_CASE("Sorted directions point alike", "[core][rule]")
{
    for (const char* name : { "lebedev:5810", "fibonacci:5001" }) {
        const ao::sphere_rule plain = *ao::named_rule(name);
        ao::sphere_rule sorted = plain;
        ao::sort_octahedral(sorted);
        check_shape(sorted);
        CHECK(sorted.antipodal == plain.antipodal);
        const auto contents = [](const ao::sphere_rule& rule) {
            std::multimap<ao::direction3, double> all;
            for (std::size_t i = 0; i < rule.size(); ++i) {
                all.emplace(rule.directions[i], rule.weights[i]);
            }
            return all;
        };
        CHECK(contents(plain) == contents(sorted));
        // Over packets of 16 of `count` directions on a part of the sphere, 1 - |mean direction|: its mean. 16 directions in a
        // cap, of radius 8 sqrt(part / count), have 16 part / count. A curve's pieces are longer than wide, hence twice that.
        // Unsorted sets spread over the sphere.
        const auto spread = [&](const std::vector<std::uint32_t>& order) {
            double sum = 0;
            int packets = 0;
            for (std::size_t start = 0; start + 16 <= order.size(); start += 16) {
                ao::direction3 mean{};
                for (std::size_t i = start; i < start + 16; ++i) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        mean[k] += sorted.directions[order[i]][k] / 16;
                    }
                }
                sum += 1 - std::sqrt(dot(mean, mean));
                ++packets;
            }
            return sum / packets;
        };
        const double cap = 16 / static_cast<double>(sorted.size());
        CHECK(spread(ao::octahedral_order(sorted.directions)) < 2 * cap);
        std::vector<std::uint32_t> stored;
        for (std::uint32_t i = 0; i < sorted.size(); i += sorted.antipodal ? 2 : 1) {
            stored.push_back(i);
        }
        CHECK(spread(stored) < 2 * cap);
        const std::vector<std::uint32_t> order = ao::octahedral_order(sorted.directions);
        CHECK(std::set<std::uint32_t>(order.begin(), order.end()).size() == sorted.size());
        if (plain.antipodal) {
            for (std::size_t i = 2; i < sorted.size(); i += 2) {
                REQUIRE(sorted.directions[i][2] >= 0);
                REQUIRE(ao::octahedral_place(sorted.directions[i - 2]) <= ao::octahedral_place(sorted.directions[i]));
            }
        }
    }
}

TEST_CASE("Places on the octahedron's square are those of the shared map", "[core][rule]")
{
    std::mt19937 random(9);
    std::uniform_real_distribution<double> side(-1, 1);
    for (int i = 0; i < 10000; ++i) {
        const double u = side(random);
        const double v = side(random);
        const auto d = ao::math<double>::ao_octahedral_direction(u, v);
        const std::uint32_t place = ao::octahedral_place({ d.x, d.y, d.z });
        // From the finest square to the coarsest, the curve's own definition: four copies, the first and last mirrored.
        std::uint32_t column = 0;
        std::uint32_t row = 0;
        for (unsigned level = 0; level < 16; ++level) {
            const std::uint32_t side_length = 1U << level;
            const std::uint32_t quarter = place >> 2 * level & 3U;
            if (quarter == 0) {
                std::swap(column, row);
            }
            else if (quarter == 3) {
                std::swap(column, row);
                column = 2 * side_length - 1 - column;
                row = side_length - 1 - row;
            }
            else {
                row += side_length;
                column += quarter == 2 ? side_length : 0;
            }
        }
        // A place is a cell of side 2 / 65535.
        CHECK(std::abs(column / 32767.5 - 1 - u) < 1.001 / 32767.5);
        CHECK(std::abs(row / 32767.5 - 1 - v) < 1.001 / 32767.5);
    }
}
