// Blended materials by the reference executor: every form the same bits, leaves by the textbook, weights at run time.
#include "unit/core_shading.hpp"

#include "ao/color.hpp"
#include "ao/gbuffer.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

using namespace core_test;

TEST_CASE("Asphalt and snow by a mask: every form the same bits", "[core][shading]")
{
    shading_fixture f;
    ao::standard_material asphalt;
    asphalt.diffuse = glm::vec3(0.1F);
    asphalt.diffuse_map = f.add_texture({ 90, 90, 100, 255 });
    ao::standard_material snow;
    snow.diffuse = glm::vec3(0.9F);
    snow.specular = glm::vec3(0.2F);
    snow.normal_map = f.add_texture({ 200, 128, 220, 255 });
    snow.repeat = glm::vec2(8);
    f.materials = { asphalt, snow };
    std::vector<std::uint8_t> mask(4 * 16);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        mask[i] = static_cast<std::uint8_t>(i / 4 * 17);
    }
    f.blends = { { 0, 1, 0.5F, f.add_texture(16, 1, mask) } };
    f.ambient = ao::ambient_light(glm::vec3(0.3F));
    f.lights = { directional({ 0.5, 0.5, 1 }, glm::vec3(0.8F)) };
    const glm::vec3 tangent = glm::normalize(glm::vec3(1, 0.2F, 0));
    using m = ao::math<float>;
    for (int i = 0; i < 32; ++i) {
        shaded_pixel p;
        p.uv = { (i + 0.5) / 32, 0.5 };
        p.material = -1;
        p.visibility = static_cast<float>(i) / 31;
        p.frame = m::ao_packed_frame(glm::vec3(p.normal), tangent, 1.0F);
        f.pixels.push_back(p);
    }
    CHECK(ao::needs_frame(f.scene()));
    const ao::shade_plan fused = f.plan();
    CHECK(fused.options.frames);
    CHECK(fused.passes.size() == 1);
    CHECK(fused.targets == 0);
    const ao::shade_plan paper = f.plan({ 1, true });
    CHECK(paper.passes.size() == 4); // the one for all other pixels, two leaves, one blend
    CHECK(paper.targets == 2);
    const auto a = f.shade(fused);
    const auto b = f.shade(paper);
    CHECK(a == b);

    // By the definition: each material alone, then the mask.
    ao::standard_material bumpy = snow;
    bumpy.normal_map = ao::no_texture;
    double worst = 0;
    for (std::size_t i = 0; i < f.pixels.size(); ++i) {
        shaded_pixel mapped = f.pixels[i];
        const glm::dvec3 texel = glm::dvec3(200, 128, 220) / 255.0 * 2.0 - 1.0;
        const glm::dvec3 n = f.pixels[i].normal;
        mapped.normal =
            glm::normalize(glm::dvec3(tangent) * texel.x + glm::cross(n, glm::dvec3(tangent)) * texel.y + n * texel.z);
        ao::standard_material grey = asphalt;
        grey.diffuse = asphalt.diffuse * glm::vec3(90, 90, 100) / 255.0F;
        grey.ambient = asphalt.ambient * glm::vec3(90, 90, 100) / 255.0F;
        const double x = std::clamp(f.pixels[i].uv.x * 16 - 0.5, -1.0, 16.0);
        const auto code = [&](double at) { return 17.0 * (static_cast<int>(at + 16) % 16); };
        const double weight =
            (code(std::floor(x)) * (1 - (x - std::floor(x))) + code(std::floor(x) + 1) * (x - std::floor(x))) / 255;
        const glm::dvec3 truth = textbook(f, f.pixels[i], grey) * (1 - weight) + textbook(f, mapped, bumpy) * weight;
        worst = std::max(worst, apart(rgb(a[i]), truth));
    }
    CAPTURE(worst);
    CHECK(worst < 1e-5);
    CHECK(ao::explain(fused).find(
              "2 leaves, 1 blend; in the shading pass, 2 registers; a picture per leaf would take 3 passes and 2 targets") !=
          std::string::npos);
}

