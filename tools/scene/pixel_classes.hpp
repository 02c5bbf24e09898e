#pragma once

#include "gbuffer.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace ao::tools {

// What makes a pixel hard for a method that sees one layer of depth. Each pixel belongs to the first of these that it is, in the
// order disoccluded, border, thin, silhouette, interior.
enum class pixel_class : std::uint8_t {
    background,
    interior,
    silhouette,  // a depth jump within `near_jump` pixels
    border,      // the radius reaches over the picture's border
    disoccluded, // the last frame did not show the surface (mark_disoccluded)
    thin,        // on, or within `near_jump` pixels of, a surface narrower than `thin_share` of the radius
};
inline constexpr std::size_t pixel_class_count = 6;
[[nodiscard]] const char* name_of(pixel_class c);

inline constexpr int near_jump = 4;         // pixels
inline constexpr float jump_share = 0.1f;   // of the radius: least distance from both pixels' tangent planes that is a jump
inline constexpr float thin_share = 0.25f;  // of the radius
inline constexpr int thinnest_kernel = 128; // pixels: wider surfaces are never thin, however near

// Row by row. `focal`: pixels per unit at distance 1 (perspective), or per unit (orthographic).
struct class_settings {
    float radius = 1.0f; // scene units
    float focal = 1.0f;
    bool orthographic = false;
};
[[nodiscard]] std::vector<pixel_class> classify(const gbuffer& g, const class_settings& s);

// Pixels beside a depth jump, of whatever class.
[[nodiscard]] std::size_t count_jumps(const gbuffer& g, const class_settings& s);

// Of the pixels along rows, pixels per unit at distance 1, or per unit in an orthographic frustum.
[[nodiscard]] float focal_of(const frustum& f, int width);

// Marks every pixel with a surface whose point was outside the last picture, or behind another surface there. `motion`: by pixel,
// xy where the point was minus where it is, in pixels, z its depth in the last frame (motion_of_rays). `before`: the last frame.
struct pixel_motion {
    float x = 0.0f;
    float y = 0.0f;
    float depth = 0.0f;
};
void mark_disoccluded(std::vector<pixel_class>& classes, const gbuffer& before, const std::vector<pixel_motion>& motion);

[[nodiscard]] std::array<std::size_t, pixel_class_count> count_classes(const std::vector<pixel_class>& classes);

} // namespace ao::tools
