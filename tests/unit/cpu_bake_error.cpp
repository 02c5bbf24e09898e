// The error that finish_bake estimates, against the error.
#include "core_bake_meshes.hpp"

#include "ao/bake.hpp"
#include "ao/cpu/bake.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace bake_test;

namespace {

struct subject {
    mesh m;
    ao::bake_settings settings;

    ao::bake_result baked(const ao::sphere_rule& rule) const
    {
        const auto job = ao::prepare_bake(m.input(), rule, settings);
        REQUIRE(job);
        auto baker = ao::cpu::baker::create();
        REQUIRE(baker);
        const auto sums = baker->run(*job, {});
        REQUIRE(sums);
        return ao::finish_bake(*job, *sums);
    }

    // Root mean squares over vertices and rules: what is estimated by what it is.
    double estimated_by_true(const std::vector<ao::sphere_rule>& rules, const std::vector<float>& truth) const
    {
        double errors = 0;
        double estimates = 0;
        for (const ao::sphere_rule& rule : rules) {
            const ao::bake_result r = baked(rule);
            for (std::size_t i = 0; i < truth.size(); ++i) {
                const double error = static_cast<double>(r.coefficients[i]) - static_cast<double>(truth[i]);
                errors += error * error;
                estimates += static_cast<double>(r.errors[i]) * static_cast<double>(r.errors[i]);
            }
        }
        return std::sqrt(estimates / errors);
    }
};

subject make_subject(int which)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    mesh rough = sphere({ 0, 0, 0 }, 1, 3);
    for (glm::dvec3& p : rough.positions) {
        p *= 1 + 0.2 * uniform(random);
    }
    switch (which) {
    case 0:
        return { rough, {} };
    case 1:
        return { rough, { .coefficient = ao::bake_coefficient::cosine } };
    case 2: {
        mesh balls = sphere({ 0, 0, 0 }, 1, 3);
        append(balls, sphere({ 1.9, 0.3, 0 }, 0.8, 3));
        return { balls, {} };
    }
    default:
        return { box({ -1, -1, -1 }, { 2, 1, 1 }, 5, true), { .distance = 0.2, .falloff = ao::bake_falloff::linear } };
    }
}

} // namespace

TEST_CASE("estimated errors of random directions are true within a factor of 2, of spread ones from half to four times",
          "[bake][error]")
{
    const int which = GENERATE(0, 1, 2, 3);
    const subject s = make_subject(which);
    const std::vector<float> truth = s.baked(*ao::fibonacci_rule(40000)).coefficients;
    for (const int points : { 86, 1202 }) {
        // Several: the vertices of a mesh share the directions of a set, and with them its luck.
        std::vector<ao::sphere_rule> sets;
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            sets.push_back(*ao::marsaglia_rule(points, seed));
        }
        const double of_random = s.estimated_by_true(sets, truth);
        const double of_spread = s.estimated_by_true({ *ao::lebedev_rule(points) }, truth);
        CAPTURE(which, points, of_random, of_spread);
        CHECK(of_random > 0.5);
        CHECK(of_random < 2);
        CHECK(of_spread > 0.5);
        CHECK(of_spread < 4);
    }
}
