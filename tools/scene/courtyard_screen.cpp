#include "courtyard_screen.hpp"

#include "courtyard.hpp"
#include "courtyard_parts.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace ao::tools {
namespace {

using glm::vec3;

// Made along x at the origin, its front towards +z, and then put in place.
constexpr float half_length = 1.9f, half_depth = 0.12f, top = 2.7f;
constexpr float doorway_left = -1.5f, doorway_right = -0.6f, doorway_top = 2.05f;
constexpr float opening_left = 0.25f, opening_right = 1.35f, opening_bottom = 1.2f, opening_top = 2.3f;
constexpr vec3 hinge{ doorway_left + 0.02f, 0.0f, -0.1f };
constexpr vec3 axle{ (opening_left + opening_right) / 2.0f, (opening_bottom + opening_top) / 2.0f, 0.0f };
constexpr float box_side = 0.6f;
constexpr float box_start = -1.05f;
constexpr double box_way = 2.35; // metres

glm::dmat4 placing()
{
    const glm::dmat4 there = glm::translate(glm::dmat4(1.0), glm::dvec3(-3.0, 0.0, 1.6));
    return glm::rotate(there, glm::radians(30.0), glm::dvec3(0.0, 1.0, 0.0));
}

void wall(mesh_builder& m)
{
    constexpr float foot = -0.02f;
    const auto part = [&](float left, float right, float bottom, float upper) {
        m.box({ left, bottom, -half_depth }, { right, upper, half_depth });
    };
    m.begin("screen wall", "plaster");
    part(-half_length, doorway_left, foot, top);
    part(doorway_left, doorway_right, doorway_top, top);
    part(doorway_right, opening_left, foot, top);
    part(opening_left, opening_right, foot, opening_bottom);
    part(opening_left, opening_right, opening_top, top);
    part(opening_right, half_length, foot, top);
    m.begin("screen coping", "stone");
    m.box({ -half_length - 0.07f, top + 0.01f, -half_depth - 0.07f }, { half_length + 0.07f, top + 0.11f, half_depth + 0.07f });
}

// Boards between two rails and a brace, all a little in front of them on either side.
void door(mesh_builder& m)
{
    constexpr float left = hinge.x, right = doorway_right - 0.02f, bottom = 0.03f, upper = doorway_top - 0.02f;
    constexpr int boards = 5;
    constexpr float pitch = (right - left) / boards, gap = 0.006f;
    m.begin("door", "wood");
    for (int i = 0; i < boards; ++i) {
        const float x = left + pitch * static_cast<float>(i);
        m.box({ x + gap, bottom, hinge.z + 0.012f }, { x + pitch - gap, upper, hinge.z + 0.043f });
    }
    for (const float y : { 0.25f, 1.0f, 1.75f })
        m.box({ left, y - 0.07f, hinge.z }, { right, y + 0.07f, hinge.z + 0.055f });
    m.box({ right - 0.12f, 1.1f, hinge.z + 0.03f }, { right - 0.08f, 1.3f, hinge.z + 0.1f });
}

void fan(mesh_builder& m)
{
    constexpr int blades = 4;
    constexpr float reach = 0.5f, half_width = 0.13f;
    m.begin("fan", "iron");
    for (int i = 0; i < blades; ++i) {
        const float turn = glm::radians(360.0f / blades * static_cast<float>(i));
        const vec3 out{ std::cos(turn), std::sin(turn), 0.0f };
        const vec3 across{ -out.y, out.x, 0.0f };
        const vec3 half = half_width * (std::cos(0.5f) * across + std::sin(0.5f) * vec3(0.0f, 0.0f, 1.0f));
        const vec3 inner = axle + 0.06f * out, outer = axle + reach * out;
        m.quad(inner - 0.5f * half, outer - half, outer + half, inner + 0.5f * half);
    }
    m.box(axle - vec3(0.065f, 0.065f, 0.1f), axle + vec3(0.065f, 0.065f, 0.1f));
}

std::size_t find(const scene& s, std::string_view name)
{
    return static_cast<std::size_t>(std::find(s.object_names.begin(), s.object_names.end(), name) - s.object_names.begin());
}

// About a point, in the screen's own axes.
glm::dmat4 turned(const vec3& about, double radians, const glm::dvec3& axis)
{
    const glm::dmat4 there = glm::translate(glm::dmat4(1.0), glm::dvec3(about));
    return glm::translate(glm::rotate(there, radians, axis), -glm::dvec3(about));
}

} // namespace

void parts::screen(mesh_builder& m, scene& s)
{
    const std::size_t first = s.positions.size();
    wall(m);
    m.begin("box", "wood");
    crate(m, { box_start, box_side / 2.0f + 0.01f, half_depth + box_side / 2.0f + 0.03f }, box_side, 0.0f);
    door(m);
    fan(m);
    const glm::dmat4 to_court = placing();
    for (std::size_t i = first; i < s.positions.size(); ++i) {
        s.positions[i] = vec3(to_court * glm::dvec4(s.positions[i], 1.0));
        s.normals[i] = vec3(glm::dmat3(to_court) * glm::dvec3(s.normals[i]));
    }
}

std::vector<motion::moving_object> courtyard_motion(const scene& s)
{
    // 0 in frame 0, 1 in the middle of the period, slow at both ends.
    const auto swing = [](int frame, double period) { return 0.5 - 0.5 * std::cos(glm::radians(360.0) * frame / period); };
    const auto in_place = [](const glm::dmat4& own) { return placing() * own * glm::inverse(placing()); };
    return {
        { find(s, "box"),
          [=](int frame) {
              return in_place(glm::translate(glm::dmat4(1.0), glm::dvec3(box_way * swing(frame, 200.0), 0.0, 0.0)));
          } },
        { find(s, "door"),
          [=](int frame) {
              return in_place(turned(hinge, glm::radians(100.0) * swing(frame, 120.0), { 0.0, 1.0, 0.0 }));
          } },
        { find(s, "fan"),
          [=](int frame) {
              return in_place(turned(axle, glm::radians(7.5) * frame, { 0.0, 0.0, 1.0 }));
          } },
    };
}

} // namespace ao::tools
