// Light from pictures of the surroundings: look-up, harmonics, glossy light by designs.
#include "ao/ambient.hpp"
#include "ao/lobe_light.hpp"
#include "ao/lobe_rule.hpp"
#include "core_support.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;

double dot(const glm::dvec3& a, const glm::dvec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

double apart(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::sqrt(dot(a - b, a - b));
}

// Towards a point of the picture, u and v in 0 ... 1: the convention's definition.
glm::dvec3 direction_at(double u, double v)
{
    const double azimuth = 2 * pi * (u - 0.5);
    return { std::sin(pi * v) * std::sin(azimuth), std::cos(pi * v), -std::sin(pi * v) * std::cos(azimuth) };
}

template <class Light>
ao::light_picture picture_of(int width, int height, const Light& light)
{
    ao::light_picture picture{ .width = width, .height = height, .texels = {} };
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            picture.texels.emplace_back(light(direction_at((column + 0.5) / width, (row + 0.5) / height)));
        }
    }
    return picture;
}

ao::light_picture random_picture(int width, int height)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> value(0, 4);
    return picture_of(width, height, [&](const glm::dvec3&) { return glm::dvec3(value(random), value(random), value(random)); });
}

std::vector<glm::dvec3> random_directions(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> component;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 d(component(random), component(random), component(random));
        directions.push_back(d / std::sqrt(dot(d, d)));
    }
    return directions;
}

ao::harmonic_series<glm::dvec3> random_light(int order)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<double> value(-0.1, 0.1);
    ao::harmonic_series<glm::dvec3> light{ .order = order, .coefficients = {} };
    for (std::size_t i = 0; i < ao::harmonic_count(order); ++i) {
        light.coefficients[i] = { value(random), value(random), value(random) };
    }
    light.coefficients[0] = { 8, 9, 10 };
    return light;
}

ao::direction3 plain(const glm::dvec3& d)
{
    return { d.x, d.y, d.z };
}

} // namespace

TEST_CASE("A light picture is read bilinearly, around and up to its poles", "[core][light]")
{
    for (const auto& sides : { std::array{ 8, 4 }, std::array{ 7, 5 }, std::array{ 1, 1 }, std::array{ 2, 1 } }) {
        const int width = sides[0];
        const int height = sides[1];
        const ao::light_picture picture = random_picture(width, height);
        const auto texel = [&](int column, int row) {
            const int y = std::clamp(row, 0, height - 1);
            const int index = y * width + ((column % width) + width) % width;
            return glm::dvec3(picture.texels[static_cast<std::size_t>(index)]);
        };
        for (int y = 0; y <= 4 * height; ++y) {
            for (int x = 0; x <= 4 * width; ++x) {
                const double column = x / 4.0;
                const double row = y / 4.0;
                const glm::dvec3 d = direction_at(column / width, row / height);
                const int left = static_cast<int>(std::floor(column - 0.5));
                const int top = static_cast<int>(std::floor(row - 0.5));
                const double across = column - 0.5 - left;
                const double down = row - 0.5 - top;
                const glm::dvec3 upper = texel(left, top) * (1 - across) + texel(left + 1, top) * across;
                const glm::dvec3 lower = texel(left, top + 1) * (1 - across) + texel(left + 1, top + 1) * across;
                const glm::dvec3 exact = upper * (1 - down) + lower * down;
                // Azimuth and polar angle are within 5e-8 turns (twice that of v), 1e-7 in float; texels differ by up to 4. At
                // the poles there is no azimuth.
                const bool pole = y == 0 || y == 4 * height;
                const glm::dvec3 read = ao::light_towards(picture, d);
                const glm::dvec3 read_float(ao::light_towards(picture, glm::vec3(d)));
                const double most = 7 * (5e-8 * width + 1e-7 * height);
                if (!pole) {
                    CHECK(apart(read, exact) < most);
                    CHECK(apart(read_float, exact) < 4 * most + 2e-6);
                }
                for (int channel = 0; channel < 3; ++channel) {
                    CHECK((read[channel] >= 0 && read[channel] <= 4 + 1e-6));
                }
            }
        }
    }
    // The convention: middle -Z, right of it +X, first row +Y.
    ao::light_picture picture = picture_of(64, 32, [](const glm::dvec3&) { return glm::dvec3(0); });
    picture.texels[16 * 64 + 31] = picture.texels[16 * 64 + 32] = picture.texels[15 * 64 + 31] = picture.texels[15 * 64 + 32] =
        glm::vec3(1);
    picture.texels[15 * 64 + 48] = picture.texels[15 * 64 + 47] = picture.texels[16 * 64 + 48] = picture.texels[16 * 64 + 47] =
        glm::vec3(2);
    for (std::size_t i = 0; i < 64; ++i) {
        picture.texels[i] = glm::vec3(3);
    }
    CHECK(std::abs(ao::light_towards(picture, glm::dvec3(0, 0, -1)).x - 1) < 1e-5);
    CHECK(std::abs(ao::light_towards(picture, glm::dvec3(1, 0, 0)).x - 2) < 1e-5);
    CHECK(ao::light_towards(picture, glm::dvec3(0, 1, 0)).x == 3);
    CHECK(ao::light_towards(picture, glm::dvec3(0, -1, 0)).x == 0);
}

