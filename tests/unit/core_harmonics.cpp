// Spherical harmonics, and light averaged by lobes.
#include "ao/ambient.hpp"
#include "ao/harmonic_light.hpp"
#include "ao/lobe_rule.hpp"
#include "ao/rule_order.hpp"
#include "ao/rule_text.hpp"
#include "core_support.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;

double dot(const ao::direction3& a, const ao::direction3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::vector<ao::direction3> random_directions(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> component;
    std::vector<ao::direction3> directions;
    for (int i = 0; i < count; ++i) {
        const ao::direction3 d{ component(random), component(random), component(random) };
        const double length = std::sqrt(dot(d, d));
        directions.push_back({ d[0] / length, d[1] / length, d[2] / length });
    }
    return directions;
}

ao::harmonic_series<double> random_series(int order, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    ao::harmonic_series<double> series{ .order = order, .coefficients = {} };
    for (std::size_t i = 0; i < ao::harmonic_count(order); ++i) {
        series.coefficients[i] = value(random);
    }
    return series;
}

ao::rotation3 product(const ao::rotation3& a, const ao::rotation3& b)
{
    const ao::direction3 x = ao::rotated(a, { b.xx, b.yx, b.zx });
    const ao::direction3 y = ao::rotated(a, { b.xy, b.yy, b.zy });
    const ao::direction3 z = ao::rotated(a, { b.xz, b.yz, b.zz });
    return { x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0 };
}

double apart(const ao::harmonic_series<double>& a, const ao::harmonic_series<double>& b)
{
    double most = 0;
    for (std::size_t i = 0; i < ao::max_harmonics; ++i) {
        most = std::max(most, std::abs(a.coefficients[i] - b.coefficients[i]));
    }
    return most;
}

} // namespace

TEST_CASE("Harmonics are those of the library's Legendre functions, without the Condon-Shortley sign", "[core][harmonics]")
{
    for (const ao::direction3& d : random_directions(200, 1)) {
        const auto values = ao::harmonics(d);
        const double across = std::hypot(d[0], d[1]);
        const double polar = std::atan2(across, d[2]);
        const double azimuth = std::atan2(d[1], d[0]);
        for (int l = 0; l <= 8; ++l) {
            for (int m = 0; m <= l; ++m) {
                const double legendre = std::sph_legendre(static_cast<unsigned>(l), static_cast<unsigned>(m), polar) *
                                        (m == 0 ? 1 : std::sqrt(2.0)) * (m % 2 == 0 ? 1 : -1);
                CHECK(std::abs(values[ao::harmonic_index(l, m)] - legendre * std::cos(m * azimuth)) < 2e-14);
                if (m > 0) {
                    CHECK(std::abs(values[ao::harmonic_index(l, -m)] - legendre * std::sin(m * azimuth)) < 2e-14);
                }
            }
        }
        for (int order = 0; order < 8; ++order) {
            const auto fewer = ao::harmonics(d, order);
            for (std::size_t i = 0; i < ao::max_harmonics; ++i) {
                CHECK(fewer[i] == (i < ao::harmonic_count(order) ? values[i] : 0));
            }
        }
    }
}

TEST_CASE("Harmonics are orthonormal over the sphere", "[core][harmonics]")
{
    const ao::sphere_rule rule = *ao::lebedev_rule(17);
    std::vector<std::array<double, ao::max_harmonics>> values;
    for (const ao::direction3& d : rule.directions) {
        values.push_back(ao::harmonics(d));
    }
    double worst = 0;
    for (std::size_t i = 0; i < ao::max_harmonics; ++i) {
        for (std::size_t k = 0; k <= i; ++k) {
            double sum = 0;
            for (std::size_t p = 0; p < rule.size(); ++p) {
                sum += 4 * pi * rule.weights[p] * values[p][i] * values[p][k];
            }
            worst = std::max(worst, std::abs(sum - (i == k ? 1 : 0)));
        }
    }
    CHECK(worst < 2e-14);
}

