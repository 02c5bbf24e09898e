// Half floats, all of them; packed depths and normalised integers.
#include "ao/picture.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <random>

TEST_CASE("Every half survives the way to float and back", "[core][formats]")
{
    int wrong = 0;
    for (std::uint32_t code = 0; code < 65536; ++code) {
        const auto h = static_cast<std::uint16_t>(code);
        const float x = ao::half_to_float(h);
        const bool is_nan = (h & 0x7fffU) > 0x7c00U;
        const std::uint16_t back = ao::float_to_half(x);
        wrong += is_nan ? !(std::isnan(x) && (back & 0x7fffU) > 0x7c00U) : back != h;
        // Against the definition.
        const int exponent = h >> 10U & 31;
        const double fraction = h & 1023;
        const double magnitude = exponent == 0    ? std::ldexp(fraction, -24)
                                 : exponent == 31 ? HUGE_VAL
                                                  : std::ldexp(1024 + fraction, exponent - 25);
        wrong += !is_nan && static_cast<double>(x) != ((h & 0x8000U) != 0 ? -magnitude : magnitude);
    }
    CHECK(wrong == 0);
}

TEST_CASE("Floats round to the nearest half, ties to even", "[core][formats]")
{
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> exponent(-27.0F, 16.5F);
    int wrong = 0;
    for (int i = 0; i < 200000; ++i) {
        const float x = std::exp2(exponent(engine)) * ((engine() & 1U) != 0 ? 1.0F : -1.0F);
        const std::uint16_t h = ao::float_to_half(x);
        if ((h & 0x7fffU) == 0x7c00U) {
            wrong += std::abs(x) < 65520.0F;
            continue;
        }
        const double error = std::abs(static_cast<double>(ao::half_to_float(h)) - static_cast<double>(x));
        for (const int step : { -1, 1 }) {
            const auto other = static_cast<std::uint16_t>(h + step);
            if ((other & 0x7fffU) < 0x7c00U && ((other ^ h) & 0x8000U) == 0) {
                wrong += std::abs(static_cast<double>(ao::half_to_float(other)) - static_cast<double>(x)) < error;
            }
        }
    }
    for (std::uint32_t code = 0; code < 0x7bffU; ++code) {
        const float low = ao::half_to_float(static_cast<std::uint16_t>(code));
        const float high = ao::half_to_float(static_cast<std::uint16_t>(code + 1));
        const std::uint16_t even = static_cast<std::uint16_t>(code + (code & 1U));
        wrong += ao::float_to_half(0.5F * low + 0.5F * high) != even; // exact: 12 bits suffice
    }
    CHECK(wrong == 0);
}

TEST_CASE("Normalised integers: ends, nearest code, and what is no number", "[core][formats]")
{
    CHECK(ao::unorm_code(0, 1023) == 0);
    CHECK(ao::unorm_code(1, 1023) == 1023);
    CHECK(ao::unorm_code(-5, 1023) == 0);
    CHECK(ao::unorm_code(5, 1023) == 1023);
    CHECK(ao::unorm_code(std::nan(""), 1023) == 0);
    for (const std::uint32_t top : { 255U, 1023U, 65535U }) {
        for (std::uint32_t code = 0; code <= top; ++code) {
            // As drivers convert: in float.
            const float value = static_cast<float>(code) / static_cast<float>(top);
            REQUIRE(ao::unorm_code(static_cast<double>(value), top) == code);
            REQUIRE(ao::math<float>::ao_unorm_code(value, static_cast<float>(top)) == static_cast<float>(code));
            // One unit off in the last place, as a reciprocal multiply may be.
            REQUIRE(ao::math<float>::ao_unorm_code(std::nextafter(value, 2.0F), static_cast<float>(top)) ==
                    static_cast<float>(code));
            REQUIRE(ao::math<float>::ao_unorm_code(std::nextafter(value, -1.0F), static_cast<float>(top)) ==
                    static_cast<float>(code));
        }
    }
}
