// What sweep/gbuffer_levels.cpp does at full length, in a size for every day.
#include "sweep/gbuffer_agreement.hpp"
#include "sweep/gbuffer_cameras.hpp"
#include "sweep/level_views.hpp"

#include "scene/load.hpp"

#include <catch2/catch.hpp>

using namespace gbuffer_test;

namespace {

constexpr int width = 320;
constexpr int height = 180;

std::vector<ao::host::scene_runner_ptr> runners()
{
    auto made = ao::host::make_scene_runners("all");
    INFO((made ? std::string() : std::string(made.error().reason())));
    REQUIRE(made);
    return std::move(*made);
}

} // namespace

TEST_CASE("the backends draw a view of each level alike, and shade alike what one of them drew")
{
    const auto all = runners();
    print_header();
    for (const level& l : levels()) {
        const ao::tools::scene model = ao::tools::load_model(l.model.string());
        const drawn_scene s(model);
        check_view(all, s, view_of(s, l.views.front().name, l.views.front().camera, width, height));
    }
}

TEST_CASE("the backends draw the bundled scene alike, and shade alike what one of them drew")
{
    const auto all = runners();
    const ao::tools::scene model = ao::tools::courtyard();
    const drawn_scene s(model);
    print_header();
    for (const auto& [name, camera] : courtyard_cameras())
        check_view(all, s, view_of(s, name, camera, width, height));
}