TEST_CASE("Light pictures that are not are refused", "[core][light]")
{
    const auto reason = [](const ao::light_picture& picture) {
        const auto valid = ao::validate(picture);
        return valid ? "valid" : std::string(valid.error().reason());
    };
    ao::light_picture picture = random_picture(4, 2);
    CHECK(reason(picture) == "valid");
    for (const float wrong : { -1e-9F, 2e30F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN() }) {
        picture.texels[5].y = wrong;
        CHECK(reason(picture) == "light that is negative or not finite");
    }
    picture.texels.pop_back();
    CHECK(reason(picture) == "a light picture has another number of texels than width times height");
    picture.height = 0;
    CHECK(reason(picture) == "a light picture's sides are 1 to 16384 texels");
    picture.height = 1;
    picture.width = 16385;
    CHECK(reason(picture) == "a light picture's sides are 1 to 16384 texels");
}

TEST_CASE("Harmonics of a picture by a rule are those it was drawn from, and give scenes' ambient light", "[core][light]")
{
    const auto light = random_light(8);
    const ao::light_picture picture = picture_of(512, 256, [&](const glm::dvec3& d) { return light(plain(d)); });
    const auto read = ao::harmonics_of(picture, *ao::lebedev_rule(41), 8);
    double worst = 0;
    for (std::size_t i = 0; i < ao::max_harmonics; ++i) {
        worst = std::max(worst, apart(read.coefficients[i], light.coefficients[i]));
    }
    // Bilinear reading is off by at most (pi / 256)^2 / 8 of each second derivative, of which a harmonic has l (l + 1): for 80
    // coefficients of 0.1 in quadrature, all three channels.
    const double step = pi / 256;
    CHECK(worst < 2 * step * step / 8 * 72 * 0.1 * std::sqrt(80.0) * std::sqrt(3.0));
    CHECK(worst > 1e-7); // and is not the series itself
    const auto ambient = ao::ambient_of_environment(
        512, 256, [&](std::size_t row, std::size_t column) { return glm::dvec3(picture.texels[row * 512 + column]); });
    std::array<glm::dvec3, 9> nine{};
    std::copy_n(read.coefficients.begin(), 9, nine.begin());
    const auto by_rule = ao::ambient_of_harmonics(nine);
    for (std::size_t i = 0; i < 9; ++i) {
        CHECK(apart(glm::dvec3(ambient.coefficients[i]), glm::dvec3(by_rule.coefficients[i])) < 2e-3);
    }
}

TEST_CASE("Half turns take +z to any direction, and near its antipode turn as it does", "[core][light]")
{
    const auto check = [](const auto& r, double most) {
        using vec = std::decay_t<decltype(r)>;
        using real = typename vec::value_type;
        const vec axis = ao::half_turn<real>::ao_half_turn_axis(r);
        CHECK(std::abs(dot(glm::dvec3(axis), glm::dvec3(axis)) - 1) < most);
        const vec turned = ao::math<real>::ao_mirrored(vec(0, 0, 1), axis);
        CHECK(apart(glm::dvec3(turned), glm::dvec3(r)) < most);
        return axis;
    };
    for (const glm::dvec3& d : random_directions(1000, 2)) {
        check(d, 2e-15);
        check(glm::vec3(d), 8e-7);
    }
    check(glm::dvec3(0, 0, -1), 1e-15);
    check(glm::vec3(0, 0, 1), 1e-15);
    // On circles about -z, down to where r.z rounds to -1, the axis lies halfway: along the circle's radius, nearly.
    for (const double radius : { 0.1, 1e-3, 1e-5, 1e-8, 1e-12 }) {
        for (int i = 0; i < 64; ++i) {
            const double angle = 2 * pi * i / 64;
            const glm::dvec3 r(radius * std::cos(angle), radius * std::sin(angle), -std::sqrt(1 - radius * radius));
            const glm::vec3 axis = check(glm::vec3(r), 8e-7);
            const double half = std::asin(radius) / 2;
            const glm::dvec3 exact(std::cos(half) * std::cos(angle), std::cos(half) * std::sin(angle), std::sin(half));
            CHECK(apart(glm::dvec3(axis), exact) < 1e-6);
        }
    }
}

