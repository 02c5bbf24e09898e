// Routes of the CPU against the reference: the same bits.
#include "core_bake_meshes.hpp"

#include "ao/bake.hpp"
#include "ao/conformance/bake_reference.hpp"
#include "ao/cpu/bake.hpp"

#include <catch2/catch.hpp>

#include <random>
#include <string>
#include <vector>

using namespace bake_test;

namespace {

// A sphere with noise, and what real models have: faces doubled and turned, holes, T-junctions, slivers.
mesh broken(int levels, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    mesh m = sphere({ 0.3, 0.1, -0.2 }, 1, levels);
    for (glm::dvec3& p : m.positions) {
        p *= 1 + 0.3 * uniform(random);
        p = glm::dvec3(glm::vec3(p));
    }
    const std::size_t faces = m.indices.size() / 3;
    const auto face = [&] { return 3 * (random() % faces); };
    for (std::size_t i = 0; i < faces / 10; ++i) {
        const std::size_t f = face();
        const std::uint32_t a = m.indices[f];
        const std::uint32_t b = m.indices[f + 1];
        const std::uint32_t c = m.indices[f + 2];
        switch (random() % 4) {
        case 0: // twice
            m.indices.insert(m.indices.end(), { a, b, c });
            break;
        case 1: // turned
            std::swap(m.indices[f], m.indices[f + 1]);
            break;
        case 2: { // a T-junction
            const auto middle = static_cast<std::uint32_t>(m.positions.size());
            m.positions.push_back((m.positions[a] + m.positions[b]) * 0.5);
            m.indices[f] = middle;
            m.indices.insert(m.indices.end(), { a, middle, c });
            break;
        }
        default: { // a sliver across
            const std::uint32_t far_off = m.indices[face()];
            m.indices.insert(m.indices.end(), { a, b, far_off });
        }
        }
    }
    return m;
}

ao::cpu::baker make(ao::cpu::width lanes = ao::cpu::width::automatic, int threads = 0)
{
    auto made = ao::cpu::baker::create({ .lanes = lanes, .threads = threads });
    REQUIRE(made);
    return std::move(*made);
}

void check_same(const ao::bake_job& job, ao::cpu::baker& baker, ao::bake_route route, const ao::bake_sums& wanted)
{
    const auto sums = baker.run(job, { .route = route });
    INFO((sums ? std::string() : std::string(sums.error().reason())));
    REQUIRE(sums);
    REQUIRE(sums->holds(job));
    std::size_t differing = 0;
    for (std::size_t i = 0; i < wanted.sums.size(); ++i) {
        differing += sums->sums[i] == wanted.sums[i] ? 0 : 1;
    }
    CHECK(differing == 0);
}

} // namespace

TEST_CASE("every route gives the reference's bits", "[bake][cpu]")
{
    const mesh m = broken(GENERATE(1, 2), 7);
    const auto rule = GENERATE(0, 1) == 0 ? ao::lebedev_rule(110) : ao::fibonacci_rule(75);
    const double inf = std::numeric_limits<double>::infinity();
    const ao::bake_settings settings = GENERATE_COPY(
        ao::bake_settings{}, ao::bake_settings{ .coefficient = ao::bake_coefficient::cosine, .bent_normals = true },
        ao::bake_settings{ .distance = 0.1, .falloff = ao::bake_falloff::linear },
        ao::bake_settings{ .distance = 0.3, .falloff = ao::bake_falloff::smooth, .ground = true, .ground_height = -0.5 },
        ao::bake_settings{ .distance = 0.05 },
        ao::bake_settings{ .distance = inf, .sides = ao::bake_sides::front, .ground = true, .ground_height = -0.9 });
    const auto job = ao::prepare_bake(m.input(), *rule, settings);
    REQUIRE(job);
    const auto wanted = ao::bake_reference(*job);
    REQUIRE(wanted);
    for (const ao::cpu::width lanes :
         { ao::cpu::width::scalar, ao::cpu::width::lanes4, ao::cpu::width::lanes8, ao::cpu::width::lanes16 }) {
        if (!ao::cpu::is_available(lanes)) {
            continue;
        }
        ao::cpu::baker baker = make(lanes, 2);
        for (const ao::bake_route route : { ao::bake_route::brute, ao::bake_route::raster, ao::bake_route::hierarchy }) {
            CAPTURE(name_of(lanes), static_cast<int>(route));
            check_same(*job, baker, route, *wanted);
        }
    }
}
