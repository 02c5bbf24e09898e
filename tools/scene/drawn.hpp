#pragma once

#include "scene.hpp"

#include <cstdint>
#include <vector>

namespace ao::tools {

// A scene as the backends draw it. Object i is the object of that number in tools::scene, so what trace_gbuffer and a drawn
// G-buffer say about a pixel is the same: ids = (gbuffer::object + 1, gbuffer::material + 1), both 0 on the background.
// Vertices are in world space already: every model matrix is the identity until objects() is given others.
// Views the arrays of the scene it was made from, which must stay where it is and as it is.
class scene_view {
public:
    // Precondition: s passes `check`.
    explicit scene_view(const tools::scene& s);
    scene_view(const scene_view&) = delete;
    scene_view& operator=(const scene_view&) = delete;
    scene_view(scene_view&&) = default;
    scene_view& operator=(scene_view&&) = default;
    ~scene_view() = default;

    // Until set_lights there is no light but the same white ambient light from everywhere.
    [[nodiscard]] ao::scene get() const;

    void set_lights(std::vector<ao::light> to, const ao::ambient_light& ambient_to);

    // For motion: only the transforms are to be changed.
    [[nodiscard]] std::vector<ao::object>& objects() { return drawn; }

private:
    std::vector<std::uint32_t> indices; // of all meshes, each counted from its own first vertex
    std::vector<ao::mesh> meshes;
    std::vector<ao::object> drawn;
    std::vector<ao::texture> textures;
    std::vector<ao::standard_material> materials;
    std::vector<ao::blend_node> blends;
    std::vector<ao::light> lights;
    ao::ambient_light ambient{ glm::vec3(1.0f) };
};

} // namespace ao::tools
