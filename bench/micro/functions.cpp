// Every function of the conformance table in items/s, for each Real type. Before the clock starts its results must be those of
// float: the same bits for lanes, within reach for double, inside the bounds for intervals.
#include "ao/conformance/functions.hpp"
#include "ao/interval.hpp"
#include "unit/core_support.hpp"

#include <benchmark/benchmark.h>

#include <bit>
#include <cmath>
#include <string>
#include <utility>

namespace {

using namespace core_test;
using ao::conformance::evaluator;
using ao::conformance::function_info;
using ao::conformance::function_inputs;

constexpr std::size_t count = 1024; // a multiple of every width; operands stay in the first-level caches

template <class Real>
using vec4 = typename ao::math<Real>::vec4;

template <class Real>
std::vector<vec4<Real>> packed(const std::vector<glm::vec4>& from)
{
    std::vector<vec4<Real>> to;
    constexpr auto width = static_cast<std::size_t>(width_of<Real>);
    for (std::size_t start = 0; start < count; start += width) {
        const auto part = [&](int k) {
            return each<Real>([&](int i) { return from[(start + static_cast<std::size_t>(i)) % from.size()][k]; });
        };
        to.emplace_back(part(0), part(1), part(2), part(3));
    }
    return to;
}

bool same(float got, float expected)
{
    return std::bit_cast<std::uint32_t>(got) == std::bit_cast<std::uint32_t>(expected) ||
           (std::isnan(got) && std::isnan(expected));
}

template <class Real>
bool agrees(const Real& got, int i, float expected)
{
    if constexpr (std::is_same_v<Real, ao::interval>) {
        return got.contains(expected);
    }
    else if constexpr (std::is_same_v<Real, double>) {
        // A double may decide otherwise at an edge, and reach where a float overflows; the tests compare the two in detail.
        return std::isfinite(got) || !std::isfinite(expected) || std::abs(expected) > 1e30F;
    }
    else {
        return same(at(got, i), expected);
    }
}

template <class Real, int F>
bool correct(const std::vector<vec4<Real>>& a, const std::vector<vec4<Real>>& b, const function_inputs& in)
{
    constexpr auto width = static_cast<std::size_t>(width_of<Real>);
    for (std::size_t start = 0; start < count; start += width) {
        const vec4<Real> got = evaluator<Real>::ao_evaluate(F, a[start / width], b[start / width]);
        for (std::size_t i = 0; i < width; ++i) {
            const std::size_t k = (start + i) % in.a.size();
            const glm::vec4 expected = evaluator<float>::ao_evaluate(F, in.a[k], in.b[k]);
            for (int part = 0; part < 4; ++part) {
                if (!agrees(got[part], static_cast<int>(i), expected[part])) {
                    return false;
                }
            }
        }
    }
    return true;
}

template <class Real, int F>
void evaluate_all(benchmark::State& state)
{
    const function_inputs in = ao::conformance::make_inputs(ao::conformance::functions[F], count);
    // The random ones, which are the last: awkward numbers have their own speed.
    function_inputs usual;
    usual.a.assign(in.a.end() - count, in.a.end());
    usual.b.assign(in.b.end() - count, in.b.end());
    const auto a = packed<Real>(usual.a);
    const auto b = packed<Real>(usual.b);
    if (!correct<Real, F>(a, b, usual)) {
        state.SkipWithError("results are not those of float");
        return;
    }
    for (auto _ : state) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            vec4<Real> result = evaluator<Real>::ao_evaluate(F, a[i], b[i]);
            benchmark::DoNotOptimize(result);
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * count));
}

template <class Real, std::size_t... F>
void register_all(const char* type, std::index_sequence<F...>)
{
    const auto add = [&](std::size_t f, void (*run)(benchmark::State&)) {
        benchmark::RegisterBenchmark((std::string(ao::conformance::functions[f].name) + "/" + type).c_str(), run);
    };
    (add(F, evaluate_all<Real, static_cast<int>(F)>), ...);
}

} // namespace

int main(int count_of_arguments, char** arguments)
{
    constexpr auto all = std::make_index_sequence<ao::conformance::function_count>();
    register_all<float>("float", all);
    register_all<double>("double", all);
    register_all<lanes4>("lanes4", all);
    register_all<lanes8>("lanes8", all);
    register_all<lanes16>("lanes16", all);
    register_all<ao::interval>("interval", all);
    benchmark::Initialize(&count_of_arguments, arguments);
    // Lanes wider than these registers go through memory: build with the preset `native` to see what they are worth.
#if defined(__AVX512F__)
    benchmark::AddCustomContext("compiled for", "AVX-512");
#elif defined(__AVX2__)
    benchmark::AddCustomContext("compiled for", "AVX2");
#else
    benchmark::AddCustomContext("compiled for", "the baseline, 4 lanes (preset native: this machine)");
#endif
    if (benchmark::ReportUnrecognizedArguments(count_of_arguments, arguments)) {
        return 1;
    }
    benchmark::RunSpecifiedBenchmarks();
}
