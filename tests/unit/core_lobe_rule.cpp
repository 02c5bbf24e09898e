// Designs for glossy lobes, and Gauss's rules that they are made of.
#include "ao/harmonics.hpp"
#include "ao/lobe_rule.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace {

constexpr double pi = 3.14159265358979323846;

double dot(const ao::direction3& a, const ao::direction3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace

TEST_CASE("A design for a lobe is exact for every harmonic up to its order, and not above", "[core][harmonics]")
{
    for (const double a : { 0.0, 1.0, 2.5, 50.0, 1000.0, 8192.0 }) {
        for (int order = 0; order <= 8; ++order) {
            const auto rule = ao::lobe_rule(a, order);
            REQUIRE(rule);
            CHECK(rule->domain == ao::rule_domain::lobe);
            CHECK(rule->order == order);
            CHECK(rule->size() == static_cast<std::size_t>((order + 1) * (order / 2 + 1)));
            std::array<double, ao::max_harmonics> sums{};
            double total = 0;
            for (std::size_t i = 0; i < rule->size(); ++i) {
                const ao::direction3& d = rule->directions[i];
                CHECK(std::abs(dot(d, d) - 1) < 1e-15);
                CHECK((d[2] > 0 && rule->weights[i] > 0));
                const auto values = ao::harmonics(d);
                for (std::size_t k = 0; k < ao::max_harmonics; ++k) {
                    sums[k] += rule->weights[i] * values[k];
                }
                total += rule->weights[i];
            }
            CHECK(std::abs(total - 1) < 1e-14);
            double within = 0;
            double above = 0;
            for (int l = 0; l <= std::min(order + 1, 8); ++l) {
                for (int m = -l; m <= l; ++m) {
                    const double exact = m == 0 ? std::sqrt((2 * l + 1) / (4 * pi)) * ao::lobe_factor(a, l) : 0;
                    double& worst = l <= order ? within : above;
                    worst = std::max(worst, std::abs(sums[ao::harmonic_index(l, m)] - exact));
                }
            }
            CHECK(within < 1e-14);
            // The ring's own harmonic, m = order + 1, is all on its directions, but small where the lobe is narrow.
            CHECK((order == 8 || above > 0.01 * std::pow(2 / (a + 2), (order + 1) / 2.0)));
        }
    }
}

TEST_CASE("Gauss's heights have the moments of their weight, up to large orders and exponents", "[core][harmonics]")
{
    for (const double a : { 0.0, 1.0, 7.25, 50.0, 1000.0, 8192.0 }) {
        for (const int count : { 1, 2, 3, 9, 32, 64 }) {
            const auto nodes = ao::detail::gauss_jacobi(a, count);
            double exact = 1; // of y^k: k! (a + 1)! / (a + k + 1)!
            for (int k = 0; k < 2 * count; ++k) {
                double sum = 0;
                for (const auto& node : nodes) {
                    sum += node.weight * std::pow(node.y, k);
                }
                // k roundings of the power and one per node of the sum.
                CHECK(std::abs(sum / exact - 1) < 1e-16 * (k + 4 * count) + 4e-15);
                exact *= (k + 1) / (a + k + 2);
            }
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                CHECK((nodes[i].y > (i == 0 ? 0 : nodes[i - 1].y) && nodes[i].y < 1 && nodes[i].weight > 0));
            }
        }
    }
    const auto reason = [](const ao::result<ao::sphere_rule>& rule) {
        return rule ? "no error" : std::string(rule.error().reason());
    };
    CHECK(reason(ao::lobe_rule(1, 128)) == "a lobe's order is 128, outside 0 ... 127");
    CHECK(reason(ao::lobe_rule(1, -1)) == "a lobe's order is -1, outside 0 ... 127");
    for (const double a : { -1e-9, 8192.5, std::nan("") }) {
        CHECK(reason(ao::lobe_rule(a, 3)) == "a lobe's exponent is outside 0 ... 8192");
    }
    CHECK(ao::lobe_rule(8192, 127)->size() == 8192);
}
