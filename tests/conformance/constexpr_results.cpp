// What the compiler computes is what every backend computes.
#include "ao/conformance/functions.hpp"
#include "conformance/runners.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cstdint>

using namespace ao::conformance;

namespace {

// Inputs that every function is defined for.
constexpr std::array<std::array<float, 8>, 5> inputs{ {
    { 0.6F, 0.0F, 0.8F, 0.25F, 0.3F, 0.7F, 0.2F, 1.5F },
    { 3.0F, 12345.0F, 7.0F, 2.0F, 2.0F, 5.0F, 9.0F, 1.0F },
    { 511.0F, 60001.0F, 0.1F, 0.7F, 1023.0F, 3.5F, 17.25F, 4.0F },
    { 0.1F, 0.9F, 0.3F, 8.0F, 65535.0F, 0.125F, 6.0F, 0.0625F },
    { 0.0F, 0.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F },
} };

using row = std::array<std::uint32_t, 4>;
using table = std::array<std::array<row, inputs.size()>, function_count>;

constexpr glm::vec4 first(const std::array<float, 8>& x)
{
    return { x[0], x[1], x[2], x[3] };
}

constexpr glm::vec4 second(const std::array<float, 8>& x)
{
    return { x[4], x[5], x[6], x[7] };
}

constexpr table computed_by_the_compiler = [] {
    table results{};
    for (std::size_t f = 0; f < results.size(); ++f) {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const glm::vec4 v = evaluator<float>::ao_evaluate(static_cast<int>(f), first(inputs[i]), second(inputs[i]));
            results[f][i] = { std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
                              std::bit_cast<std::uint32_t>(v.z), std::bit_cast<std::uint32_t>(v.w) };
        }
    }
    return results;
}();

} // namespace

TEST_CASE("constant expressions and every backend give the same bits")
{
    std::vector<glm::vec4> a;
    std::vector<glm::vec4> b;
    for (const auto& x : inputs) {
        a.push_back(first(x));
        b.push_back(second(x));
    }
    for (const auto& runner : usual_runners()) {
        REQUIRE(runner->exact());
        for (const function_info& f : functions) {
            std::vector<glm::vec4> out(a.size());
            REQUIRE(runner->evaluate(f.function, a, b, out));
            for (std::size_t i = 0; i < out.size(); ++i) {
                INFO(runner->name() << ", " << f.name << ", input " << i);
                CHECK(std::bit_cast<row>(out[i]) == computed_by_the_compiler[static_cast<std::size_t>(f.function)][i]);
            }
        }
    }
}
