// Directions and rotations in double, for what is prepared once on the host.
#pragma once

#include "ao/detail/elementary.hpp"
#include "ao/half_turn.hpp"
#include "ao/kernel.hpp"
#include "ao/math.hpp"

#include <array>
#include <cstdint>

namespace ao {

using direction3 = std::array<double, 3>;

using rotation3 = math<double>::ao_rotation;

inline constexpr rotation3 no_rotation{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };

// By a quaternion (w, x, y, z) of any length but 0.
constexpr rotation3 rotation_of_quaternion(double w, double x, double y, double z)
{
    const double s = 2 / (w * w + x * x + y * y + z * z);
    return { 1 - s * (y * y + z * z), s * (x * y - w * z),     s * (x * z + w * y),     0,
             s * (x * y + w * z),     1 - s * (x * x + z * z), s * (y * z - w * x),     0,
             s * (x * z - w * y),     s * (y * z + w * x),     1 - s * (x * x + y * y), 0 };
}

constexpr rotation3 inverse(const rotation3& r)
{
    return { r.xx, r.yx, r.zx, 0, r.xy, r.yy, r.zy, 0, r.xz, r.yz, r.zz, 0 };
}

constexpr direction3 rotated(const rotation3& rotation, const direction3& d)
{
    const auto r = math<double>::ao_rotate(rotation, { d[0], d[1], d[2] });
    return { r.x, r.y, r.z };
}

// Takes directions off the planes and axes along which models are built, where a symmetric rule has many of its points: rays
// would meet edges exactly (a sealed room leaks; vertex-ao.md 5.2). Of the quaternions of square roots of different primes up to
// 23 one that keeps the points of all Lebedev rules away from the nine mirror planes of the cube and the four planes normal to
// its diagonals: N points never come nearer than 0.04 / N.
inline constexpr rotation3 generic_rotation =
    rotation_of_quaternion(detail::sqrt(2.0), detail::sqrt(7.0), detail::sqrt(11.0), detail::sqrt(17.0));

// Uniform over all rotations, the same for an index always (K. Shoemake, "Uniform random rotations", Graphics Gems III, 1992):
// for rules that differ per vertex, which trades banding for noise.
constexpr rotation3 rotation_of_index(std::uint32_t index)
{
    random_stream random(index);
    const double u = static_cast<double>(random.uniform());
    const double first = 2 * detail::pi * static_cast<double>(random.uniform());
    const double second = 2 * detail::pi * static_cast<double>(random.uniform());
    const double a = detail::sqrt(1 - u);
    const double b = detail::sqrt(u);
    return rotation_of_quaternion(b * detail::cosine(second), a * detail::sine(first), a * detail::cosine(first),
                                  b * detail::sine(second));
}

// Takes +z to the unit vector n: for rules about +z. Continuous in n but at -z.
constexpr rotation3 rotation_to(const direction3& n)
{
    const glm::dvec3 h = half_turn<double>::ao_half_turn_axis({ n[0], n[1], n[2] });
    return { 2 * h.x * h.x - 1, 2 * h.x * h.y, 2 * h.x * h.z,     0, 2 * h.x * h.y, 2 * h.y * h.y - 1, 2 * h.y * h.z, 0,
             2 * h.x * h.z,     2 * h.y * h.z, 2 * h.z * h.z - 1, 0 };
}

} // namespace ao
