// The views of the levels and of the bundled scene, checked at a size: the backends' G-buffers show the same surfaces but at
// edges, within the bounds of interpolation, and are shaded alike in every bit.
#pragma once

#include "sweep/gbuffer_agreement.hpp"
#include "sweep/level_views.hpp"

#include "scene/courtyard.hpp"
#include "scene/load.hpp"

#include <catch2/catch.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gbuffer_test {

// Its own camera, the terrace from close by, and through the ivy.
inline std::vector<std::pair<std::string, ao::tools::camera>> courtyard_cameras()
{
    ao::tools::camera terrace;
    terrace.eye = { -1.5f, 2.9f, -3.0f };
    terrace.yaw = -15.0f;
    terrace.pitch = -22.0f;
    terrace.fov = 65.0f;
    ao::tools::camera ivy;
    ivy.eye = { 3.2f, 1.6f, 2.5f };
    ivy.yaw = 75.0f;
    ivy.pitch = 18.0f;
    ivy.fov = 70.0f;
    return { { "courtyard", ao::tools::courtyard_camera() }, { "terrace", terrace }, { "ivy", ivy } };
}

inline std::vector<ao::host::scene_runner_ptr> all_runners()
{
    auto made = ao::host::make_scene_runners("all");
    INFO((made ? std::string() : std::string(made.error().reason())));
    REQUIRE(made);
    return std::move(*made);
}

// The first `views` of each level.
inline void check_levels(int width, int height, std::size_t views)
{
    const auto all = all_runners();
    print_header();
    for (const level& l : levels()) {
        const ao::tools::scene model = ao::tools::load_model(l.model.string());
        const drawn_scene s(model);
        for (std::size_t i = 0; i < l.views.size() && i < views; ++i)
            check_view(all, s, view_of(s, l.views[i].name, l.views[i].camera, width, height));
    }
}

inline void check_courtyard(int width, int height)
{
    const auto all = all_runners();
    const ao::tools::scene model = ao::tools::courtyard();
    const drawn_scene s(model);
    print_header();
    for (const auto& [name, camera] : courtyard_cameras())
        check_view(all, s, view_of(s, name, camera, width, height));
}

} // namespace gbuffer_test
