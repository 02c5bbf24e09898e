// Radical inverses at run time for every Real type (numerics.md H1 to H7).
#include "unit/core_support.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace core_test;

namespace {

const int bases[] = { 2, 3, 5, 7, 11, 13 };

double exact(std::uint64_t base, std::uint64_t index)
{
    std::uint64_t numerator = 0;
    std::uint64_t denominator = 1;
    for (; index != 0; index /= base) {
        numerator = numerator * base + index % base;
        denominator *= base;
    }
    return static_cast<double>(numerator) / static_cast<double>(denominator);
}

template <class Real>
std::vector<double> inverses(int base, const std::vector<std::uint32_t>& indices)
{
    using uint = typename ao::math<Real>::uint;
    constexpr auto width = static_cast<std::size_t>(width_of<Real>);
    std::vector<double> results;
    for (std::size_t start = 0; start < indices.size(); start += width) {
        const uint packed =
            each<uint>([&](int i) { return indices[std::min(start + static_cast<std::size_t>(i), indices.size() - 1)]; });
        const Real x = ao::math<Real>::ao_radical_inverse(base, packed);
        for (std::size_t i = 0; i < width && start + i < indices.size(); ++i) {
            results.push_back(static_cast<double>(at(x, static_cast<int>(i))));
        }
    }
    return results;
}

std::vector<std::uint32_t> interesting(int base)
{
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        indices.push_back(i);
    }
    std::mt19937 engine(5);
    for (int i = 0; i < 20000; ++i) {
        const auto index = static_cast<std::uint32_t>(engine() >> 10U); // below 2^22
        const std::uint32_t multiple = index / static_cast<std::uint32_t>(base) * static_cast<std::uint32_t>(base);
        indices.insert(indices.end(), { index, multiple, multiple + 1, multiple == 0 ? 0 : multiple - 1 });
    }
    return indices;
}

} // namespace

TEMPLATE_TEST_CASE("Radical inverses are within 5e-7 of the exact ones below 2^22", "[core][halton]", float, double, lanes4,
                   lanes8, lanes16)
{
    for (const int base : bases) {
        const auto indices = interesting(base);
        const auto values = inverses<TestType>(base, indices);
        double worst = 0;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            worst = std::max(worst, std::abs(values[i] - exact(static_cast<std::uint64_t>(base), indices[i])));
        }
        CAPTURE(base);
        CHECK(worst < 5e-7);
    }
}

TEMPLATE_TEST_CASE("Radical inverses stay in [0, 1) for every index", "[core][halton]", float, double, lanes4, lanes8, lanes16)
{
    for (const int base : bases) {
        std::vector<std::uint32_t> indices{ 0, 0xffffffffU, 0x80000000U, 0x7fffffffU, 0xfffffffeU };
        for (std::uint64_t power = 1; power <= 0xffffffffU; power *= static_cast<std::uint64_t>(base)) {
            indices.push_back(static_cast<std::uint32_t>(power - 1)); // all digits maximal
            indices.push_back(static_cast<std::uint32_t>(power));
        }
        std::mt19937 engine(9);
        for (int i = 0; i < 20000; ++i) {
            indices.push_back(static_cast<std::uint32_t>(engine()));
        }
        const auto values = inverses<TestType>(base, indices);
        CAPTURE(base);
        CHECK(*std::min_element(values.begin(), values.end()) >= 0);
        CHECK(*std::max_element(values.begin(), values.end()) < 1);
    }
}

TEST_CASE("The index does not stick beyond 2^24", "[core][halton]")
{
    for (const int base : bases) {
        std::set<float> seen;
        for (std::uint32_t i = 0; i < 64; ++i) {
            seen.insert(ao::math<float>::ao_radical_inverse(base, 16777216U + i));
        }
        CAPTURE(base);
        CHECK(seen.size() == 64);
    }
}

TEST_CASE("Sequences of the bases in use are uncorrelated at the counts in use", "[core][halton]")
{
    const int count = GENERATE(16, 32, 64, 128);
    const int used[] = { 2, 3, 5 };
    for (const int a : used) {
        for (const int b : used) {
            if (a >= b) {
                continue;
            }
            double sum_a = 0;
            double sum_b = 0;
            double sum_aa = 0;
            double sum_bb = 0;
            double sum_ab = 0;
            for (std::uint32_t i = 1; i <= static_cast<std::uint32_t>(count); ++i) {
                const double x = static_cast<double>(ao::math<float>::ao_radical_inverse(a, i));
                const double y = static_cast<double>(ao::math<float>::ao_radical_inverse(b, i));
                sum_a += x;
                sum_b += y;
                sum_aa += x * x;
                sum_bb += y * y;
                sum_ab += x * y;
            }
            const double covariance = sum_ab - sum_a * sum_b / count;
            const double r = covariance / std::sqrt((sum_aa - sum_a * sum_a / count) * (sum_bb - sum_b * sum_b / count));
            CAPTURE(count, a, b, r);
            CHECK(std::abs(r) < 0.35);
        }
    }
}

TEST_CASE("Every elementary interval holds exactly one point", "[core][halton]")
{
    // Of any base_a^i base_b^j consecutive points, each box of sides base_a^-i, base_b^-j holds one.
    const auto pair =
        GENERATE(std::array{ 2, 3 }, std::array{ 3, 5 }, std::array{ 2, 5 }, std::array{ 7, 11 }, std::array{ 11, 13 });
    const int columns = pair[0] * pair[0] * (pair[0] == 2 ? 2 : 1);
    const int rows = pair[1] * (pair[1] == 3 ? 3 : 1);
    const auto count = static_cast<std::uint32_t>(columns * rows);
    for (const std::uint32_t start : { 0U, count, 5U * count, 1000U }) {
        std::vector<int> hits(count, 0);
        for (std::uint32_t i = start; i < start + count; ++i) {
            // Values on a box's lower edge may be rounded below it; the next ones are further than 1e-6.
            const float x = ao::math<float>::ao_radical_inverse(pair[0], i) + 1e-6F;
            const float y = ao::math<float>::ao_radical_inverse(pair[1], i) + 1e-6F;
            ++hits[static_cast<std::size_t>(static_cast<int>(x * static_cast<float>(columns)) * rows +
                                            static_cast<int>(y * static_cast<float>(rows)))];
        }
        CAPTURE(pair[0], pair[1], start);
        CHECK(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; }));
    }
}
