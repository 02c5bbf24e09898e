// What a user chooses, and whether it makes sense.
#pragma once

#include "ao/result.hpp"

#include <cstdint>
#include <optional>

namespace ao {

// How visibility is estimated.
enum class method {
    box,        // paper 1 as printed: uniform in the half box, 48 % of it outside the ball
    hemisphere, // uniform in the half ball
    halton,     // half ball, cosine-weighted directions, uniform in distance; Halton bases 2, 3, 5
    bitmask,    // slices of the hemisphere, the sectors that columns of finite thickness block; cosine-weighted
};

inline constexpr int max_taps = 1024;
inline constexpr int max_slices = 16;
inline constexpr int max_filter = 31;

// How many estimates there are.
enum class resolution {
    full, // one a pixel
    half, // of bitmask, one per 2x2 pixels: at the even pixels of even rows; the denoiser finds the others from depth and normals
};

struct settings {
    ao::method method = ao::method::hemisphere;
    // 1 ... max_taps; cost is linear in it. Of bitmask: of all slices together, a multiple of them.
    int taps = 32;
    int slices = 1;      // of bitmask, 1 ... max_slices: half planes through the view vector
    float radius = 1.0F; // scene units, (0, 1e15]
    // Least depth difference that occludes, of bitmask least height over the tangent plane; scene units, [0, 1e15]. Raise it
    // against acne; bitmask needs none where normals and depths fit.
    float bias = 0.02F;
    // How far behind a surface an offset still counts as occluded, in radii, > 0. Infinite as printed in paper 1; the finite
    // default keeps a foreground object from darkening what lies far behind it. Of bitmask: of whatever a depth shows, best at 1.
    float thickness = 2.0F;
    int filter = 5; // pixels a side, odd, 1 (no filter) ... max_filter
    ao::resolution resolution = resolution::full;
    std::uint32_t seed = 1; // of the random kernels and the rotations
};

// The first thing wrong with the settings, or nothing.
constexpr std::optional<error> validate(const settings& s)
{
    constexpr float limit = 1e15F;
    if (s.method != method::box && s.method != method::hemisphere && s.method != method::halton && s.method != method::bitmask) {
        return error(errc::invalid_settings, "unknown method");
    }
    if (s.taps < 1 || s.taps > max_taps) {
        return error(errc::invalid_settings, "taps must be 1 to 1024");
    }
    if (s.slices < 1 || s.slices > max_slices) {
        return error(errc::invalid_settings, "slices must be 1 to 16");
    }
    if (s.method == method::bitmask && s.taps % s.slices != 0) {
        return error(errc::invalid_settings, "taps must be a multiple of the slices");
    }
    if (!(s.radius > 0 && s.radius <= limit)) {
        return error(errc::invalid_settings, "radius must be greater than 0 and at most 1e15");
    }
    if (!(s.bias >= 0 && s.bias <= limit)) {
        return error(errc::invalid_settings, "bias must be 0 to 1e15");
    }
    if (!(s.thickness > 0)) {
        return error(errc::invalid_settings, "thickness must be greater than 0");
    }
    if (s.filter < 1 || s.filter > max_filter || s.filter % 2 == 0) {
        return error(errc::invalid_settings, "filter must be odd, 1 to 31");
    }
    if (s.resolution != resolution::full && s.resolution != resolution::half) {
        return error(errc::invalid_settings, "unknown resolution");
    }
    if (s.resolution == resolution::half && s.method != method::bitmask) {
        return error(errc::invalid_settings, "half resolution is for bitmask only");
    }
    if (s.resolution == resolution::half && s.filter < 3) {
        return error(errc::invalid_settings, "half resolution needs a filter of 3 or more");
    }
    return std::nullopt;
}

enum class preset {
    low,    // 4 taps of 1 slice, half resolution
    medium, // 8 of 1, half resolution
    high,   // 18 of 2, half resolution
    ultra,  // 36 of 3, full resolution
};

// The settings to take where there is no reason for others: bitmask, few slices an estimate, denoised over 9x9 pixels at half
// resolution and 7x7 at full.
constexpr settings settings_of(preset chosen, float radius = 1.0F)
{
    constexpr int taps[] = { 4, 8, 18, 36 };
    constexpr int slices[] = { 1, 1, 2, 3 };
    settings s;
    s.method = method::bitmask;
    s.taps = taps[static_cast<int>(chosen)];
    s.slices = slices[static_cast<int>(chosen)];
    s.radius = radius;
    s.bias = 0;
    s.thickness = 1;
    s.filter = chosen == preset::ultra ? 7 : 9;
    s.resolution = chosen == preset::ultra ? resolution::full : resolution::half;
    return s;
}

// The same settings; does not compile where they are not valid.
consteval settings checked(settings s)
{
    if (validate(s)) {
        throw "invalid ao::settings";
    }
    return s;
}

} // namespace ao
