// The texel heap and sampling from it, against definitions in double.
#include "ao/texture.hpp"
#include "unit/core_support.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace core_test;

namespace {

struct picture_of_bytes {
    ao::texture texture;
    std::vector<std::uint8_t> texels;

    picture_of_bytes(int width, int height, std::uint32_t seed) : texels(static_cast<std::size_t>(4 * width * height))
    {
        std::mt19937 engine(seed);
        for (std::uint8_t& t : texels) {
            t = static_cast<std::uint8_t>(engine() & 255U);
        }
        texture.width = width;
        texture.height = height;
        texture.texels = texels;
    }
    picture_of_bytes(const picture_of_bytes&) = delete;
};

double linear_light(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
double encoded_light(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// One level as the heap holds it.
struct level {
    int width;
    int height;
    const std::uint32_t* words;

    std::uint32_t code(int x, int y, int channel) const { return words[y * width + x] >> (8 * channel) & 255U; }
};

std::vector<level> levels_of(const ao::texel_heap& heap, std::size_t texture)
{
    const std::uint32_t* d = heap.words.data() + 256 + 24 * texture;
    std::vector<level> all;
    int width = static_cast<int>(d[0]);
    int height = static_cast<int>(d[1]);
    for (std::uint32_t i = 0; i < d[2]; ++i) {
        all.push_back({ width, height, heap.words.data() + d[8 + i] });
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
    }
    return all;
}

int wrapped(long long i, int size, ao::wrap_mode mode)
{
    if (mode == ao::wrap_mode::clamp) {
        return static_cast<int>(std::clamp<long long>(i, 0, size - 1));
    }
    const long long period = mode == ao::wrap_mode::repeat ? size : 2 * size;
    const long long at = (i % period + period) % period;
    return static_cast<int>(at < size ? at : period - 1 - at);
}

double sampled(const level& l, const ao::texture& t, double u, double v, int channel)
{
    const double x = u * l.width - 0.5;
    const double y = v * l.height - 0.5;
    const double left = std::floor(x);
    const double top = std::floor(y);
    const auto value = [&](int dx, int dy) {
        const double code = l.code(wrapped(static_cast<long long>(left) + dx, l.width, t.wrap_u),
                                   wrapped(static_cast<long long>(top) + dy, l.height, t.wrap_v), channel);
        return t.srgb && channel < 3 ? linear_light(code / 255) : code / 255;
    };
    const double a = x - left;
    const double b = y - top;
    return (value(0, 0) * (1 - a) + value(1, 0) * a) * (1 - b) + (value(0, 1) * (1 - a) + value(1, 1) * a) * b;
}

double trilinear(const std::vector<level>& levels, const ao::texture& t, double u, double v, double footprint, int channel)
{
    const double side = std::max(t.width, t.height);
    const double exact = 0.5 * std::log2(footprint * side * side);
    const double lod = std::clamp(exact, 0.0, static_cast<double>(levels.size() - 1));
    const auto fine = static_cast<std::size_t>(lod);
    const std::size_t coarse = std::min(fine + 1, levels.size() - 1);
    const double weight = lod - static_cast<double>(fine);
    return sampled(levels[fine], t, u, v, channel) * (1 - weight) + sampled(levels[coarse], t, u, v, channel) * weight;
}

// Lanes read a word each.
template <class Real>
struct heap_reader {
    using uint = typename ao::real_traits<Real>::uint;
    const std::uint32_t* words;
    uint word(uint index) const
    {
        return each<uint>([&](int i) { return words[at(index, i)]; });
    }
};

} // namespace

TEMPLATE_TEST_CASE("Trilinear samples equal the definition in double", "[core][texture]", float, double, lanes8)
{
    const auto wrap = GENERATE(ao::wrap_mode::repeat, ao::wrap_mode::clamp, ao::wrap_mode::mirror);
    const bool srgb = GENERATE(false, true);
    picture_of_bytes first(13, 6, 1);
    picture_of_bytes second(32, 32, 2);
    for (picture_of_bytes* p : { &first, &second }) {
        p->texture.wrap_u = wrap;
        p->texture.wrap_v = wrap == ao::wrap_mode::clamp ? ao::wrap_mode::mirror : wrap;
        p->texture.srgb = srgb;
    }
    const std::vector<ao::texture> textures{ first.texture, second.texture };
    const auto heap = ao::make_texel_heap(textures);
    REQUIRE(heap);

    std::vector<std::array<float, 3>> inputs;
    std::mt19937 engine(4);
    std::uniform_real_distribution<float> coordinate(-3, 4);
    std::uniform_real_distribution<float> exponent(-14, 3);
    for (int i = 0; i < 4000; ++i) {
        inputs.push_back({ coordinate(engine), coordinate(engine), std::exp2(exponent(engine)) });
    }
    for (std::size_t texture = 0; texture < textures.size(); ++texture) {
        using reader_type = ao::texture_reader<TestType, heap_reader<TestType>>;
        reader_type reader{ { heap->words.data() } };
        const auto outputs = evaluate<TestType>(inputs, [&](const std::array<TestType, 3>& in) {
            const auto c = reader.ao_sample(static_cast<std::uint32_t>(texture), { in[0], in[1] }, in[2]);
            return std::array{ c.x, c.y, c.z, c.w };
        });
        const std::vector<level> levels = levels_of(*heap, texture);
        double worst = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            for (int channel = 0; channel < 4; ++channel) {
                const double expected = trilinear(levels, textures[texture], static_cast<double>(inputs[i][0]),
                                                  static_cast<double>(inputs[i][1]), static_cast<double>(inputs[i][2]), channel);
                worst = std::max(worst, std::abs(outputs[i][static_cast<std::size_t>(channel)] - expected));
            }
        }
        // A coordinate of 4 rounds by 2.4e-7, which is 8e-6 texels of 32.
        CAPTURE(worst, texture);
        CHECK(worst < 2e-5);
    }
}

TEST_CASE("Levels are box filtered in linear light and rounded to the nearest code", "[core][texture]")
{
    const bool srgb = GENERATE(false, true);
    struct size {
        int width;
        int height;
    };
    for (const size s : { size{ 1, 1 }, { 2, 2 }, { 3, 3 }, { 7, 5 }, { 1, 9 }, { 16, 4 }, { 33, 2 }, { 255, 129 } }) {
        picture_of_bytes p(s.width, s.height, 9);
        p.texture.srgb = srgb;
        const auto heap = ao::make_texel_heap({ &p.texture, 1 });
        REQUIRE(heap);
        const std::vector<level> levels = levels_of(*heap, 0);
        CHECK(levels.size() == static_cast<std::size_t>(std::floor(std::log2(std::max(s.width, s.height)))) + 1);
        CHECK(levels.back().width == 1);
        CHECK(levels.back().height == 1);
        int wrong = 0;
        for (std::size_t i = 1; i < levels.size(); ++i) {
            const level& above = levels[i - 1];
            const level& below = levels[i];
            for (int y = 0; y < below.height; ++y) {
                for (int x = 0; x < below.width; ++x) {
                    for (int channel = 0; channel < 4; ++channel) {
                        // The area of each texel above that lies within this one.
                        double sum = 0;
                        const bool decode = srgb && channel < 3;
                        for (int j = 0; j < above.height; ++j) {
                            const double rows = std::min((y + 1.0) * above.height / below.height, j + 1.0) -
                                                std::max(y * 1.0 * above.height / below.height, j * 1.0);
                            for (int k = 0; k < above.width && rows > 1e-9; ++k) {
                                const double columns = std::min((x + 1.0) * above.width / below.width, k + 1.0) -
                                                       std::max(x * 1.0 * above.width / below.width, k * 1.0);
                                if (columns > 1e-9) {
                                    const double code = above.code(k, j, channel) / 255.0;
                                    sum += rows * columns * (decode ? linear_light(code) : code);
                                }
                            }
                        }
                        const double mean = sum * below.width / above.width * below.height / above.height;
                        const double exact = (decode ? encoded_light(mean) : mean) * 255;
                        wrong += std::abs(exact - below.code(x, y, channel)) > 0.5 + 1e-4 ? 1 : 0;
                    }
                }
            }
        }
        CAPTURE(s.width, s.height, srgb);
        CHECK(wrong == 0);
    }
}

TEST_CASE("A constant texture is that constant everywhere", "[core][texture]")
{
    picture_of_bytes p(19, 7, 0);
    for (const int code : { 0, 1, 127, 188, 254, 255 }) {
        std::fill(p.texels.begin(), p.texels.end(), static_cast<std::uint8_t>(code));
        const auto heap = ao::make_texel_heap({ &p.texture, 1 });
        REQUIRE(heap);
        std::mt19937 engine(8);
        std::uniform_real_distribution<float> uniform(-2, 3);
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto c = ao::sample<float>(*heap, 0, { uniform(engine), uniform(engine) }, std::exp2(uniform(engine) * 4));
            worst = std::max(worst, std::abs(static_cast<double>(c.x) - code / 255.0));
        }
        // A mask of 0 or 1 is exactly that, so that blending returns the child's bits.
        CHECK(worst <= (code == 0 || code == 255 ? 0 : 3e-7));
    }
}

