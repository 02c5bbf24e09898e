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
};

inline constexpr int max_taps = 1024;
inline constexpr int max_filter = 31;

struct settings {
    ao::method method = ao::method::hemisphere;
    int taps = 32;       // 1 ... max_taps; cost is linear in it
    float radius = 1.0F; // scene units, (0, 1e15]
    float bias = 0.02F;  // least depth difference that occludes, scene units, [0, 1e15]; raise it against acne
    // How far behind a surface an offset still counts as occluded, in radii, > 0. Infinite as printed in paper 1; the finite
    // default keeps a foreground object from darkening what lies far behind it.
    float thickness = 2.0F;
    int filter = 5;         // pixels a side, odd, 1 (no filter) ... max_filter
    std::uint32_t seed = 1; // of the random kernels and the rotations
};

// The first thing wrong with the settings, or nothing.
constexpr std::optional<error> validate(const settings& s)
{
    constexpr float limit = 1e15F;
    if (s.method != method::box && s.method != method::hemisphere && s.method != method::halton) {
        return error(errc::invalid_settings, "unknown method");
    }
    if (s.taps < 1 || s.taps > max_taps) {
        return error(errc::invalid_settings, "taps must be 1 to 1024");
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
    return std::nullopt;
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
