#include "scene/metrics.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using namespace ao::tools;

struct pictures {
    std::vector<float> x, truth, a, b;
    std::vector<std::uint8_t> mask;
};

// A truth, a picture with a known error, two references whose noise has the given standard deviation.
pictures make(std::size_t n, double picture_sd, double offset, double noise_sd, unsigned seed)
{
    std::mt19937 bits(seed);
    std::normal_distribution<double> normal;
    pictures p;
    for (std::size_t i = 0; i < n; ++i) {
        const double t = 0.3 + 0.4 * static_cast<double>(i % 97) / 97.0;
        p.truth.push_back(static_cast<float>(t));
        p.x.push_back(static_cast<float>(t + offset + picture_sd * normal(bits)));
        p.a.push_back(static_cast<float>(t + noise_sd * normal(bits)));
        p.b.push_back(static_cast<float>(t + noise_sd * normal(bits)));
        p.mask.push_back(i % 5 == 0 ? 0 : 1);
    }
    return p;
}

} // namespace

TEST_CASE("error without reference noise is the plain error", "[tools][metrics]")
{
    const pictures p = make(4001, 0.05, 0.01, 0.0, 1);
    const picture_error e = error_against(p.x, p.truth, p.truth, p.mask);

    double square = 0.0, sum = 0.0;
    std::vector<double> sizes;
    for (std::size_t i = 0; i < p.x.size(); ++i)
        if (p.mask[i] != 0) {
            const double d = static_cast<double>(p.x[i]) - static_cast<double>(p.truth[i]);
            square += d * d;
            sum += d;
            sizes.push_back(std::abs(d));
        }
    const auto n = static_cast<double>(sizes.size());
    std::sort(sizes.begin(), sizes.end());
    CHECK(e.pixels == sizes.size());
    CHECK(e.rmse == Approx(std::sqrt(square / n)).epsilon(1e-12));
    CHECK(e.bias == Approx(sum / n).epsilon(1e-9));
    CHECK(e.p99 == sizes[static_cast<std::size_t>(std::ceil(0.99 * n)) - 1]);
}

TEST_CASE("noise of the references stays out of the error", "[tools][metrics]")
{
    constexpr double sd = 0.02, noise = 0.08;
    constexpr std::size_t n = 50000;
    const double pixels = n * 0.8;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const pictures p = make(n, sd, 0.0, noise, seed);
        const picture_error e = error_against(p.x, p.a, p.b, p.mask);
        // (d - m)(d - k) with independent d, m, k: variance 2 sd^4 + 2 sd^2 noise^2 + noise^4.
        const double spread = std::sqrt((2.0 * std::pow(sd, 4) + 2.0 * sd * sd * noise * noise + std::pow(noise, 4)) / pixels);
        CHECK(std::abs(e.rmse * e.rmse - sd * sd) < 4.5 * spread);
        // The control: one reference used twice takes its noise for the picture's error.
        const picture_error naive = error_against(p.x, p.a, p.a, p.mask);
        CHECK(naive.rmse == Approx(std::hypot(sd, noise)).epsilon(0.03));
    }
}

TEST_CASE("a perfect picture's error is never below zero", "[tools][metrics]")
{
    const pictures p = make(64, 0.0, 0.0, 0.05, 3);
    CHECK(error_against(p.truth, p.a, p.b, p.mask).rmse >= 0.0);
    const std::vector<std::uint8_t> none(64, 0);
    const picture_error empty = error_against(p.x, p.a, p.b, none);
    CHECK(empty.pixels == 0);
    CHECK(empty.rmse == 0.0);
}

TEST_CASE("no constant beats the best constant", "[tools][metrics]")
{
    const pictures p = make(5000, 0.0, 0.0, 0.03, 4);
    const picture_error best = error_of_best_constant(p.a, p.b, p.mask);
    CHECK(std::abs(best.bias) < 1e-12);
    for (float c = 0.0f; c <= 1.0f; c += 0.01f) {
        const std::vector<float> constant(p.x.size(), c);
        CHECK(error_against(constant, p.a, p.b, p.mask).rmse >= best.rmse - 1e-9);
    }
}

TEST_CASE("agreement counts pixels whose bits differ", "[tools][metrics]")
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> x{ 0.0f, 0.5f, 1.0f, nan, 0.25f };
    CHECK(agreement_of(x, x).differing == 0);
    CHECK(agreement_of(x, x).pixels == 5);

    std::vector<float> y = x;
    y[0] = -0.0f;
    y[1] = std::nextafter(0.5f, 1.0f);
    y[4] = 0.5f;
    const agreement a = agreement_of(x, y);
    CHECK(a.differing == 3);
    CHECK(a.largest == 0.25);
    y[3] = 0.5f;
    CHECK(agreement_of(x, y).differing == 4);
    CHECK(std::isinf(agreement_of(x, y).largest));
}
