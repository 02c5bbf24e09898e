#pragma once

#include "gbuffer.hpp"

#include <atomic>
#include <functional>
#include <optional>

namespace ao::tools {

struct truth_settings {
    float radius = 1.0f;    // length of a ray, scene units, > 0; a hit counts fully up to it and not at all beyond
    unsigned rays = 256;    // per pixel over both halves; even, 2..65536; a power of two is sampled best
    std::uint32_t seed = 1; // same seed, same bits, whatever the number of threads
};

// Two independent estimates of the same picture, each from half the rays; 1 = open, background 1.
struct truth_halves {
    std::vector<float> a;
    std::vector<float> b;
};

// The share of cosine-distributed rays about the shading normal that meet no surface within the radius. The rays
// start off the surface along its geometric normal, by `ray_offset`, and are simply traced: one that leaves below its
// own triangle (where the shading normal leans) is blocked by that triangle, as light from there would be.
// Rays come from the Sobol sequence, Owen-scrambled afresh for each pixel and half.
// Empty when `cancel` became true. `progress` hears of growing shares of the work, 0..1, from any thread, one at a time.
[[nodiscard]] std::optional<truth_halves> trace_truth(const scene& s, const ray_tree& tree, const camera& c, const gbuffer& g,
                                                      const truth_settings& settings, const std::atomic<bool>* cancel = nullptr,
                                                      const std::function<void(double)>& progress = {});

[[nodiscard]] std::vector<float> mean(const truth_halves& t);

// How far off the surface a ray starts, in scene units. Two parts: 2^-19 (16 units in the last place) of the largest
// number that goes into the hit, which is what float leaves uncertain about where the triangle is, at any scale and
// distance from the origin; and 2^-13 of the radius or the depth, whichever is less, so that two faces modelled as one
// (decals, doubled walls, coordinates written with five digits) do not blacken each other. The price are contact shadows
// narrower than that, which at 2^-13 of the depth are below a tenth of a pixel in any usual picture.
[[nodiscard]] float ray_offset(const scene& s, std::uint32_t triangle, const glm::vec3& world, float depth, float radius);

} // namespace ao::tools
