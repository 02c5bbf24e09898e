#pragma once

#include "alpha_cut.hpp"
#include "scene.hpp"

#include <embree3/rtcore.h>

#include <array>
#include <memory>

namespace ao::tools {

// An Embree tree over the triangles of a scene that have an area; watertight (RTC_SCENE_FLAG_ROBUST). Rays pass through the holes
// that alpha maps cut, and see both sides of everything.
// Holds a copy of what it needs, so the scene may go first. Queries from any number of threads.
class ray_tree {
public:
    // Throws `error` when Embree cannot build it, or when no triangle has an area.
    explicit ray_tree(const scene& s);

    [[nodiscard]] RTCScene handle() const { return tree.get(); }

    // Embree's numbers of a geometry and of a primitive in it to the scene's triangle.
    [[nodiscard]] std::uint32_t triangle_of(unsigned geometry, unsigned primitive) const
    {
        return triangles[geometry][primitive];
    }

    // Triangles left out for having no area.
    [[nodiscard]] std::size_t degenerate_count() const { return left_out; }

private:
    struct release_device {
        void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
    };
    struct release_scene {
        void operator()(RTCScene s) const { rtcReleaseScene(s); }
    };

    void add(const scene& s, unsigned geometry);

    std::unique_ptr<alpha_cut> holes; // outlives the tree, which has its address
    std::unique_ptr<RTCDeviceTy, release_device> device;
    std::unique_ptr<RTCSceneTy, release_scene> tree;
    std::array<std::vector<std::uint32_t>, 2> triangles; // without and with holes
    std::size_t left_out = 0;
};

} // namespace ao::tools
