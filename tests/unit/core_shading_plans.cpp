// What plans of shading hold, refuse and let change.
#include "unit/core_shading.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <string>

using namespace core_test;

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
