#include "courtyard.hpp"
#include "json_file.hpp"
#include "motion.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ao::tools {
namespace {

constexpr double courtyard_distance = 12.0; // from courtyard_camera() to the fountain
constexpr double orbit_step = 0.5;          // degrees
constexpr double courtyard_sweep = 50.0;    // degrees, from behind the crates to the arcade

// How far off what the start camera looks at is: as far as the middle of the scene, or what is left of it in front.
double distance_of(const motion_stage& s)
{
    if (s.courtyard)
        return courtyard_distance;
    const bounds b = bounds_of(s.rest);
    const glm::dvec3 middle = (glm::dvec3(b.low) + glm::dvec3(b.high)) / 2.0;
    const double along = glm::dot(-view_axes(s.start)[2], middle - glm::dvec3(s.start.eye));
    return std::max(along, 0.25 * glm::length(glm::dvec3(b.high) - glm::dvec3(b.low)));
}

std::vector<motion::moving_object> objects_of(const motion_stage& s)
{
    return s.courtyard ? courtyard_motion(s.rest) : std::vector<motion::moving_object>{};
}

// 0 ... span ... 0, the same way each frame.
double there_and_back(double way, double span)
{
    const double left = std::fmod(way, 2.0 * span);
    return left < span ? left : 2.0 * span - left;
}

// Around what is `distance` in front of it.
camera turned_around(const camera& start, double distance, double degrees)
{
    camera c = start;
    c.yaw = static_cast<float>(std::remainder(static_cast<double>(start.yaw) + degrees, 360.0));
    const glm::dvec3 focus = glm::dvec3(start.eye) - distance * view_axes(start)[2];
    c.eye = glm::vec3(focus + distance * view_axes(c)[2]);
    return c;
}

} // namespace

motion orbit(const motion_stage& s)
{
    const double sweep = s.courtyard ? courtyard_sweep : 0.0;
    const auto path = [start = s.start, distance = distance_of(s), sweep](int frame) {
        const double way = orbit_step * frame;
        return turned_around(start, distance, sweep > 0.0 ? there_and_back(way, sweep) : way);
    };
    return { path, objects_of(s) };
}

motion pan(const motion_stage& s)
{
    const double distance = distance_of(s);
    const double seen = 2.0 * std::tan(glm::radians(static_cast<double>(s.start.fov)) / 2.0) * distance;
    const auto path = [start = s.start, step = 0.5 * seen / s.height, span = 0.25 * distance](int frame) {
        camera c = start;
        c.eye = glm::vec3(glm::dvec3(start.eye) - there_and_back(step * frame, span) * view_axes(start)[0]);
        return c;
    };
    return { path, objects_of(s) };
}

motion cut(const motion_stage& s)
{
    const int middle = std::max(s.frames / 2, 1);
    const camera other = s.courtyard ? courtyard_other_camera() : turned_around(s.start, distance_of(s), 60.0);
    return { [start = s.start, other, middle](int frame) { return frame < middle ? start : other; }, objects_of(s),
             [middle](int frame) { return frame == middle; } };
}

motion choose_motion(const std::string& words, const motion_stage& s)
{
    if (words == "static")
        return motion(s.start);
    if (words == "orbit")
        return orbit(s);
    if (words == "pan")
        return pan(s);
    if (words == "cut")
        return cut(s);
    return parse_motion(words, json_file::read(words), s);
}

} // namespace ao::tools