TEST_CASE("Coordinates and footprints that are no numbers are defined", "[core][texture]")
{
    picture_of_bytes p(8, 8, 3);
    const auto heap = ao::make_texel_heap({ &p.texture, 1 });
    REQUIRE(heap);
    const float infinite = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const glm::vec4 origin = ao::sample<float>(*heap, 0, { 0, 0 }, 0);
    for (const float odd : { nan, infinite, -infinite, 1e30F, -1e30F, 5e6F }) {
        CHECK(ao::sample<float>(*heap, 0, { odd, 0 }, 0) == origin);
        CHECK(ao::sample<float>(*heap, 0, { 0, odd }, 0) == origin);
    }
    CHECK(ao::sample<float>(*heap, 0, { 0, 0 }, nan) == origin);
    CHECK(ao::sample<float>(*heap, 0, { 0, 0 }, -1) == origin);
    const glm::vec4 mean = ao::sample<float>(*heap, 0, { 0.3F, 0.7F }, 1e20F);
    CHECK(ao::sample<float>(*heap, 0, { 0, 0 }, infinite) == mean);
    CHECK(mean.x == static_cast<float>(levels_of(*heap, 0).back().code(0, 0, 0)) * 0.003921568859368563F);
}

TEST_CASE("Textures that cannot be packed are refused with a reason", "[core][texture]")
{
    picture_of_bytes p(8, 8, 3);
    const auto reason = [&](std::size_t limit = 1U << 30U) {
        const auto heap = ao::make_texel_heap({ &p.texture, 1 }, limit);
        return heap ? std::string() : std::string(heap.error().reason());
    };
    CHECK(reason().empty());
    CHECK(reason(1000) == "textures 0 to 0 with their levels need 1 MiB, the limit is 0 MiB");
    p.texture.width = 0;
    CHECK(reason() == "texture 0: 0 x 8 pixels, must have 1 to 16384 a side");
    p.texture.width = 16385;
    CHECK(reason() == "texture 0: 16385 x 8 pixels, must have 1 to 16384 a side");
    p.texture.width = 9;
    CHECK(reason() == "texture 0: 256 bytes of texels instead of 288");
}

