// One source, every Real type: lanes give the bits of float, intervals hold them, double is what float rounds.
#include "unit/core_pictures.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>

using namespace core_test;

namespace {

// Eight inputs, sixteen results: everything in one table.
template <class Real>
auto all_functions(const std::array<Real, 8>& in)
{
    using m = ao::math<Real>;
    using vec3 = typename m::vec3;
    const vec3 a(in[0], in[1], in[2]);
    const vec3 b(in[3], in[4], in[5]);
    const vec3 n = m::ao_normalize_or(a, vec3(Real(0), Real(0), Real(1)));
    const auto cross = m::ao_cross(a, b);
    const auto tangent = m::ao_any_tangent(n);
    const auto frame = m::ao_gram_schmidt(n, vec3(in[3], in[4], Real(0)));
    const auto direction = m::ao_octahedral_direction(in[6], in[7]);
    return std::array{ m::ao_dot(a, b),
                       cross.x,
                       cross.z,
                       n.x,
                       n.y,
                       tangent.y,
                       tangent.z,
                       frame.tangent.x,
                       frame.tangent.y,
                       frame.bitangent.z,
                       direction.x,
                       direction.y,
                       direction.z,
                       m::floor(in[0]),
                       m::sqrt(m::abs(in[1])),
                       m::ao_signed_from_code(m::ao_unorm_code(in[6], Real(1023)), Real(1023)) };
}

std::vector<std::array<float, 8>> fuzz()
{
    std::vector<std::array<float, 8>> inputs;
    std::mt19937 engine(77);
    std::uniform_real_distribution<float> unit(-1, 1);
    const float awkward[] = { 0.0F, -0.0F, 1.0F, -1.0F, 0.5F, 1e-20F, -3e7F, 0.05F };
    for (int i = 0; i < 20000; ++i) {
        std::array<float, 8> in{};
        for (std::size_t k = 0; k < in.size(); ++k) {
            in[k] = (engine() & 7U) == 0 ? awkward[engine() & 7U] : unit(engine) * (k < 6 ? 4.0F : 1.0F);
        }
        in[6] = std::min(std::max(in[6], -1.0F), 1.0F);
        in[7] = std::min(std::max(in[7], -1.0F), 1.0F);
        inputs.push_back(in);
    }
    return inputs;
}

template <class Real>
std::vector<float> render(const pictures& p, const ao::settings& s, ao::normal_source source, bool parallel)
{
    const ao::plan planned = plan_for(p, s, simple_camera(p.width, p.height, parallel ? 3.0 : 0.6, parallel), parallel, source);
    return run_filter<Real>(run_occlusion<Real>(planned, picture_resources<Real>(p, s)), p.width, p.height, s.filter);
}

} // namespace

TEMPLATE_TEST_CASE("Lanes give the bits of float", "[core][reals]", lanes4, lanes8, lanes16)
{
    const auto inputs = fuzz();
    const auto expected = evaluate<float>(inputs, all_functions<float>);
    const auto got = evaluate<TestType>(inputs, all_functions<TestType>);
    int wrong = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        for (std::size_t k = 0; k < expected[i].size(); ++k) {
            wrong += std::bit_cast<std::uint64_t>(expected[i][k]) != std::bit_cast<std::uint64_t>(got[i][k]) &&
                     !(std::isnan(expected[i][k]) && std::isnan(got[i][k]));
        }
    }
    CHECK(wrong == 0);
}

TEMPLATE_TEST_CASE("Lanes render the picture of float", "[core][reals]", lanes4, lanes8, lanes16)
{
    const auto source = GENERATE(ao::normal_source::vector, ao::normal_source::from_depth);
    const bool parallel = GENERATE(false, true);
    const auto kernel = GENERATE(ao::method::box, ao::method::hemisphere, ao::method::halton);
    for (const auto& size : { std::array{ 1, 1 }, { 1, 7 }, { 19, 1 }, { 33, 14 } }) {
        const pictures p = rough_scene(size[0], size[1], 5);
        ao::settings s;
        s.method = kernel;
        s.taps = 8;
        s.thickness = parallel ? 1.0F : std::numeric_limits<float>::infinity();
        CHECK(render<TestType>(p, s, source, parallel) == render<float>(p, s, source, parallel));
    }
}

TEST_CASE("Intervals hold the bits of float", "[core][reals]")
{
    int outside = 0;
    int unknown = 0;
    const auto inputs = fuzz();
    for (const auto& in : inputs) {
        std::array<ao::interval, 8> wide{};
        for (std::size_t k = 0; k < in.size(); ++k) {
            wide[k] = ao::interval(in[k]);
        }
        const auto expected = all_functions<float>(in);
        const auto bounds = all_functions<ao::interval>(wide);
        for (std::size_t k = 0; k < bounds.size(); ++k) {
            outside += !bounds[k].contains(expected[k]);
            unknown += bounds[k].is_unknown();
        }
    }
    CHECK(outside == 0);
    // Bounds that say nothing would hold anything.
    CHECK(unknown < static_cast<int>(inputs.size() * 16 / 50));
}

TEST_CASE("Float is near double", "[core][reals]")
{
    const auto inputs = fuzz();
    const auto single = evaluate<float>(inputs, all_functions<float>);
    const auto exact = evaluate<double>(inputs, all_functions<double>);
    int far = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        double size = 1;
        for (const float x : inputs[i]) {
            size = std::max(size, std::abs(static_cast<double>(x)));
        }
        // Frames amplify rounding by at most 1 / 0.05 at the fallback's edge, where either may have chosen it.
        for (const std::size_t k : { 0U, 1U, 2U, 3U, 4U, 10U, 11U, 12U }) {
            far += !(std::abs(single[i][k] - exact[i][k]) <= 4e-7 * size * size);
        }
    }
    CHECK(far == 0);
}
