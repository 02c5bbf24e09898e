// Triangles of a scene as a camera sees them, in double precision: what a rasterizer may store at a pixel, and how far off.
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/texture.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gbuffer_test {

using glm::dvec2;
using glm::dvec3;

// Pixels and view space. Perspective projections, row 0 at NDC y = +1.
class lens {
public:
    lens(const ao::gbuffer_camera& c, int width, int height, double near);

    dvec3 to_view(const glm::vec3& world) const { return turn_ * dvec3(world) + move_; }
    dvec3 turned(const glm::vec3& direction) const { return turn_ * dvec3(direction); }
    dvec2 to_clip(const dvec3& p) const; // x and y, over w = -z
    dvec2 to_pixel(const dvec3& p) const;
    dvec3 ray(const dvec2& pixel) const; // z = -1
    double near() const { return near_; }
    double most_translation() const;

private:
    glm::dmat3 turn_;
    dvec3 move_;
    double xx_, yy_, xz_, yz_; // of the projection matrix
    double width_, height_;
    double near_;
};

// One corner of a triangle, or of what the near plane leaves of one.
struct corner {
    dvec3 position; // view space
    dvec3 normal;   // view space
    dvec2 uv;
    dvec2 pixel;
};

// What a triangle has at a pixel.
struct surface_point {
    dvec3 position{ 0.0 };
    dvec3 normal{ 0.0 }; // unit, with the normal map, towards the eye
    double position_bound = 0;
    double normal_bound = 0;
};

class seen_triangle {
public:
    std::uint32_t object = 0; // index into scene::objects
    std::vector<corner> corners;

    // False: nothing of the triangle is before the near plane, or it has no area.
    bool set(const ao::scene& s, std::size_t object_index, std::size_t first_index, const lens& l);
    // Before `at`.
    void bound_rounding(const lens& l);

    // Whether the pixel's centre is within `margin` of the inside of every edge and of the bounding box.
    bool covers(const dvec2& pixel, double margin) const;
    dvec2 low() const { return low_; }
    dvec2 high() const { return high_; }
    // Half a step of snapping, and float's rounding of the corners' coordinates.
    double displacement() const { return displacement_; }

    // See the derivation in gbuffer_truth.cpp. False beyond the horizon of the triangle's plane, and where no position within
    // the bound is near `about`.
    bool at(const dvec2& pixel, const lens& l, const ao::texel_heap& heap, const dvec3& about, surface_point& to) const;
    double distance_to_edge(const dvec2& pixel) const; // pixels
    // To the line along which the two planes cut through each other; 1/depth is linear over the picture.
    double distance_to_cut(const seen_triangle& other, const dvec2& pixel, const lens& l) const;
    // Whether the alpha map cuts somewhere within half a pixel: alpha there lies on both sides of the cutoff give or take
    // `doubt`.
    bool alpha_edge(const dvec2& pixel, const lens& l, const ao::texel_heap& heap, double doubt) const;

private:
    bool uv_at(const dvec2& pixel, const lens& l, dvec2& uv) const;
    dvec3 weights(const dvec3& direction) const; // of the triangle's own corners, over depth
    double footprint(const dvec2& pixel, const lens& l) const;

    const ao::standard_material* material_ = nullptr; // whose maps it has
    bool has_uvs_ = false;
    bool has_tangents_ = false;
    bool front_ = true;
    corner own_[3];
    dvec3 tangents_[3];
    double handedness_ = 1;
    dvec3 dual_[3]; // weights
    dvec3 plane_{ 0.0 };
    double corner_error_ = 0; // view space
    dvec2 low_{ 0.0 };
    dvec2 high_{ 0.0 };
    double displacement_ = 0;
    // Of one way to cut what the near plane leaves into triangles: rounding of attributes over w, constant, per column, per row.
    struct piece {
        std::array<dvec2, 3> pixels; // clockwise
        dvec3 position;
        dvec3 normal;
        dvec3 weight;
        dvec2 reach; // greatest coordinates
    };
    std::vector<piece> pieces_;
    void add_fans(const std::vector<corner>& polygon);
    void add_piece(const std::array<const corner*, 3>& of);
    double most_coordinate_ = 0;
};

// All that can be seen of the scene.
std::vector<seen_triangle> seen_triangles(const ao::scene& s, const lens& l, int width, int height);

} // namespace gbuffer_test
