// Kernels have the densities that their names say (numerics.md W1): chi-square, moments against closed forms, edges.
#include "ao/kernel.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;

// Upper 1 % point of the chi-square distribution (Wilson and Hilferty 1931; within .1 % for the degrees used here).
double critical(int degrees)
{
    const double n = degrees;
    const double z = 2.3263478740408408;
    return n * std::pow(1 - 2 / (9 * n) + z * std::sqrt(2 / (9 * n)), 3);
}

// Chi-square of points that `uniform` maps to uniform ones in the unit cube. Fails on points outside it.
double chi_square(int cells, int count, const std::function<glm::dvec3()>& uniform)
{
    std::vector<int> hits(static_cast<std::size_t>(cells * cells * cells), 0);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 u = uniform();
        REQUIRE((u.x >= 0 && u.x <= 1 && u.y >= 0 && u.y <= 1 && u.z >= 0 && u.z <= 1));
        const auto cell = [&](double x) { return std::min(static_cast<int>(x * cells), cells - 1); };
        ++hits[static_cast<std::size_t>((cell(u.x) * cells + cell(u.y)) * cells + cell(u.z))];
    }
    const double expected = static_cast<double>(count) / static_cast<double>(hits.size());
    double sum = 0;
    for (const int n : hits) {
        sum += (n - expected) * (n - expected) / expected;
    }
    return sum;
}

double azimuth(const glm::dvec3& s)
{
    const double turns = std::atan2(s.y, s.x) / (2 * pi);
    return turns < 0 ? turns + 1 : turns;
}

double radius(const glm::dvec3& s)
{
    return std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
}

constexpr int cells = 10;
constexpr int count = 400000;

glm::vec3 random_box_offset(ao::random_stream& random)
{
    const float u = random.uniform();
    const float v = random.uniform();
    return ao::box_offset(u, v, random.uniform());
}

glm::vec3 random_half_ball_offset(ao::random_stream& random)
{
    const double u = static_cast<double>(random.uniform());
    const double v = static_cast<double>(random.uniform());
    return ao::half_ball_offset(u, v, static_cast<double>(random.uniform()));
}

glm::vec3 random_cosine_offset(ao::random_stream& random)
{
    const double u = static_cast<double>(random.uniform());
    const double v = static_cast<double>(random.uniform());
    return ao::cosine_linear_offset(u, v, static_cast<double>(random.uniform()));
}

} // namespace

TEST_CASE("The box kernel is uniform in the half box", "[core][kernel]")
{
    ao::random_stream random(GENERATE(1U, 2U, 99U));
    const double statistic = chi_square(cells, count, [&] {
        const glm::dvec3 s(random_box_offset(random));
        return glm::dvec3(s.x * 0.5 + 0.5, s.y * 0.5 + 0.5, s.z);
    });
    CHECK(statistic < critical(cells * cells * cells - 1));
}

TEST_CASE("The hemisphere kernel is uniform in the half ball", "[core][kernel]")
{
    ao::random_stream random(GENERATE(1U, 2U, 99U));
    const double statistic = chi_square(cells, count, [&] {
        const glm::dvec3 s(random_half_ball_offset(random));
        const double r = radius(s);
        return glm::dvec3(azimuth(s), s.z / r, std::min(r * r * r, 1.0));
    });
    CHECK(statistic < critical(cells * cells * cells - 1));
}

TEST_CASE("The halton kernel's warp is cosine-weighted and uniform in distance", "[core][kernel]")
{
    ao::random_stream random(GENERATE(1U, 2U, 99U));
    const double statistic = chi_square(cells, count, [&] {
        const glm::dvec3 s(random_cosine_offset(random));
        const double r = radius(s);
        const double cosine = r > 0 ? s.z / r : 0;
        return glm::dvec3(azimuth(s), std::min(cosine * cosine, 1.0), std::min(r, 1.0));
    });
    CHECK(statistic < critical(cells * cells * cells - 1));
}