TEST_CASE("Leaves of a blend have their own normals on both sides of a surface", "[core][shading]")
{
    shading_fixture f;
    ao::standard_material flat;
    flat.ambient = glm::vec3(0);
    flat.diffuse = glm::vec3(1);
    ao::standard_material bumpy = flat;
    bumpy.normal_map = f.add_texture({ 255, 128, 128, 255 }); // almost along the tangent
    f.materials = { bumpy, flat };
    f.blends = { { 0, 1, 1.0F, ao::no_texture } }; // the geometry's normal is the first leaf's, what is seen the second
    f.lights = { directional({ 0, 0, 1 }, glm::vec3(1)) };
    using m = ao::math<float>;
    for (const float side : { 1.0F, -1.0F }) {
        shaded_pixel p;
        p.material = -1;
        p.side = side;
        p.normal = glm::dvec3(side, 0, 0);
        p.frame = m::ao_packed_frame({ 0, 0, side }, { 1, 0, 0 }, 1.0F);
        f.pixels.push_back(p);
    }
    const auto color = f.shade();
    CHECK(apart(rgb(color[0]), glm::dvec3(1)) < 1e-6);
    CHECK(apart(rgb(color[1]), glm::dvec3(1)) < 1e-6); // (0, 0, -1) seen from behind
}

TEST_CASE("Blends shade as planned: random trees, cut in every way", "[core][shading]")
{
    shading_fixture f;
    std::mt19937 engine(8);
    std::uniform_real_distribution<float> uniform(0, 1);
    const int leaves = 60;
    for (int i = 0; i < leaves; ++i) {
        f.materials.push_back(lamp({ uniform(engine), uniform(engine), uniform(engine) }));
    }
    // Two trees, the second one of 30 leaves, drawn side by side with a plain material.
    const std::function<int(int, int)> grow = [&](int first, int count) {
        if (count == 1) {
            return first;
        }
        const int left = 1 + static_cast<int>(engine() % static_cast<unsigned>(count - 1));
        const auto self = f.blends.size();
        f.blends.push_back({ 0, 0, uniform(engine), ao::no_texture });
        const int a = grow(first, left);
        const int b = grow(first + left, count - left);
        f.blends[self].first = a;
        f.blends[self].second = b;
        return -1 - static_cast<int>(self);
    };
    const int whole = grow(0, leaves);
    const int part = grow(10, 30);
    f.pixels.resize(3);
    f.pixels[0].material = whole;
    f.pixels[1].material = part;
    f.pixels[2].material = 7;
    const std::function<glm::dvec3(int)> truth = [&](int child) {
        if (child >= 0) {
            return glm::dvec3(f.materials[static_cast<std::size_t>(child)].emission);
        }
        const ao::blend_node& n = f.blends[static_cast<std::size_t>(-1 - child)];
        const auto k = static_cast<double>(n.k);
        return truth(n.first) * (1 - k) + truth(n.second) * k;
    };
    const auto color = f.shade();
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(apart(rgb(color[i]), truth(f.pixels[i].material)) < 1e-6 * leaves);
    }
    for (const int registers : { 1, 2, 3, 4 }) {
        const ao::shade_plan plan = f.plan({ registers, true });
        CAPTURE(registers, ao::explain(plan));
        CHECK(f.shade(plan) == color);
    }
}

TEST_CASE("Weights at run time: changed, clamped and counted", "[core][shading]")
{
    shading_fixture f;
    f.materials = { lamp(glm::vec3(0)), lamp(glm::vec3(1)) };
    f.blends = { { 0, 1, 0.0F, ao::no_texture } };
    f.pixels.resize(10);
    for (shaded_pixel& p : f.pixels) {
        p.material = -1;
    }
    ao::shade_plan plan = f.plan({ 16, false });
    std::uint64_t clamped = 0;
    const auto red = [&](float k) {
        ao::set_weight(plan, 0, k);
        return f.shade(plan, &clamped)[0].x;
    };
    CHECK(red(0) == 0);
    CHECK(red(0.25F) == 0.25F);
    CHECK(red(1) == 1);
    CHECK(clamped == 0);
    CHECK(red(1.5F) == 1);
    CHECK(clamped == 10); // every pixel
    CHECK(red(-0.001F) == 0);
    CHECK(clamped == 10);
    CHECK(red(std::nanf("")) == 0);
    CHECK(clamped == 10);
    CHECK(ao::display_code(red(0.5F)) == 188);
}