TEST_CASE("sRGB: every code survives, and half of white is 188", "[core][texture]")
{
    int same = 0;
    double worst = 0;
    for (int code = 0; code < 256; ++code) {
        const float linear = ao::srgb_table[static_cast<std::size_t>(code)];
        worst = std::max(worst, std::abs(static_cast<double>(linear) - linear_light(code / 255.0)));
        same += ao::display_code(linear) == code ? 1 : 0;
        same += ao::srgb_code(static_cast<double>(linear)) == code ? 1 : 0;
    }
    CHECK(same == 512);
    CHECK(worst < 1e-7);
    CHECK(ao::display_code(0.5F) == 188);
    CHECK(ao::display_code(1.0F) == 255);
    CHECK(ao::display_code(7.0F) == 255);
    CHECK(ao::display_code(std::nanf("")) == 0);
    CHECK(ao::display_code(-1.0F) == 0);
    double apart = 0;
    for (int i = 0; i <= 100000; ++i) {
        const auto x = static_cast<float>(i) / 100000.0F;
        apart = std::max(apart, std::abs(static_cast<double>(ao::srgb_of_linear(x)) - encoded_light(static_cast<double>(x))));
    }
    CHECK(apart < 3e-7); // continuous where the pieces join, too
}

TEMPLATE_TEST_CASE("log2, exp2, power and turns stay within their stated errors", "[core][texture]", float, double, lanes8)
{
    using m = ao::math<TestType>;
    std::mt19937 engine(21);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<std::array<float, 2>> inputs;
    for (int i = 0; i < 400000; ++i) {
        const float kind = uniform(engine);
        const float x = kind < 0.3F   ? 1 + (uniform(engine) - 0.5F) * 1e-3F
                        : kind < 0.6F ? uniform(engine)
                                      : std::exp2(uniform(engine) * 252 - 126);
        inputs.push_back({ x, uniform(engine) < 0.5F ? uniform(engine) * 8 : uniform(engine) * 8192 });
    }
    const auto outputs = evaluate<TestType>(inputs, [](const std::array<TestType, 2>& in) {
        const TestType angle = in[1] * TestType(0.03) - TestType(126);
        return std::array{ m::ao_log2(in[0]), m::ao_exp2(angle), m::ao_power(in[0], in[1]),
                           m::ao_turns(in[0] - TestType(0.5), in[1] - TestType(4)), angle };
    });
    std::array<double, 4> worst{};
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto x = static_cast<double>(inputs[i][0]);
        const auto y = static_cast<double>(inputs[i][1]);
        const auto& out = outputs[i];
        const double exact = std::log2(x);
        worst[0] = std::max(worst[0], exact == 0 ? std::abs(out[0])
                                                 : std::abs(out[0] / exact - 1) / (std::abs(exact) >= 1 ? 1e-7 : 1.6e-7));
        if (out[4] >= -126 && out[4] <= 126) {
            worst[1] = std::max(worst[1], std::abs(out[1] / std::exp2(out[4]) - 1) / 1.1e-7);
        }
        worst[2] = std::max(worst[2], std::abs(out[2] - std::pow(std::min(x, 1.0), y)) / 1.2e-7);
        const double turned =
            std::atan2(static_cast<double>(inputs[i][0] - 0.5F), static_cast<double>(inputs[i][1] - 4.0F)) / (2 * ao::detail::pi);
        if (x < 1e17) {
            worst[3] = std::max(worst[3], std::abs(out[3] - turned) / 5e-8);
        }
    }
    CAPTURE(worst[0], worst[1], worst[2], worst[3]);
    CHECK(worst[0] <= 1);
    CHECK(worst[1] <= 1);
    CHECK(worst[2] <= 1);
    CHECK(worst[3] <= 1);
}

