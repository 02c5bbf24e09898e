// Shading by the reference executor against the definitions in double: Phong, Blinn, ambient light and visibility, blends.
#include "unit/core_shading.hpp"

#include "ao/ambient.hpp"
#include "ao/gbuffer.hpp"
#include "ao/shading_backend.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <random>

using namespace core_test;

namespace {

double apart(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::max({ std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z) });
}

// Everything in world space and double, as textbooks have it. No maps.
glm::dvec3 textbook(const shading_fixture& f, const shaded_pixel& p, const ao::standard_material& m)
{
    glm::dmat4 view(1);
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            view[c][r] = static_cast<double>(f.camera.view[c][r]);
        }
    }
    const glm::dmat4 to_world = glm::inverse(view);
    const glm::dvec3 position = glm::dvec3(to_world * glm::dvec4(p.position, 1));
    const glm::dvec3 normal = glm::normalize(glm::dmat3(to_world) * p.normal);
    const glm::dvec3 to_eye = glm::normalize(glm::dvec3(to_world[3]) - position);
    glm::dvec3 color = glm::dvec3(m.ambient) * glm::dvec3(f.ambient.coefficients[0]) * static_cast<double>(p.visibility) +
                       glm::dvec3(m.emission);
    for (const ao::light& l : f.lights) {
        glm::dvec3 towards = glm::normalize(glm::dvec3(l.vector));
        glm::dvec3 light(l.color);
        if (l.type == ao::light_type::point) {
            const glm::dvec3 way = glm::dvec3(l.vector) - position;
            const double d = glm::length(way);
            towards = way / d;
            light /= static_cast<double>(l.attenuation.x) + static_cast<double>(l.attenuation.y) * d +
                     static_cast<double>(l.attenuation.z) * d * d;
        }
        const double cosine = glm::dot(normal, towards);
        if (cosine <= 0) {
            continue;
        }
        const glm::dvec3 mirrored = 2 * cosine * normal - towards;
        const double base = m.model == ao::specular_model::phong ? glm::dot(mirrored, to_eye)
                                                                 : glm::dot(normal, glm::normalize(towards + to_eye));
        const double highlight = std::pow(std::clamp(base, 0.0, 1.0), static_cast<double>(m.shininess));
        color += light * (glm::dvec3(m.diffuse) * cosine + glm::dvec3(m.specular) * highlight);
    }
    return color;
}

glm::dvec3 random_direction(std::mt19937& engine)
{
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine)));
}

ao::light directional(const glm::dvec3& towards, const glm::vec3& color)
{
    ao::light l;
    l.vector = glm::vec3(towards);
    l.color = color;
    return l;
}

// A leaf that only shines.
ao::standard_material lamp(const glm::vec3& color)
{
    ao::standard_material m;
    m.ambient = m.diffuse = glm::vec3(0);
    m.emission = color;
    return m;
}

glm::dvec3 rgb(const glm::vec4& color)
{
    return { color.x, color.y, color.z };
}

} // namespace

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

TEST_CASE("Visibility scales the ambient term and nothing else: open plane, closed pit", "[core][shading]")
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

TEST_CASE("Lights can move without another plan", "[core][shading]")
{
    shading_fixture f;
    ao::standard_material m;
    f.materials = { m };
    f.pixels.resize(1);
    f.lights = { directional({ 0, 0, 1 }, glm::vec3(1)), directional({ 0, 1, 0 }, glm::vec3(1)) };
    ao::shade_plan plan = f.plan();
    CHECK(f.shade(plan)[0].x == 0.8F);
    f.lights[0].vector = { 0, 0, -1 };
    f.ambient = ao::ambient_light(glm::vec3(0.5F));
    ao::set_lights(plan, f.scene());
    CHECK(f.shade(plan)[0].x == 0.5F);
    const ao::shade_plan anew = f.plan();
    CHECK(anew.words == plan.words);
    // A light at the surface itself, and one without a direction.
    f.lights[0].type = ao::light_type::point;
    f.lights[0].vector = { 0, 0, -5 };
    f.lights[0].attenuation = { 0, 0, 1 };
    f.lights[1].vector = glm::vec3(0);
    const glm::vec4 near = f.shade()[0];
    CHECK(near.x <= std::numeric_limits<float>::max());
    CHECK(near.x > 1e6F);
}

TEST_CASE("Plans of shading are refused with a reason", "[core][shading]")
{
    shading_fixture f;
    f.materials = { {} };
    f.pixels.resize(1);
    ao::shade_facts facts;
    facts.width = facts.height = 1;
    const auto reason = [&](const ao::shade_facts& changed) {
        const auto plan = ao::make_shade_plan(f.scene(), changed, f.camera);
        return plan ? std::string() : std::string(plan.error().reason());
    };
    CHECK(reason(facts).empty());
    ao::shade_facts wrong = facts;
    wrong.normals = ao::normal_source::from_depth;
    CHECK(reason(wrong) == "shading needs stored normals");
    wrong = facts;
    wrong.width = 0;
    CHECK(reason(wrong) == "picture must have 1 to 65536 pixels a side");
    wrong = facts;
    wrong.visibility_format = ao::pixel_format::rgba16f;
    CHECK(reason(wrong) == "visibility must be r32f or r8");
    wrong = facts;
    wrong.parallel = true;
    CHECK(reason(wrong) == "the plan and the camera differ in being parallel");
    f.camera.view[0][0] = 2;
    CHECK(reason(facts) == "the view matrix is not a rotation and a translation");
    CHECK_FALSE(ao::blend_planner::create(f.scene(), { 0, true }));
    CHECK_FALSE(ao::blend_planner::create(f.scene(), { 17, true }));
}

TEST_CASE("Passes fit their constants, and unused materials cost nothing", "[core][shading]")
{
    shading_fixture f;
    ao::standard_material plain;
    ao::standard_material rich;
    rich.diffuse_map = f.add_texture({ 1, 2, 3, 4 });
    rich.reflection_map = rich.diffuse_map;
    f.materials = { plain, rich };
    f.blends = { { 0, 1, 0.5F, ao::no_texture } };
    f.pixels.resize(1);
    CHECK(f.plan().options == [] {
        ao::shade_options o;
        o.stored_position = true;
        o.visibility = true;
        return o;
    }());
    f.pixels[0].material = -1;
    CHECK(f.plan().options.blends);
    CHECK(f.plan().options.maps);
    CHECK(f.plan().options.reflections);
    f.blends[0].k = 0;
    CHECK_FALSE(f.plan().options.maps); // pruned
}
