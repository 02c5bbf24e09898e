// Ambient light along bent normals, and visibility with bounces, by the reference executor against their definitions.
#include "unit/core_shading.hpp"

#include "ao/ambient.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace core_test;
using reals = ao::math<float>;

namespace {

// A grey surface under a sky whose ambient light is a different polynomial in each channel.
shading_fixture under_a_sky()
{
    shading_fixture f;
    ao::standard_material m;
    m.ambient = glm::vec3(1);
    m.diffuse = { 0, 0.5F, 1 };
    f.materials = { m };
    f.ambient = ao::ambient_light(glm::vec3(0.5F));
    f.ambient.coefficients[1] = { 0.25F, 0, 0 };     // of y
    f.ambient.coefficients[2] = { 0, 0.25F, 0 };     // of z
    f.ambient.coefficients[3] = { 0, 0.125F, 0.5F }; // of x
    f.pixels.resize(1);
    return f;
}

} // namespace

TEST_CASE("Ambient light comes along the bent normal, all other light by the normal", "[core][shading][bent]")
{
    shading_fixture f = under_a_sky();
    f.bent_normal = true;
    f.pixels[0].visibility = 0.5F;
    // The camera stands as the world does.
    f.pixels[0].opening = { 0.75F, 0.25F, 0.61236F };
    const glm::dvec3 d = glm::normalize(glm::dvec3(f.pixels[0].opening));
    const glm::dvec3 expected(0.5 + 0.25 * d.y, 0.5 + 0.25 * d.z + 0.125 * d.x, 0.5 + 0.5 * d.x);
    const glm::dvec3 bent = rgb(f.shade()[0]);
    CHECK(glm::length(bent - 0.5 * expected) < 2e-3); // stored as halves
    // Where the picture holds no direction, the normal is taken.
    f.pixels[0].opening = { 0, 0, 1 };
    const glm::dvec3 straight = rgb(f.shade()[0]);
    CHECK(glm::length(bent - straight) > 0.1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3 none : { glm::vec3(0), glm::vec3(nan), glm::vec3(std::numeric_limits<float>::infinity()) }) {
        f.pixels[0].opening = none;
        CHECK(rgb(f.shade()[0]) == straight);
    }
    f.bent_normal = false;
    CHECK(rgb(f.shade()[0]) == straight);

    // A lamp at the normal's zenith lights the surface as ever.
    f.bent_normal = true;
    f.ambient = ao::ambient_light(glm::vec3(0));
    f.lights = { { ao::light_type::directional, { 0, 0, 1 }, glm::vec3(1) } };
    f.pixels[0].opening = { 1, 0, 0 };
    const glm::dvec3 lit = rgb(f.shade()[0]);
    f.pixels[0].opening = { 0, 0, 1 };
    CHECK(lit == rgb(f.shade()[0]));
    CHECK(lit.y > 0.4);
}

TEST_CASE("Bounces brighten visibility by the albedo, between visibility and 1", "[core][shading][bounces]")
{
    for (int i = 0; i <= 64; ++i) {
        const float albedo = static_cast<float>(i) / 64;
        float before = 0;
        CHECK(reals::ao_bounced_visibility(0, albedo) == 0);
        CHECK(reals::ao_bounced_visibility(1, albedo) == 1);
        for (int k = 0; k <= 256; ++k) {
            const float v = static_cast<float>(k) / 256;
            const float bounced = reals::ao_bounced_visibility(v, albedo);
            CAPTURE(albedo, v, bounced);
            CHECK(bounced >= v);
            CHECK(bounced <= 1);
            CHECK(bounced >= before);
            before = bounced;
            // More albedo, more light.
            CHECK(reals::ao_bounced_visibility(v, albedo + 1.0F / 64) >= bounced - 1e-6F);
        }
    }
    for (int k = 0; k <= 1024; ++k) {
        const float v = static_cast<float>(k) / 1024;
        CHECK(std::abs(reals::ao_bounced_visibility(v, 0) - v) < 1e-5F);
    }
    // The published cubic at albedo and visibility 1/2.
    CHECK(reals::ao_bounced_visibility(0.5F, 0.5F) == Approx(0.680963).epsilon(1e-5));
    CHECK(reals::ao_bounced_visibility(0.5F, 7) == reals::ao_bounced_visibility(0.5F, 1));
    CHECK(reals::ao_bounced_visibility(0.5F, -1) == reals::ao_bounced_visibility(0.5F, 0));
}

TEST_CASE("The ambient term is tinted by the diffuse reflectance", "[core][shading][bounces]")
{
    shading_fixture f = under_a_sky();
    f.ambient = ao::ambient_light(glm::vec3(1));
    f.pixels[0].visibility = 0.5F;
    CHECK(rgb(f.shade()[0]) == glm::dvec3(0.5));
    f.multi_bounce = true;
    const glm::dvec3 tinted = rgb(f.shade()[0]);
    CHECK(tinted.x == 0.5);
    CHECK(tinted.y == Approx(0.680963).epsilon(1e-5));
    CHECK(tinted.z > tinted.y);
    f.pixels[0].visibility = 1;
    CHECK(rgb(f.shade()[0]) == glm::dvec3(1));
}

TEST_CASE("Bent normals and bounces without a visibility are refused", "[core][shading]")
{
    shading_fixture f = under_a_sky();
    ao::shade_facts facts;
    facts.width = facts.height = 1;
    const auto reason = [&](const ao::shade_facts& changed) {
        const auto plan = ao::make_shade_plan(f.scene(), changed, f.camera);
        return plan ? std::string() : std::string(plan.error().reason());
    };
    facts.bent_normal = true;
    CHECK(reason(facts) == "visibility with bent normals must be rgba16f");
    facts.visibility_format = ao::pixel_format::rgba16f;
    CHECK(reason(facts).empty());
    facts.visibility = false;
    CHECK(reason(facts) == "bent normals come with a visibility");
    facts.bent_normal = false;
    facts.multi_bounce = true;
    CHECK(reason(facts) == "bounces need a visibility");
}
