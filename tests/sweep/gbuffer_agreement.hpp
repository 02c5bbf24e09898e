// One view of a scene drawn by every backend: where the G-buffers agree, by how much, and why not where they do not.
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/shading.hpp"
#include "ao/texture.hpp"
#include "host/scene_runner.hpp"
#include "scene/camera.hpp"
#include "scene/drawn.hpp"

#include <string>
#include <vector>

namespace gbuffer_test {

// What the test needs of a scene, once for all views.
struct drawn_scene {
    const ao::tools::scene* model;
    ao::tools::scene_view view;
    ao::texel_heap heap;

    explicit drawn_scene(const ao::tools::scene& s); // with the default lights
};

struct drawn_view {
    std::string name;
    ao::gbuffer_facts facts;
    ao::gbuffer_camera camera;
    double near = 0;
};
drawn_view view_of(const drawn_scene& s, const std::string& name, const ao::tools::camera& c, int width, int height);

// Of two backends.
struct agreement {
    std::size_t pixels = 0;
    std::size_t other_ids = 0;      // object or material differ
    std::size_t crossings = 0;      // the same ids, and two triangles' surfaces at the same depth
    std::size_t other_surfaces = 0; // the same ids, but no triangle at the pixel has both positions and normals within its bounds
    std::size_t far_from_edges = 0; // of those two, beyond half a pixel of an edge: of a triangle, of an alpha map's cut, or
                                    // where two triangles cut through each other
    std::size_t loose = 0;          // of the same surface, with wide bounds; the figures below are of the others
    double edge_distance = 0;       // of those two, the greatest, pixels; cuts of alpha maps count 0
    double position = 0;            // greatest distance of positions over distance from the eye
    double position_share = 0;      // greatest share of the bound that was used
    double normal = 0;              // greatest difference of unit normals without and with a map
    double mapped_normal = 0;
};

struct drawn_pictures {
    ao::picture depth;
    ao::picture position;
    ao::picture normal;
    ao::picture ids;
    ao::picture surface;
    ao::picture frame; // empty where the view has none
};
drawn_pictures draw(ao::host::scene_runner& r, const drawn_scene& s, const drawn_view& v);

// Draws with all, checks every pair, prints a row for each, then checks that shading the first one's pictures has the
// reference's bits everywhere.
void check_view(const std::vector<ao::host::scene_runner_ptr>& runners, const drawn_scene& s, const drawn_view& v);
void print_header();

} // namespace gbuffer_test
