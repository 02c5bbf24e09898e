// Rules by name, from text, and refused; the order in which their directions are stored.
#include "ao/octahedral_order.hpp"
#include "ao/rule_order.hpp"
#include "ao/rule_text.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

double dot(const ao::direction3& a, const ao::direction3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool opposite_pairs(const ao::sphere_rule& rule)
{
    for (std::size_t i = 0; i < rule.size(); i += 2) {
        const ao::direction3& a = rule.directions[i];
        const ao::direction3& b = rule.directions[i + 1];
        if (a[0] != -b[0] || a[1] != -b[1] || a[2] != -b[2] || rule.weights[i] != rule.weights[i + 1]) {
            return false;
        }
    }
    return rule.size() % 2 == 0;
}

std::string reason(const ao::result<ao::sphere_rule>& rule)
{
    return rule ? "no error" : std::string(rule.error().reason());
}

} // namespace

TEST_CASE("Rules that do not exist or would be unsafe are refused with a reason", "[core][rule]")
{
    CHECK(reason(ao::lebedev_rule(33)) ==
          "there is no Lebedev rule of order 33; nearest: order 31, 350 points or order 35, 434 points");
    CHECK(reason(ao::lebedev_rule(100)) ==
          "there is no Lebedev rule of 100 points; nearest: order 15, 86 points or order 17, 110 points");
    CHECK(reason(ao::lebedev_rule(1)) == "there is no Lebedev rule of order 1; nearest: order 3, 6 points");
    CHECK(reason(ao::lebedev_rule(-4)) == "there is no Lebedev rule of -4 points; nearest: order 3, 6 points");
    CHECK(reason(ao::lebedev_rule(10000)) == "there is no Lebedev rule of 10000 points; nearest: order 131, 5810 points");
    CHECK(reason(ao::halton_rule(16, ao::rule_domain::sphere)) == "Halton rules are for hemispheres");
    CHECK(reason(ao::halton_rule(16, ao::rule_domain::lobe)) == "Halton rules are for hemispheres");
    CHECK(reason(ao::fibonacci_pairs_rule(9)) == "pairs of antipodes need an even number of points, not 9");
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
    CHECK(opposite_pairs(*read));
    CHECK(ao::exact_order(*read, 20, 1e-14) == 11);
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
    CHECK(opposite_pairs(*zeros));
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
        CHECK((!plain.antipodal || opposite_pairs(sorted)));
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