TEST_CASE("Projection finds the coefficients of a series, and of a function in closed form", "[core][harmonics]")
{
    for (int order = 0; order <= 8; ++order) {
        const auto series = random_series(order, 3);
        CHECK(apart(ao::project<double>(*ao::lebedev_rule(17), order, series), series) < 2e-14);
    }
    // exp(k u.x) = sum (2 l + 1) i_l(k) P_l(u.x), i_l the modified spherical Bessel functions: here k = 2, u = z.
    const auto series = ao::project<double>(*ao::lebedev_rule(59), 8, [](const ao::direction3& d) { return std::exp(2 * d[2]); });
    for (int l = 0; l <= 8; ++l) {
        const double bessel = std::sqrt(pi / 4) * std::cyl_bessel_i(l + 0.5, 2.0);
        CHECK(std::abs(series.coefficients[ao::harmonic_index(l, 0)] - std::sqrt(4 * pi * (2 * l + 1)) * bessel) < 1e-13);
        for (int m = 1; m <= l; ++m) {
            CHECK(std::abs(series.coefficients[ao::harmonic_index(l, m)]) < 1e-13);
            CHECK(std::abs(series.coefficients[ao::harmonic_index(l, -m)]) < 1e-13);
        }
    }
}

TEST_CASE("Turned coefficients are those of the turned function", "[core][harmonics]")
{
    for (int order = 0; order <= 8; ++order) {
        const auto series = random_series(order, 5);
        for (const std::uint32_t index : { 1U, 2U, 3U }) {
            const ao::rotation3 rotation = ao::rotation_of_index(index);
            const auto turned = ao::rotated(rotation, series);
            for (const ao::direction3& d : random_directions(20, index)) {
                CHECK(std::abs(turned(ao::rotated(rotation, d)) - series(d)) < 2e-13);
            }
            CHECK(apart(ao::rotated(ao::inverse(rotation), turned), series) < 5e-14);
            const ao::rotation3 second = ao::rotation_of_index(index + 10);
            CHECK(apart(ao::rotated(second, turned), ao::rotated(product(second, rotation), series)) < 5e-14);
            // Degrees do not mix, and keep their energy.
            for (int l = 0; l <= order; ++l) {
                double before = 0;
                double after = 0;
                for (int m = -l; m <= l; ++m) {
                    before += std::pow(series.coefficients[ao::harmonic_index(l, m)], 2);
                    after += std::pow(turned.coefficients[ao::harmonic_index(l, m)], 2);
                }
                CHECK(std::abs(before - after) < 1e-13);
            }
        }
        CHECK(apart(ao::rotated(ao::no_rotation, series), series) < 5e-14);
    }
}

TEST_CASE("Factors of lobes are their integrals with Legendre polynomials", "[core][harmonics]")
{
    for (const double a : { 0.0, 0.5, 1.0, 2.5, 10.0, 300.0, 8192.0 }) {
        for (unsigned l = 0; l <= 8; ++l) {
            // Mean of P_l(t) over the lobe: with u = t^(a + 1) uniform in 0 ... 1, by the middles of 20000 cells.
            double sum = 0;
            for (int i = 0; i < 20000; ++i) {
                sum += std::legendre(l, std::pow((i + 0.5) / 20000, 1 / (a + 1))) / 20000;
            }
            // Near u = 0 the integrand is like u^(1 / (a + 1)): its first cell, of 1 / 20000, is the error.
            CHECK(std::abs(ao::lobe_factor(a, static_cast<int>(l)) - sum) < 1.0 / 20000);
        }
    }
    CHECK(ao::lobe_factor(1, 0) == 1);
    CHECK(std::abs(ao::lobe_factor(1, 1) - 2.0 / 3) < 1e-15);
    CHECK(ao::lobe_factor(1, 2) == 0.25);
    CHECK(ao::lobe_factor(1, 3) == 0);
    CHECK(std::abs(ao::lobe_factor(1, 4) + 1.0 / 24) < 1e-16);
}

TEST_CASE("Light averaged by harmonics is that averaged by a design, by the lobe's definition, and the ambient light of scenes",
          "[core][harmonics]")
{
    const auto light = random_series(8, 8);
    const ao::sphere_rule many = *ao::fibonacci_rule(200000);
    for (const double a : { 1.0, 2.0, 20.0 }) {
        const auto averaged = ao::averaged(light, a);
        const ao::sphere_rule design = *ao::lobe_rule(a, 8);
        for (const ao::direction3& r : random_directions(4, 4)) {
            double by_design = 0;
            const ao::rotation3 rotation = ao::rotation_to(r);
            for (std::size_t i = 0; i < design.size(); ++i) {
                by_design += design.weights[i] * light(ao::rotated(rotation, design.directions[i]));
            }
            CHECK(std::abs(averaged(r) - by_design) < 2e-14);
            double by_definition = 0;
            for (std::size_t i = 0; i < many.size(); ++i) {
                const double along = dot(many.directions[i], r);
                if (along > 0) {
                    by_definition += many.weights[i] * light(many.directions[i]) * (2 * a + 2) * std::pow(along, a);
                }
            }
            // The lobe has a kink at the horizon: N^-5/4 (vertex-ao.md 5.1 for N^-3/4 without a factor that vanishes there),
            // times the lobe's and the light's size.
            CHECK(std::abs(averaged(r) - by_definition) < std::pow(many.size(), -1.25) * (2 * a + 2) * 4);
        }
    }
    std::array<glm::dvec3, 9> nine{};
    for (std::size_t i = 0; i < 9; ++i) {
        nine[i] = glm::dvec3(light.coefficients[i], 0, 1);
    }
    auto low = light;
    low.order = 2;
    const auto averaged = ao::averaged(low, 1);
    const ao::ambient_light ambient = ao::ambient_of_harmonics(nine);
    for (const ao::direction3& n : random_directions(50, 6)) {
        const double x = n[0];
        const double y = n[1];
        const double z = n[2];
        const std::array<double, 9> polynomials{ 1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y };
        double sum = 0;
        for (std::size_t i = 0; i < 9; ++i) {
            sum += static_cast<double>(ambient.coefficients[i].x) * polynomials[i];
        }
        // Nine coefficients rounded to float.
        CHECK(std::abs(sum - averaged(n)) < 9 * 6e-8);
    }
}

