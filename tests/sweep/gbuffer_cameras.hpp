// Looks at the bundled scene.
#pragma once

#include "scene/courtyard.hpp"

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

} // namespace gbuffer_test
