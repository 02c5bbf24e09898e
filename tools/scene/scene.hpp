#pragma once

#include "ao/scene.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ao::tools {

struct bounds {
    glm::vec3 low;
    glm::vec3 high;
};

// What ao::texture views, and where it comes from.
struct scene_texture {
    std::string name; // as the model names it; "*0" where it is embedded without one
    int width = 0;    // pixels, 1 to 16384
    int height = 0;
    bool srgb = false;
    ao::wrap_mode wrap_u = ao::wrap_mode::repeat;
    ao::wrap_mode wrap_v = ao::wrap_mode::repeat;
    std::vector<std::uint8_t> rgba; // rows from the top
    bool missing = false;           // could not be read: the texels are a stand-in
};

// Indexed triangles in world space, right-handed, in the model's own unit of length. For rays both sides of a triangle are
// surface.
struct scene {
    std::string name;

    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // one per position, unit
    std::vector<glm::vec2> uvs;      // one per position, or none; (0, 0) is the corner of the first texel of the first row
    std::vector<glm::vec4> tangents; // one per position, or none: unit, along +u; w = +1 or -1, so that
                                     // w * cross(normal, tangent) is up in the picture, along -v

    std::vector<glm::uvec3> triangles; // indices into positions
    std::vector<std::uint32_t> object; // one per triangle, index into object_names
    std::vector<std::uint32_t> material;

    std::vector<std::string> object_names;
    std::vector<std::string> material_names;

    // One per object name: 1 where its vertices have texture coordinates of their own. Empty: all have if there are any.
    std::vector<std::uint8_t> object_has_uvs;
    // One per object name, as ao::object::material: what the object is drawn with. Empty: the material of its triangles.
    std::vector<int> object_material;

    std::vector<ao::standard_material> materials; // one per material name; empty: ao's defaults
    std::vector<ao::blend_node> blends;
    std::vector<scene_texture> textures;

    std::vector<std::string> warnings; // what loading had to make do without, a line each
};

// Coordinates beyond this make Embree drop a triangle without a word, and their squares come near the end of float.
inline constexpr float largest_coordinate = 1.0e18f;

// Throws `error`, naming the first vertex, triangle or object at fault: nothing to show, a position, normal or texture coordinate
// not finite, a position beyond largest_coordinate, a normal not of unit length (1e-3), an index out of range, an object of
// two materials, a texture whose texels are not as many as its size says. Materials and blends are ao::validate's to check.
void check(const scene& s);

// As ao::object::material, for each object name. An object without triangles has material 0.
[[nodiscard]] std::vector<int> materials_of_objects(const scene& s);

// Of the vertices that triangles use. Precondition: at least one triangle.
[[nodiscard]] bounds bounds_of(const scene& s);

// No area: equal corners, or corners on one line as far as double can tell.
[[nodiscard]] bool degenerate(const scene& s, std::size_t triangle);
[[nodiscard]] std::size_t count_degenerate(const scene& s);

} // namespace ao::tools