TEST_CASE("Stratified numbers: one per stratum, in random order", "[core][kernel]")
{
    const int n = GENERATE(1, 2, 7, 32, 1000, ao::max_taps);
    ao::random_stream random(8);
    double correlation = 0;
    const int rounds = 200;
    for (int round = 0; round < rounds; ++round) {
        const auto numbers = ao::stratified(random, n);
        std::vector<int> hits(static_cast<std::size_t>(n), 0);
        for (int i = 0; i < n; ++i) {
            const float x = numbers[static_cast<std::size_t>(i)];
            REQUIRE((x >= 0.0F && x < 1.0F));
            ++hits[static_cast<std::size_t>(std::min(static_cast<int>(static_cast<double>(x) * n), n - 1))];
            correlation += (static_cast<double>(x) - 0.5) * ((i + 0.5) / n - 0.5) * 12 / n / rounds;
        }
        // A number rounded up onto a stratum's edge counts for its neighbour.
        const auto wrong = std::count_if(hits.begin(), hits.end(), [](int h) { return h != 1; });
        REQUIRE(wrong <= 2);
    }
    // Of the place in the list with the number: standard error 1 / sqrt(n rounds).
    CHECK(std::abs(correlation) < 4 / std::sqrt(static_cast<double>(n) * rounds));
}

TEST_CASE("Random kernels have their density's mean, over seeds", "[core][kernel]")
{
    const auto type = GENERATE(ao::method::box, ao::method::hemisphere);
    const int taps = GENERATE(1, 5, 32);
    glm::dvec3 mean(0);
    double zz = 0;
    const int seeds = 4000;
    for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(seeds); ++seed) {
        const auto kernel = ao::make_kernel(type, taps, seed);
        for (int i = 0; i < taps; ++i) {
            const glm::dvec3 s(kernel[static_cast<std::size_t>(i)]);
            mean = mean + s * (1.0 / (taps * seeds));
            zz += s.z * s.z / (taps * seeds);
        }
    }
    const bool box = type == ao::method::box;
    const double error = 4 * std::sqrt(1.0 / 3 / (taps * seeds));
    CHECK(std::abs(mean.x) < error);
    CHECK(std::abs(mean.y) < error);
    CHECK(std::abs(mean.z - (box ? 1.0 / 2 : 3.0 / 8)) < error);
    CHECK(std::abs(zz - (box ? 1.0 / 3 : 1.0 / 5)) < error);
}

TEST_CASE("A planted fault of density is caught", "[core][kernel]")
{
    // A few percent too many at one side.
    ao::random_stream random(1);
    const double statistic = chi_square(cells, count, [&] {
        const glm::dvec3 s(random_box_offset(random));
        return glm::dvec3(std::pow(s.x * 0.5 + 0.5, 1.02), s.y * 0.5 + 0.5, s.z);
    });
    CHECK(statistic > critical(cells * cells * cells - 1));
}

TEST_CASE("Moments of the densities are the closed forms", "[core][kernel]")
{
    struct moments {
        const char* name;
        std::function<glm::vec3(ao::random_stream&)> draw;
        double z;
        double zz;
        double xx;
        double r;
    };
    const moments boxes{ "box", random_box_offset, 1.0 / 2, 1.0 / 3, 1.0 / 3, -1 };
    const moments balls{ "hemisphere", random_half_ball_offset, 3.0 / 8, 1.0 / 5, 1.0 / 5, 3.0 / 4 };
    const moments cosines{ "cosine", random_cosine_offset, 1.0 / 3, 1.0 / 6, 1.0 / 12, 1.0 / 2 };
    const moments& m = GENERATE_REF(boxes, balls, cosines);
    INFO(m.name);
    ao::random_stream random(3);
    double x = 0;
    double y = 0;
    double z = 0;
    double zz = 0;
    double xx = 0;
    double yy = 0;
    double r = 0;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 s(m.draw(random));
        x += s.x / count;
        y += s.y / count;
        z += s.z / count;
        zz += s.z * s.z / count;
        xx += s.x * s.x / count;
        yy += s.y * s.y / count;
        r += radius(glm::dvec3(s)) / count;
    }
    // No quantity here has a variance above 1/3.
    const double error = 4 * std::sqrt(1.0 / 3 / count);
    CHECK(std::abs(x) < error);
    CHECK(std::abs(y) < error);
    CHECK(std::abs(z - m.z) < error);
    CHECK(std::abs(zz - m.zz) < error);
    CHECK(std::abs(xx - m.xx) < error);
    CHECK(std::abs(yy - m.xx) < error);
    if (m.r > 0) {
        CHECK(std::abs(r - m.r) < error);
    }
}

