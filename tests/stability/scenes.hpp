// Shots of analytic scenes.
#pragma once

#include "stability/subject.hpp"

#include "unit/core_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stability {

using core_test::both;
using core_test::plane;
using core_test::solid;
using core_test::sphere;
using core_test::viewer;

inline shot shoot(const viewer& v, const solid& scene, const ao::settings& s = {})
{
    const core_test::pictures seen = v.picture(scene);
    shot made;
    made.settings = s;
    made.facts.width = v.width;
    made.facts.height = v.height;
    made.facts.normal_format = ao::pixel_format::rgba32f;
    made.facts.parallel = v.parallel;
    made.camera = v.camera();
    made.depth = seen.depth;
    made.normals = seen.normals;
    return made;
}

// A plane through (0, 0, -distance), turned away from the eye by `degrees`.
inline solid tilted(double degrees, double distance)
{
    const double angle = degrees * 0.017453292519943295;
    const glm::dvec3 n(std::sin(angle), 0, std::cos(angle));
    return plane(n, -n.z * distance);
}

// A wall x = at that meets the floor y = -1.
inline solid crease(double at, double floor = -1)
{
    return both(plane({ 0, 1, 0 }, floor), plane({ -1, 0, 0 }, -at));
}

// A square facing the eye, side 2 half, centre on the axis at this distance.
inline solid square(double half, double distance)
{
    return [=](const glm::dvec3& o, const glm::dvec3& d) {
        const double t = distance + o.z;
        const glm::dvec3 p = o + d * t;
        return t > 0 && std::max(std::abs(p.x), std::abs(p.y)) <= half ? core_test::surface_point{ t, { 0, 0, 1 } }
                                                                       : core_test::surface_point{};
    };
}

// How a depth is stored.
struct depth_storage {
    const char* name;
    ao::depth_source source;
    ao::pixel_format format;
    bool reversed;
};

inline constexpr std::array depth_storages{
    depth_storage{ "r32f linear", ao::depth_source::linear, ao::pixel_format::r32f, false },
    depth_storage{ "d32f", ao::depth_source::hardware, ao::pixel_format::d32f, false },
    depth_storage{ "d32f reversed", ao::depth_source::hardware, ao::pixel_format::d32f, true },
    depth_storage{ "d24", ao::depth_source::hardware, ao::pixel_format::d24, false },
    depth_storage{ "rgba16f position", ao::depth_source::position, ao::pixel_format::rgba16f, false },
    depth_storage{ "rgba32f position", ao::depth_source::position, ao::pixel_format::rgba32f, false },
};

// The shot stored so; the projection's planes at near and far.
inline shot stored_as(shot s, const depth_storage& to, const viewer& v, double near, double far)
{
    s.facts.depth = to.source;
    s.facts.depth_format = to.format;
    ao::projection_options o;
    o.parallel = v.parallel;
    o.reversed = to.reversed;
    s.camera.projection = ao::make_projection({ -v.wide(), v.wide(), -v.extent, v.extent, near, far }, o);
    return s;
}

inline double least(const std::vector<float>& visibility)
{
    double low = 1;
    for (const float x : visibility) {
        low = static_cast<double>(x) >= low ? low : static_cast<double>(x);
        if (!(x >= 0)) {
            return -1; // NaN as well
        }
    }
    return low;
}

inline double mean(const std::vector<float>& x)
{
    double sum = 0;
    for (const float value : x) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(x.size());
}

// NaN differs from everything, itself included.
inline double greatest_difference(const std::vector<float>& a, const std::vector<float>& b)
{
    double most = a.size() == b.size() ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
        const double d = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
        most = d <= most ? most : std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
    }
    return most;
}

} // namespace stability