TEST_CASE("Glossy light by a design is the lobe's average about the mirror direction", "[core][light]")
{
    const auto light = random_light(6);
    const ao::light_picture picture = picture_of(1024, 512, [&](const glm::dvec3& d) { return light(plain(d)); });
    const ao::light_picture even = picture_of(16, 8, [](const glm::dvec3&) { return glm::dvec3(2, 3, 5); });
    // As above, with values instead of coefficients.
    const double step = pi / 512;
    const double bilinear = 2 * step * step / 8 * 42 * 0.1 * std::sqrt(49.0) * std::sqrt(3.0);
    const auto normals = random_directions(40, 5);
    const auto eyes = random_directions(40, 6);
    for (const double a : { 1.0, 5.0, 80.0 }) {
        const auto lobe = ao::pack_lobe(*ao::lobe_rule(a, 6));
        const auto averaged = ao::averaged(light, a);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const glm::dvec3& n = normals[i];
            const glm::dvec3& v = eyes[i];
            const glm::dvec3 mirrored = n * (2 * dot(n, v)) - v;
            CHECK(apart(ao::light_of_lobe<double>(picture, lobe, n, v), averaged(plain(mirrored))) < bilinear + 1e-5);
            CHECK(apart(glm::dvec3(ao::light_of_lobe<float>(picture, lobe, glm::vec3(n), glm::vec3(v))),
                        averaged(plain(mirrored))) < bilinear + 3e-5);
            CHECK(apart(glm::dvec3(ao::light_of_lobe<float>(even, lobe, glm::vec3(n), glm::vec3(v))), { 2, 3, 5 }) < 1e-5);
        }
    }
    // About the normal itself where the eye is there.
    const auto narrow = ao::pack_lobe(*ao::lobe_rule(8192, 3));
    const glm::dvec3 n = normals[0];
    CHECK(apart(ao::light_of_lobe<double>(picture, narrow, n, n), light(plain(n))) < 0.02);
}

namespace {

template <class Real>
struct lane_resources {
    using real = Real;
    const ao::light_picture* picture;
    const std::vector<glm::vec4>* lobes;

    template <class Uint>
    glm::vec<3, Real> surroundings(const Uint& index) const
    {
        glm::vec<3, Real> light{ Real(0), Real(0), Real(0) };
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] = core_test::each<Real>(
                [&](int i) { return picture->texels[static_cast<std::size_t>(core_test::at(index, i))][channel]; });
        }
        return light;
    }
    glm::vec<4, Real> lobe(int k) const
    {
        const glm::vec4& x = (*lobes)[static_cast<std::size_t>(k)];
        return { Real(x.x), Real(x.y), Real(x.z), Real(x.w) };
    }
};

template <class Real>
auto glossy(const ao::light_picture& picture, const std::vector<glm::vec4>& lobes, const std::vector<std::array<float, 6>>& views)
{
    return core_test::evaluate<Real>(views, [&](const std::array<Real, 6>& x) {
        ao::surroundings_pass<Real, lane_resources<Real>> pass{ { &picture, &lobes } };
        return core_test::parts(pass.ao_lobe_light(static_cast<int>(lobes.size()), Real(static_cast<float>(picture.width)),
                                                   Real(static_cast<float>(picture.height)), { x[0], x[1], x[2] },
                                                   { x[3], x[4], x[5] }));
    });
}

} // namespace

TEST_CASE("Glossy light is the same in every lane", "[core][light]")
{
    const ao::light_picture picture = random_picture(31, 17);
    const auto lobes = ao::pack_lobe(*ao::lobe_rule(12, 5));
    core_test::directions random(8);
    std::vector<std::array<float, 6>> views{ { 0, 0, 1, 0, 0, 1 }, { 1, 0, 0, 0, 0, 1 }, { 0, 1, 0, 0, -1, 0 } };
    for (int i = 0; i < 500; ++i) {
        const auto n = random.next();
        const auto v = random.next();
        views.push_back({ n[0], n[1], n[2], v[0], v[1], v[2] });
    }
    const auto scalar = glossy<float>(picture, lobes, views);
    CHECK(scalar == glossy<core_test::lanes4>(picture, lobes, views));
    CHECK(scalar == glossy<core_test::lanes16>(picture, lobes, views));
}
