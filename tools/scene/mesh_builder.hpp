#pragma once

#include "scene.hpp"

#include <array>
#include <functional>
#include <span>
#include <string_view>

namespace ao::tools {

// A point of an outline that is turned about an axis: distance from it and height along it.
struct outline_point {
    float radius;
    float height;
};

// Adds shapes to a scene, each to the object and material named last. Units and axes are the scene's; Y is up.
// Texture coordinates are lengths times a scale: of flat faces the position along the two axes that the face leans to most, so
// that pictures go on from face to face; of bars, turned outlines and sheets the way round or across and along.
class mesh_builder {
public:
    explicit mesh_builder(scene& to) : s(to) {}

    // A new object. A material of the same name is used again.
    void begin(std::string_view object, std::string_view material, float texture_scale = 1.0f);

    // Corners in order round the rim, any plane quadrilateral; flat normal.
    void quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);
    // With a place in the picture for each, (0, 0) top left.
    void quad(const std::array<glm::vec3, 4>& corners, const std::array<glm::vec2, 4>& uvs);

    // Between two opposite corners.
    void box(const glm::vec3& low, const glm::vec3& high);

    // A box of half extents `half` about `centre`, turned by `yaw` degrees about Y.
    void turned_box(const glm::vec3& centre, const glm::vec3& half, float yaw);

    // A box whose four upper edges are cut by `bevel`, without a bottom.
    void slab(const glm::vec3& low, const glm::vec3& high, float bevel);

    // A straight round bar, open at both ends.
    void bar(const glm::vec3& from, const glm::vec3& to, float radius, int sides);

    // An outline turned about the vertical through `foot`. Smooth round the axis, and along the outline where it bends
    // by less than 40 degrees. The outline goes upward, outside to the right.
    void lathe(const glm::vec3& foot, std::span<const outline_point> outline, int sides);

    // A grid of (columns + 1) x (rows + 1) points of a surface, normals by differences; u and v run 0..1.
    void sheet(const std::function<glm::vec3(float u, float v)>& surface, int columns, int rows);

private:
    std::uint32_t vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    scene& s;
    std::uint32_t material = 0;
    float scale = 1.0f;
};

} // namespace ao::tools
