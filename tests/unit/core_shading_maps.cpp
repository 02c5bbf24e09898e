// Maps of materials, reflections and ambient light of pictures, against the definitions in double.
#include "unit/core_shading.hpp"

#include "ao/ambient.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

using namespace core_test;

TEST_CASE("Maps multiply what they are maps of, at uv times repeat", "[core][shading]")
{
    shading_fixture f;
    std::vector<std::uint8_t> checks(4 * 4);
    for (std::size_t i = 0; i < 4; ++i) {
        checks[4 * i] = i == 0 || i == 3 ? 255 : 0;
        checks[4 * i + 1] = 255;
        checks[4 * i + 3] = 255;
    }
    ao::standard_material m;
    m.ambient = m.diffuse = glm::vec3(1);
    m.diffuse_map = f.add_texture(2, 2, checks);
    m.repeat = { 3, 2 };
    ao::standard_material shiny = lamp({ 0, 0, 0 });
    shiny.specular = glm::vec3(1);
    shiny.shininess = 0; // a highlight of 1 wherever there is light
    shiny.specular_map = f.add_texture({ 0, 255, 0, 255 });
    f.materials = { m, shiny };
    f.ambient = ao::ambient_light(glm::vec3(0.25F));
    f.lights = { directional({ 0, 0, 1 }, glm::vec3(0.5F)) };
    f.pixels.resize(5);
    f.pixels[0].uv = { 0.25 / 3, 0.25 / 2 }; // centre of the first texel
    f.pixels[1].uv = { 0.75 / 3, 0.25 / 2 };
    f.pixels[2].uv = { 1.25 / 3, 0.75 / 2 };
    f.pixels[3].uv = { 0.1, 0.2 };
    f.pixels[3].footprint = 1; // the mean
    f.pixels[4].material = 1;
    const auto color = f.shade();
    CHECK(apart(rgb(color[0]), { 0.75, 0.75, 0 }) < 1e-6);
    CHECK(apart(rgb(color[1]), { 0, 0.75, 0 }) < 1e-6);
    CHECK(apart(rgb(color[2]), { 0, 0.75, 0 }) < 1e-6);
    CHECK(apart(rgb(color[3]), { 0.75 * 128 / 255, 0.75, 0 }) < 1e-6);
    CHECK(apart(rgb(color[4]), { 0, 0.5, 0 }) < 1e-6);
    CHECK(f.plan().options.maps);
}

TEST_CASE("A reflection map shows the mirrored direction", "[core][shading]")
{
    shading_fixture f;
    // A color that says its own direction: a smooth picture of 256 x 128.
    const int width = 256;
    const int height = 128;
    std::vector<std::uint8_t> texels(static_cast<std::size_t>(4 * width * height), 255);
    const auto direction = [&](double u, double v) {
        const double angle = 2 * ao::detail::pi * (u - 0.5);
        const double polar = ao::detail::pi * v;
        return glm::dvec3(std::sin(angle) * std::sin(polar), std::cos(polar), -std::cos(angle) * std::sin(polar));
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 d = direction((x + 0.5) / width, (y + 0.5) / height);
            for (int c = 0; c < 3; ++c) {
                texels[static_cast<std::size_t>(4 * (y * width + x) + c)] =
                    static_cast<std::uint8_t>(std::lround((d[c] * 0.5 + 0.5) * 255));
            }
        }
    }
    ao::standard_material m = lamp({ 0, 0, 0 });
    m.specular = glm::vec3(0.5F);
    m.shininess = 8192;
    m.reflection_map = f.add_texture(width, height, texels);
    f.materials = { m };
    f.camera.view = glm::mat4(glm::lookAt(glm::dvec3(1, 2, 3), glm::dvec3(-4, 1, 1), glm::dvec3(0, 1, 0)));
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(glm::mat3(f.camera.view.to_glm())));
    std::mt19937 engine(6);
    for (int i = 0; i < 3000; ++i) {
        shaded_pixel p;
        p.normal = random_direction(engine);
        p.position = random_direction(engine) * 3.0;
        f.pixels.push_back(p);
    }
    const ao::shade_plan plan = f.plan();
    CHECK(plan.options.reflections);
    CHECK_FALSE(plan.options.maps);
    const auto color = f.shade(plan);
    double worst = 0;
    for (std::size_t i = 0; i < color.size(); ++i) {
        const glm::dvec3 n = to_world * f.pixels[i].normal;
        const glm::dvec3 to_eye = -glm::normalize(to_world * f.pixels[i].position);
        const glm::dvec3 seen = 2 * glm::dot(to_eye, n) * n - to_eye;
        worst = std::max(worst, apart(rgb(color[i]) * 4.0 - 1.0, seen));
    }
    CAPTURE(worst);
    CHECK(worst < 0.03); // codes of 1 / 255, texels of 1.4 degrees
}

