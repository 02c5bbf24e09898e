// What the tests of temporal passes in motion measure: paths through the small scene, and what a frame has uncovered.
#pragma once

#include "temporal_scene.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace temporal_test {

struct path {
    const char* name;
    stage (*at)(int frame);
};

// Small pictures: every frame's truth is affordable.
inline stage small_stage()
{
    stage s;
    s.width = 48;
    s.height = 32;
    return s;
}

inline const path paths[] = {
    { "static", [](int) { return small_stage(); } },
    { "slow pan",
      [](int frame) {
          stage s = small_stage();
          s.eye = { 0.004 * frame, 0, 0 };
          s.yaw = 0.0005 * frame;
          return s;
      } },
    { "pan",
      [](int frame) {
          stage s = small_stage();
          s.eye = { 0.03 * frame - 0.6, 0, 0 };
          return s;
      } },
    { "orbit",
      [](int frame) { // around a point in front of the wall, half a degree a frame
          stage s = small_stage();
          const double angle = 0.0087 * frame;
          s.eye = { -4 * std::sin(angle), 0, -4 + 4 * std::cos(angle) };
          s.yaw = -angle;
          return s;
      } },
    { "rolling ball",
      [](int frame) {
          stage s = small_stage();
          s.ball = -1.2 + 0.05 * frame;
          return s;
      } },
    { "rolling ball and pan",
      [](int frame) {
          stage s = small_stage();
          s.ball = -1.2 + 0.05 * frame;
          s.eye = { 0.02 * frame - 0.4, 0, 0 };
          return s;
      } },
    { "cut",
      [](int frame) {
          stage s = small_stage();
          s.ball = -1.2 + 0.05 * frame;
          s.eye = { frame < 16 ? 0.0 : 0.8, 0, frame < 16 ? 0.0 : -1.0 };
          return s;
      } },
};

enum class sight { seen_before, uncovered, came_in };

// Whether the point seen at each pixel was seen in the last frame, by rays.
inline std::vector<sight> sights_of(const scene_frame& frame, const stage& now, const stage& before)
{
    const ao::temporal_camera then = detail::camera_of(before);
    const auto old = ao::fold_projection(then.projection, now.width, now.height)->projection;
    std::vector<sight> sights;
    for (int y = 0; y < now.height; ++y) {
        for (int x = 0; x < now.width; ++x) {
            const auto motion = frame.inputs.motion.texel<glm::vec4>(static_cast<std::size_t>(y * now.width + x));
            const double column = x + 0.5 + static_cast<double>(motion.x);
            const double row = y + 0.5 + static_cast<double>(motion.y);
            if (!(column >= 0 && row >= 0 && column < now.width && row < now.height)) {
                sights.push_back(sight::came_in);
                continue;
            }
            const std::array<double, 3> ray{ column * static_cast<double>(old.slope_x) + static_cast<double>(old.offset_x),
                                             row * static_cast<double>(old.slope_y) + static_cast<double>(old.offset_y), -1 };
            std::array<double, 3> to{};
            for (int i = 0; i < 3; ++i) {
                for (int k = 0; k < 3; ++k) {
                    to[static_cast<std::size_t>(i)] +=
                        static_cast<double>(then.world_to_view[i][k]) * ray[static_cast<std::size_t>(k)];
                }
            }
            const double seen = detail::cast(before.eye, to, before.ball).t * before.scale;
            const auto was = static_cast<double>(motion.z);
            sights.push_back(std::abs(seen - was) > 0.002 * was ? sight::uncovered : sight::seen_before);
        }
    }
    return sights;
}

// Root of the mean of squares over what add() was given.
class rms {
public:
    void add(float a, float b)
    {
        sum_ += (static_cast<double>(a) - static_cast<double>(b)) * (static_cast<double>(a) - static_cast<double>(b));
        ++count_;
    }
    std::size_t count() const { return count_; }
    double value() const { return count_ ? std::sqrt(sum_ / static_cast<double>(count_)) : 0; }

private:
    double sum_ = 0;
    std::size_t count_ = 0;
};

} // namespace temporal_test