TEST_CASE("The Halton kernel's moments converge like 1 / N", "[core][kernel]")
{
    const int taps = GENERATE(32, 128, 1024);
    const auto kernel = ao::make_kernel(ao::method::halton, taps, 1);
    glm::dvec3 mean(0);
    double zz = 0;
    for (int i = 0; i < taps; ++i) {
        const glm::dvec3 s(kernel[static_cast<std::size_t>(i)]);
        mean = mean + s * (1.0 / taps);
        zz += s.z * s.z / taps;
    }
    // Star discrepancy of a Halton set in three dimensions times the variation, with a factor to spare below N = 32; random
    // sets miss this at N = 1024 by a factor of about three.
    const double most = 2.0 / taps;
    CHECK(std::abs(mean.x) < most);
    CHECK(std::abs(mean.y) < most);
    CHECK(std::abs(mean.z - 1.0 / 3) < most);
    CHECK(std::abs(zz - 1.0 / 6) < most);
}

TEST_CASE("The warp can be undone, and its edges are inside", "[core][kernel]")
{
    const double last = 1 - 1.0 / 16777216;
    ao::random_stream random(5);
    for (int i = 0; i < 20000; ++i) {
        const double u = static_cast<double>(random.uniform());
        const double v = 0.01 + 0.99 * static_cast<double>(random.uniform());
        const double w = static_cast<double>(random.uniform());
        const glm::dvec3 s(ao::cosine_linear_offset(u, v, w));
        const double r = radius(s);
        const double cosine = s.z / r;
        CHECK(std::abs(r - v) < 1e-5);
        CHECK(std::abs(cosine * cosine - w) < 1e-5);
        const double across = std::sqrt(1 - w);
        if (across > 0.01) {
            const double turn = std::abs(azimuth(s) - u);
            CHECK(std::min(turn, 1 - turn) * across * v < 1e-5);
        }
    }
    for (const double u : { 0.0, 0.5, last }) {
        for (const double v : { 0.0, 0.5, last }) {
            for (const double w : { 0.0, 0.5, last }) {
                const glm::dvec3 s(ao::cosine_linear_offset(u, v, w));
                CHECK(s.z >= 0);
                CHECK(radius(s) <= v + 4e-8);
            }
        }
    }
}

TEST_CASE("Every kernel stays in its solid for any number of taps and any seed", "[core][kernel]")
{
    const auto type = GENERATE(ao::method::box, ao::method::hemisphere, ao::method::halton);
    for (const std::uint32_t seed : { 0U, 1U, 12345U, 0xffffffffU }) {
        for (const int taps : { 1, 32, ao::max_taps }) {
            const auto kernel = ao::make_kernel(type, taps, seed);
            for (int i = 0; i < ao::max_taps; ++i) {
                const glm::vec4& s = kernel[static_cast<std::size_t>(i)];
                CHECK(s.z >= 0.0F);
                CHECK(s.w == 0.0F);
                CHECK((std::abs(s.x) <= 1.0F && std::abs(s.y) <= 1.0F && s.z <= 1.0F));
                CHECK((type == ao::method::box || radius(glm::dvec3(s)) <= 1 + 1e-7));
                CHECK((i < taps || (s.x == 0.0F && s.y == 0.0F && s.z == 0.0F)));
            }
        }
    }
}

TEST_CASE("The tile of rotations fills the square evenly, and the seed changes it", "[core][kernel]")
{
    const auto tile = ao::make_rotation_tile(1);
    int hits[8][8] = {};
    for (const glm::vec2& h : tile) {
        REQUIRE((h.x >= -1.0F && h.x < 1.0F && h.y >= -1.0F && h.y < 1.0F));
        ++hits[static_cast<int>((h.x + 1) * 4)][static_cast<int>((h.y + 1) * 4)];
    }
    double statistic = 0;
    const double expected = static_cast<double>(tile.size()) / 64;
    for (const auto& row : hits) {
        for (const int n : row) {
            statistic += (n - expected) * (n - expected) / expected;
        }
    }
    CHECK(statistic < critical(63));
    CHECK(ao::make_rotation_tile(2) != tile);
}