TEST_CASE("Ambient light of a picture is its irradiance", "[core][shading]")
{
    // Bright above, dark below: the irradiance of a step in y is 1/2 + y/2 to first order, 0.5 + 0.5 y exactly.
    const int width = 64;
    const int height = 64;
    std::vector<std::uint8_t> texels(static_cast<std::size_t>(4 * width * height), 0);
    std::fill(texels.begin(), texels.begin() + static_cast<std::ptrdiff_t>(texels.size() / 2), std::uint8_t{ 255 });
    ao::texture t;
    t.width = width;
    t.height = height;
    t.texels = texels;
    const ao::ambient_light ambient = ao::ambient_of_environment(t);
    using m = ao::math<float>;
    const auto light = std::bit_cast<m::ao_ambient_light>(ambient.coefficients);
    CHECK(m::ao_ambient(light, { 0, 1, 0 }).x == Approx(1).margin(0.005));
    CHECK(m::ao_ambient(light, { 0, 0, 1 }).x == Approx(0.5).margin(0.005));
    CHECK(m::ao_ambient(light, { 1, 0, 0 }).y == Approx(0.5).margin(0.005));
    CHECK(m::ao_ambient(light, { 0, -1, 0 }).z == Approx(0).margin(0.005));

    // A picture with everything in it, against the integral of light times cosine; order 2 keeps it within a few percent.
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const double x = static_cast<double>(i / 4 % 64) / 64;
        const double y = static_cast<double>(i / 256) / 64;
        texels[i] =
            static_cast<std::uint8_t>(127 + 60 * std::sin(6.28318 * x + static_cast<double>(i % 4)) + 60 * std::cos(3.14159 * y));
    }
    const auto smooth = std::bit_cast<m::ao_ambient_light>(ao::ambient_of_environment(t).coefficients);
    std::mt19937 engine(3);
    double worst = 0;
    for (int k = 0; k < 50; ++k) {
        const glm::dvec3 n = random_direction(engine);
        double sum = 0;
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                const double polar = ao::detail::pi * (row + 0.5) / height;
                const double angle = 2 * ao::detail::pi * ((column + 0.5) / width - 0.5);
                const glm::dvec3 d(std::sin(angle) * std::sin(polar), std::cos(polar), -std::cos(angle) * std::sin(polar));
                const double solid = std::sin(polar) * (ao::detail::pi / height) * (2 * ao::detail::pi / width);
                sum += std::max(glm::dot(n, d), 0.0) * solid / ao::detail::pi *
                       texels[static_cast<std::size_t>(4 * (row * width + column))] / 255;
            }
        }
        worst = std::max(worst, std::abs(sum - static_cast<double>(m::ao_ambient(smooth, glm::vec3(n)).x)));
    }
    CAPTURE(worst);
    CHECK(worst < 0.02);

    // Never negative, whatever rings.
    ao::ambient_light odd;
    odd.coefficients[1] = glm::vec3(1);
    CHECK(m::ao_ambient(std::bit_cast<m::ao_ambient_light>(odd.coefficients), { 0, -1, 0 }) == glm::vec3(0));
    CHECK(m::ao_ambient(std::bit_cast<m::ao_ambient_light>(odd.coefficients), { 0, std::nanf(""), 0 }) == glm::vec3(0));
}
