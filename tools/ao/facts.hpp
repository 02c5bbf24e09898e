#pragma once

#include "ao/options.hpp"
#include "scene/pixel_classes.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace ao::tools {

// What a plan may rely on about a scene, seen from one place.
struct scene_facts {
    std::size_t triangles = 0;
    std::size_t objects = 0;
    std::size_t materials = 0;  // those of objects
    std::size_t alpha_maps = 0; // of these materials
    std::size_t normal_maps = 0;
    std::size_t reflection_maps = 0;
    std::size_t blends = 0;
    std::string motion; // what --motion names; "none" without --temporal
    bool moves_camera = false;
    bool moves_objects = false;
    std::size_t pixels = 0;
    float nearest = 0.0f; // eye depth of surfaces, scene units; 0 where none is seen
    float farthest = 0.0f;
    float least_radius = 0.0f; // of the kernel, pixels, over the surfaces
    float greatest_radius = 0.0f;
    std::array<std::size_t, pixel_class_count> classes{}; // pixels
    std::size_t jumps = 0;                                // pixels beside a depth jump, of whatever class
};

// Throws `error`.
[[nodiscard]] scene_facts facts_of(const render_options& o);
[[nodiscard]] std::string text_of(const scene_facts& f);
[[nodiscard]] std::string json_of(const scene_facts& f, const render_options& o);

// `ao facts`: prints them, and writes JSON where --json asks for it.
void print_facts(const render_options& o);

} // namespace ao::tools
