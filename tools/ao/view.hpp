#pragma once

#include "ao/gbuffer.hpp"
#include "ao/options.hpp"
#include "ao/shading.hpp"
#include "host/scene_runner.hpp"
#include "scene/gbuffer.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace ao::tools {

// Targets of a geometry pass by their names; those that there are not are empty.
struct picture_set {
    std::array<ao::picture, host::scene_picture_count> pictures;

    ao::picture& operator[](host::scene_picture which) { return pictures[static_cast<std::size_t>(which)]; }
    const ao::picture& operator[](host::scene_picture which) const { return pictures[static_cast<std::size_t>(which)]; }
};

// One look at a scene, as every part of the library wants it.
struct view {
    ao::camera effect;
    ao::gbuffer_camera drawing; // nothing has moved since the last frame
    ao::shade_camera shading;
};
[[nodiscard]] view make_view(const render_options& o, const tools::camera& c, const tools::frustum& f);

// What the effect reads, and with `shaded` (else null) what that plan reads.
[[nodiscard]] ao::gbuffer_facts targets_of(const render_options& o, const ao::scene& s, const ao::shade_plan* shaded);
[[nodiscard]] ao::shade_facts shade_facts_of(const render_options& o);

// A geometry pass as it is shown and compared: row 0 on top, 0 where there is no surface.
struct shown_surfaces {
    std::vector<std::uint8_t> hit;
    std::vector<float> depth;      // eye depth
    std::vector<glm::vec3> normal; // view space; empty where the pass has none
};
[[nodiscard]] shown_surfaces show(const tools::gbuffer& g);
[[nodiscard]] shown_surfaces show(const picture_set& drawn, const ao::gbuffer_facts& f, const ao::camera_projection& projection);

} // namespace ao::tools
