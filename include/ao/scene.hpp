// What a host gives a backend to draw: meshes, textures, materials, objects and lights as plain data over the host's memory.
// World space is right-handed. Nothing here is loaded or owned.
#pragma once

#include "ao/matrix.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace ao {

// Indexed triangles in object space; front faces wind counter-clockwise. Arrays other than `positions` and `indices` may be
// empty where no material that the mesh is drawn with needs them, else they are as long as `positions`.
struct mesh {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;            // any length but zero; empty: the triangle's own
    std::span<const glm::vec4> tangents;           // xyz along +u, w = +1 or -1: bitangent = w * cross(normal, tangent)
    std::span<const glm::vec2> uvs;                // (0, 0) is the corner of the first texel of the first row
    std::span<const glm::vec3> previous_positions; // of deforming meshes, for motion
    std::span<const std::uint32_t> indices;        // three per triangle
};

enum class wrap_mode { repeat, clamp, mirror };

// RGBA, 8 bits each, level 0, rows tightly packed. Levels below are made by the library (ao/texture.hpp).
struct texture {
    int width = 0; // pixels, 1 to 16384
    int height = 0;
    bool srgb = false; // colour; never for normals and masks
    wrap_mode wrap_u = wrap_mode::repeat;
    wrap_mode wrap_v = wrap_mode::repeat;
    std::span<const std::uint8_t> texels; // 4 * width * height
};

inline constexpr int no_texture = -1;

enum class specular_model { phong, blinn };

// Maps are indices into scene::textures.
struct standard_material {
    glm::vec3 ambient{ 1.0F };
    glm::vec3 diffuse{ 0.8F };
    glm::vec3 specular{ 0.0F };
    glm::vec3 emission{ 0.0F };
    float shininess = 32.0F; // exponent, 0 to 8192
    specular_model model = specular_model::blinn;
    glm::vec2 repeat{ 1.0F };     // uv is multiplied by it
    bool two_sided = true;        // else back faces are not drawn
    float alpha_cutoff = 0.5F;    // fragments with less alpha are discarded
    int diffuse_map = no_texture; // multiplies ambient and diffuse
    int alpha_map = no_texture;   // alpha: its alpha channel, or red where alpha_from_red
    bool alpha_from_red = false;
    int normal_map = no_texture;     // tangent space, 0 ... 1 for -1 ... 1
    bool normal_green_down = false;  // DirectX convention
    int specular_map = no_texture;   // multiplies specular
    int reflection_map = no_texture; // equirectangular environment, multiplied by specular and added
};

// Inner node of a blend tree: (1 - b) first + b second, b = k or the mask's red (dark: first, light: second).
// A child is an index into scene::materials if >= 0, else node -1 - child of scene::blends.
struct blend_node {
    int first = 0;
    int second = 0;
    float k = 0.5F;        // [0, 1], used where there is no mask
    int mask = no_texture; // over the object's own uv
};

// One mesh drawn with one material: an index into scene::materials if >= 0, else node -1 - material of scene::blends.
// Geometry of a blend (alpha and normal map, sides) is that of its first leaf.
struct object {
    int mesh = 0;
    int material = 0;
    matrix4 model;          // object to world space
    matrix4 previous_model; // last frame's
};

enum class light_type { directional, point };

struct light {
    light_type type = light_type::directional;
    glm::vec3 vector{ 0.0F, 1.0F, 0.0F }; // world space: towards the light (directional), its position (point)
    glm::vec3 color{ 1.0F };              // linear
    // 1 / (constant + linear d + quadratic d^2), point lights only
    glm::vec3 attenuation{ 1.0F, 0.0F, 0.0F };
};

// Ambient light by direction n of the normal, world space, linear RGB, as the polynomial that real spherical harmonics of order 2
// are: coefficients of 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2. ao/ambient.hpp makes them from harmonics or a picture.
struct ambient_light {
    std::array<glm::vec3, 9> coefficients{};

    ambient_light() = default;
    // The same from everywhere.
    constexpr explicit ambient_light(const glm::vec3& constant) { coefficients[0] = constant; }
};

struct scene {
    std::span<const mesh> meshes;
    std::span<const texture> textures;
    std::span<const standard_material> materials;
    std::span<const blend_node> blends;
    std::span<const object> objects;
    std::span<const light> lights;
    ambient_light ambient;
};

} // namespace ao
