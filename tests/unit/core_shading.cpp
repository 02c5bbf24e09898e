// Shading by the reference executor against the definitions in double: Phong, Blinn, ambient light and visibility.
#include "unit/core_shading.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

using namespace core_test;

TEST_CASE("Phong and Blinn under directional and point lights equal the textbook in double", "[core][shading]")
{
    shading_fixture f;
    std::mt19937 engine(2);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int i = 0; i < 40; ++i) {
        ao::standard_material m;
        m.ambient = glm::vec3(uniform(engine), uniform(engine), uniform(engine));
        m.diffuse = glm::vec3(uniform(engine), uniform(engine), uniform(engine));
        m.specular = glm::vec3(uniform(engine));
        m.emission = glm::vec3(uniform(engine) * 0.1F);
        m.shininess = i < 3 ? static_cast<float>(i) : std::exp2(uniform(engine) * 8);
        m.model = i % 2 == 0 ? ao::specular_model::phong : ao::specular_model::blinn;
        f.materials.push_back(m);
    }
    f.ambient = ao::ambient_light(glm::vec3(0.2F, 0.3F, 0.4F));
    f.lights.push_back(directional(glm::dvec3(3, 4, 1), { 1, 0.5F, 0.25F })); // of any length
    ao::light lamp;
    lamp.type = ao::light_type::point;
    lamp.vector = { 103, -2, 51 };
    lamp.attenuation = { 1, 0.1F, 0.05F };
    lamp.color = { 3, 3, 2 };
    f.lights.push_back(lamp);
    f.camera.view = glm::mat4(glm::lookAt(glm::dvec3(100, 3, 50), glm::dvec3(101, 1, 47), glm::dvec3(0, 1, 0)));
    for (int i = 0; i < 2000; ++i) {
        shaded_pixel p;
        p.position = glm::dvec3(glm::vec3(uniform(engine) * 4 - 2, uniform(engine) * 4 - 2, -1 - uniform(engine) * 8));
        p.normal = glm::dvec3(glm::vec3(random_direction(engine)));
        p.visibility = uniform(engine);
        p.material = i % 40;
        f.pixels.push_back(p);
    }
    const ao::shade_plan plan = f.plan();
    CHECK_FALSE(plan.options.maps);
    CHECK_FALSE(plan.options.blends);
    CHECK_FALSE(plan.options.reflections);
    CHECK(plan.passes.size() == 1);
    const auto color = f.shade<float>(plan);
    const auto precise = f.shade<double>(plan);
    double worst = 0;
    double worst_precise = 0;
    int lit = 0;
    for (std::size_t i = 0; i < color.size(); ++i) {
        const ao::standard_material& m = f.materials[static_cast<std::size_t>(f.pixels[i].material)];
        const glm::dvec3 truth = textbook(f, f.pixels[i], m);
        // A highlight is as steep as its exponent, in a base that rounds by a few 1e-7.
        const double steep = 1 + 0.5 * static_cast<double>(m.shininess);
        worst = std::max(worst, apart(rgb(color[i]), truth) / steep);
        worst_precise = std::max(worst_precise, apart(glm::dvec3(precise[i]), truth) / steep);
        lit += apart(truth, glm::dvec3(0)) > 0.5 ? 1 : 0;
        CHECK(color[i].w == 1);
    }
    CAPTURE(worst, worst_precise);
    CHECK(lit > 500);
    CHECK(worst < 4e-6);         // of light up to 8
    CHECK(worst_precise < 2e-6); // the table is of floats
}

TEST_CASE("Visibility scales the ambient term and nothing else", "[core][shading]")
{
    shading_fixture f;
    ao::standard_material m;
    m.ambient = { 0.5F, 0.25F, 1 };
    m.diffuse = glm::vec3(0.5F);
    m.specular = glm::vec3(0.25F);
    m.emission = { 0.125F, 0, 0 };
    f.materials = { m };
    f.ambient = ao::ambient_light(glm::vec3(0.5F, 0.25F, 0.125F));
    const auto with = [&](float visibility) {
        f.pixels = { {} };
        f.pixels[0].visibility = visibility;
        return rgb(f.shade()[0]);
    };
    const glm::dvec3 open(0.5 * 0.5 + 0.125, 0.25 * 0.25, 0.125);
    const glm::dvec3 pit(0.125, 0, 0);
    CHECK(with(1) == open); // a constant ambient light is exact
    CHECK(with(0) == pit);
    CHECK(with(0.5F) == 0.5 * (open + pit));
    CHECK(with(std::nanf("")) == open);
    CHECK(with(-1) == open); // the filter's mark of background
    CHECK(with(2) == open);
    f.visibility = false;
    CHECK(with(0) == open);
    f.visibility = true;

    // Direct light is not touched, on the plane or in the pit.
    f.lights = { directional({ 0, 0, 1 }, glm::vec3(1)) };
    const glm::dvec3 direct = with(0) - pit;
    CHECK(direct.y > 0.5);
    CHECK(apart(with(1) - open, direct) == 0);
}

TEST_CASE("Background, unknown materials and surfaces without a normal", "[core][shading]")
{
    shading_fixture f;
    f.materials = { lamp({ 1, 2, 3 }), lamp({ 4, 5, 6 }) };
    f.blends = { { 0, 1, 0.5F, ao::no_texture } };
    f.pixels.resize(4);
    f.pixels[0].background = true;
    f.pixels[2].material = -1;
    f.pixels[3].normal = glm::dvec3(0);
    const ao::shade_plan plan = f.plan();
    f.pixels[1].material = 77; // a geometry pass of another scene
    const auto color = f.shade(plan);
    CHECK(color[0] == glm::vec4(0));
    CHECK(color[1] == glm::vec4(0));
    CHECK(color[2] == glm::vec4(2.5F, 3.5F, 4.5F, 1));
    CHECK(color[3] == glm::vec4(1, 2, 3, 1));
}

TEST_CASE("Position and depth buffer shade alike", "[core][shading]")
{
    shading_fixture f;
    ao::standard_material m;
    m.specular = glm::vec3(0.5F);
    f.materials = { m };
    f.lights = { directional({ 0.2, 0.3, 1 }, glm::vec3(1)) };
    for (std::size_t i = 0; i < 64; ++i) {
        shaded_pixel p;
        p.position = point_under_pixel(f.camera, i, 64, 3 + 0.1 * static_cast<double>(i));
        f.pixels.push_back(p);
    }
    const auto stored = f.shade();
    f.stored_position = false;
    const auto rebuilt = f.shade();
    double worst = 0;
    for (std::size_t i = 0; i < stored.size(); ++i) {
        worst = std::max(worst, apart(rgb(stored[i]), rgb(rebuilt[i])));
    }
    CAPTURE(worst);
    CHECK(worst < 1e-4);
    CHECK(worst > 0);
}
