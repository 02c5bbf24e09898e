#pragma once

#include "scene.hpp"

#include <embree3/rtcore.h>

#include <memory>

namespace ao::tools {

// An Embree tree over the triangles of a scene that have an area; watertight (RTC_SCENE_FLAG_ROBUST).
// Holds a copy of what it needs, so the scene may go first. Queries from any number of threads.
class ray_tree {
public:
    // Throws `error` when Embree cannot build it, or when no triangle has an area.
    explicit ray_tree(const scene& s);

    [[nodiscard]] RTCScene handle() const { return tree.get(); }

    // Embree's primitive number to the scene's triangle.
    [[nodiscard]] std::uint32_t triangle_of(unsigned primitive) const { return triangles[primitive]; }

    // Triangles left out for having no area.
    [[nodiscard]] std::size_t degenerate_count() const { return left_out; }

private:
    struct release_device {
        void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
    };
    struct release_scene {
        void operator()(RTCScene s) const { rtcReleaseScene(s); }
    };

    std::unique_ptr<RTCDeviceTy, release_device> device;
    std::unique_ptr<RTCSceneTy, release_scene> tree;
    std::vector<std::uint32_t> triangles;
    std::size_t left_out = 0;
};

} // namespace ao::tools