TEST_CASE("log2, exp2, power and turns are defined at the edges", "[core][texture]")
{
    using m = ao::math<float>;
    const float infinite = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(m::ao_log2(1) == 0);
    CHECK(m::ao_log2(8) == 3);
    CHECK(m::ao_log2(0) == -126);
    CHECK(m::ao_log2(nan) == -126);
    CHECK(m::ao_log2(-3) == -126);
    CHECK(m::ao_log2(infinite) == 126);
    CHECK(m::ao_exp2(0) == 1);
    CHECK(m::ao_exp2(-10) == 1.0F / 1024);
    CHECK(m::ao_exp2(-127) == 0);
    CHECK(m::ao_exp2(nan) == 0);
    CHECK(m::ao_exp2(infinite) == std::exp2(126.0F));
    for (const float y : { 0.5F, 1.0F, 8192.0F }) {
        CHECK(m::ao_power(0, y) == 0);
        CHECK(m::ao_power(nan, y) == 0);
        CHECK(m::ao_power(1, y) == 1);
        CHECK(m::ao_power(2, y) == 1);
        CHECK(m::ao_power(-1, y) == 0);
    }
    CHECK(m::ao_power(0, 0) == 1);
    CHECK(m::ao_power(0.3F, 0) == 1);
    CHECK(m::ao_power(0.3F, nan) == 1);
    CHECK(m::ao_turns(0, 0) == 0);
    CHECK(m::ao_turns(0, -1) == 0.5F);
    CHECK(m::ao_turns(1, 0) == 0.25F);
    CHECK(m::ao_turns(-1, 0) == -0.25F);
}
