// The separable filter against a brute-force mean over the square window in double.
#include "unit/core_pictures.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace core_test;

namespace {

// Mean over the window of the pixels present: inside the picture, and no background (negative). 1 on background.
std::vector<double> brute_force(const std::vector<float>& raw, int width, int height, int size)
{
    const int r = size / 2;
    std::vector<double> result(raw.size(), 1.0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (raw[static_cast<std::size_t>(y * width + x)] < 0) {
                continue;
            }
            double sum = 0;
            int count = 0;
            for (int v = std::max(0, y - r); v <= std::min(height - 1, y + r); ++v) {
                for (int u = std::max(0, x - r); u <= std::min(width - 1, x + r); ++u) {
                    const float value = raw[static_cast<std::size_t>(v * width + u)];
                    if (value >= 0) {
                        sum += static_cast<double>(value);
                        ++count;
                    }
                }
            }
            result[static_cast<std::size_t>(y * width + x)] = sum / count;
        }
    }
    return result;
}

std::vector<float> noise(int width, int height, double background)
{
    std::mt19937 engine(31);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<float> raw(static_cast<std::size_t>(width * height));
    for (float& x : raw) {
        x = static_cast<double>(unit(engine)) < background ? -1.0F : unit(engine);
    }
    return raw;
}

struct extent {
    int width;
    int height;
};

} // namespace

TEMPLATE_TEST_CASE("The filter is the mean of the window's foreground", "[core][filter]", float, double, lanes4, lanes8, lanes16)
{
    for (const extent e : { extent{ 1, 1 }, { 1, 9 }, { 17, 1 }, { 3, 2 }, { 23, 19 }, { 40, 8 } }) {
        for (const double background : { 0.0, 0.3, 0.95, 1.0 }) {
            const auto raw = noise(e.width, e.height, background);
            for (const int size : { 1, 3, 5, 9, ao::max_filter }) {
                const auto expected = brute_force(raw, e.width, e.height, size);
                const auto filtered = run_filter<TestType>(raw, e.width, e.height, size);
                double worst = 0;
                for (std::size_t i = 0; i < raw.size(); ++i) {
                    worst = std::max(worst, std::abs(static_cast<double>(filtered[i]) - expected[i]));
                }
                CAPTURE(e.width, e.height, background, size);
                // size^2 sums of numbers up to 1, each rounded at most 2^-24 of the running sum, over their count.
                CHECK(worst <= 2 * size * 5.96e-8 + 6e-8);
            }
        }
    }
}

TEMPLATE_TEST_CASE("The filter keeps constants, background and bounds", "[core][filter]", float, lanes8)
{
    const int width = 21;
    const int height = 13;
    SECTION("constants, to one unit in the last place, in the middle and at the borders")
    {
        for (const float c : { 0.0F, 1.0F, 0.5F, 1.0F / 3, 0.7F, 1e-3F }) {
            for (const int size : { 1, 3, 5, 7 }) {
                for (const float v :
                     run_filter<TestType>(std::vector<float>(static_cast<std::size_t>(width * height), c), width, height, size)) {
                    CHECK(v >= std::nextafter(c, -1.0F));
                    CHECK(v <= std::nextafter(c, 2.0F));
                    CHECK(v <= 1.0F);
                }
            }
        }
    }
    SECTION("background stays 1 and lends nothing to its neighbours")
    {
        std::vector<float> raw(static_cast<std::size_t>(width * height), 0.25F);
        for (int y = 0; y < height; ++y) {
            for (int x = 10; x < width; ++x) {
                raw[static_cast<std::size_t>(y * width + x)] = -1.0F;
            }
        }
        const auto filtered = run_filter<TestType>(raw, width, height, 5);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                CHECK(filtered[static_cast<std::size_t>(y * width + x)] == (x < 10 ? 0.25F : 1.0F));
            }
        }
    }
    SECTION("the output lies between the least and the greatest input of the window")
    {
        const auto raw = noise(width, height, 0.2);
        const auto filtered = run_filter<TestType>(raw, width, height, 5);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                float least = 2;
                float greatest = -1;
                for (int v = std::max(0, y - 2); v <= std::min(height - 1, y + 2); ++v) {
                    for (int u = std::max(0, x - 2); u <= std::min(width - 1, x + 2); ++u) {
                        const float value = raw[static_cast<std::size_t>(v * width + u)];
                        if (value >= 0) {
                            least = std::min(least, value);
                            greatest = std::max(greatest, value);
                        }
                    }
                }
                const std::size_t i = static_cast<std::size_t>(y * width + x);
                if (raw[i] >= 0) {
                    CHECK(filtered[i] >= least * (1 - 1e-6F));
                    CHECK(filtered[i] <= greatest * (1 + 1e-6F));
                }
            }
        }
    }
    SECTION("rows first equals columns first, within rounding")
    {
        const auto raw = noise(width, height, 0.2);
        std::vector<float> turned(raw.size());
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                turned[static_cast<std::size_t>(x * height + y)] = raw[static_cast<std::size_t>(y * width + x)];
            }
        }
        const auto a = run_filter<TestType>(raw, width, height, 7);
        const auto b = run_filter<TestType>(turned, height, width, 7);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                CHECK(std::abs(a[static_cast<std::size_t>(y * width + x)] - b[static_cast<std::size_t>(x * height + y)]) < 1e-6F);
            }
        }
    }
}