namespace {

template <class Real>
std::vector<std::array<double, 3>> lights(const ao::packed_harmonics& packed, const std::vector<std::array<float, 3>>& normals)
{
    return core_test::evaluate<Real>(normals, [&](const std::array<Real, 3>& n) {
        return core_test::parts(ao::light_of_harmonics<Real>(packed, { n[0], n[1], n[2] }));
    });
}

} // namespace

TEST_CASE("Packed light is the same in every lane and near that in double", "[core][harmonics]")
{
    for (const int order : { 0, 1, 2, 5, 8 }) {
        ao::harmonic_series<glm::dvec3> light{ .order = order, .coefficients = {} };
        for (std::size_t i = 0; i < ao::harmonic_count(order); ++i) {
            light.coefficients[i] = { random_series(8, 1).coefficients[i], random_series(8, 2).coefficients[i],
                                      random_series(8, 3).coefficients[i] };
        }
        const ao::packed_harmonics packed = ao::pack_harmonics(light);
        std::vector<std::array<float, 3>> normals{ { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 }, { 0, -1, 0 } };
        core_test::directions random(7);
        for (int i = 0; i < 1000; ++i) {
            normals.push_back(random.next());
        }
        const auto scalar = lights<float>(packed, normals);
        CHECK(scalar == lights<core_test::lanes8>(packed, normals));
        CHECK(scalar == lights<core_test::lanes16>(packed, normals));
        double worst = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const glm::dvec3 exact = light(
                { static_cast<double>(normals[i][0]), static_cast<double>(normals[i][1]), static_cast<double>(normals[i][2]) });
            for (int channel = 0; channel < 3; ++channel) {
                worst = std::max(worst, std::abs(scalar[i][static_cast<std::size_t>(channel)] - exact[channel]));
            }
        }
        // Up to 81 terms of size below 2 with about 2 l roundings each of 6e-8, which add like a random walk, four times that.
        CHECK(worst < 4 * std::sqrt(static_cast<double>(ao::harmonic_count(order)) * (2 * order + 4)) * 2 * 6e-8);
    }
}

TEST_CASE("The exact order of a rule is found", "[core][harmonics]")
{
    for (const ao::lebedev_design& design : ao::lebedev_designs) {
        const auto rule = ao::lebedev_rule(design.order, ao::generic_rotation, ao::negative_weights::allowed);
        CHECK(ao::exact_order(*rule, 140) == design.order);
        CHECK(ao::exact_order(*rule, 2) == 2);
    }
    CHECK(ao::exact_order(*ao::fibonacci_rule(1000)) == 0);
    CHECK(ao::exact_order(*ao::fibonacci_pairs_rule(1000)) == 1);
    CHECK(ao::exact_order(*ao::marsaglia_rule(1000, 1)) == 0);
    // The regular tetrahedron.
    CHECK(ao::exact_order(*ao::parse_rule("0.57735026918962573 0.57735026918962573 0.57735026918962573 1\n"
                                          "0.57735026918962573 -0.57735026918962573 -0.57735026918962573 1\n"
                                          "-0.57735026918962573 0.57735026918962573 -0.57735026918962573 1\n"
                                          "-0.57735026918962573 -0.57735026918962573 0.57735026918962573 1\n")) == 2);
    ao::sphere_rule heavy = *ao::lebedev_rule(3);
    heavy.weights[0] *= 2;
    CHECK(ao::exact_order(heavy) == -1);
}
