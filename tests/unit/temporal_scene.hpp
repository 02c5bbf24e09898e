// A floor, a wall and a ball that may roll, seen by rays from a camera that may move: frames for tests of temporal passes.
#pragma once

#include "ao/conformance/temporal_reference.hpp"
#include "ao/picture.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace temporal_test {

struct scene_frame {
    ao::temporal_camera camera;
    ao::conformance::temporal_inputs inputs;
};

struct stage {
    int width = 96;
    int height = 64;
    std::array<double, 3> origin{}; // of the whole scene in the world
    double scale = 1;
    std::array<double, 3> eye{ 0, 0, 0 };
    double yaw = 0;
    double ball = 0; // x of its centre
};

namespace detail {

struct hit {
    double t = 0;
    std::array<double, 3> normal{ 0, 0, 1 };
    bool ball = false;
};

// The floor y = -1, the wall z = -6, and a ball of radius 0.7 on the floor.
inline hit cast(const std::array<double, 3>& from, const std::array<double, 3>& to, double ball_x)
{
    hit nearest;
    const auto keep = [&](double t, std::array<double, 3> n, bool ball) {
        if (t > 0.05 && (nearest.t == 0 || t < nearest.t)) {
            nearest = { t, n, ball };
        }
    };
    keep((-1 - from[1]) / to[1], { 0, 1, 0 }, false);
    keep((-6 - from[2]) / to[2], { 0, 0, 1 }, false);
    const std::array<double, 3> o{ from[0] - ball_x, from[1] + 0.3, from[2] + 4 };
    double a = 0;
    double b = 0;
    double c = -0.49;
    for (std::size_t i = 0; i < 3; ++i) {
        a += to[i] * to[i];
        b += o[i] * to[i];
        c += o[i] * o[i];
    }
    if (b * b > a * c) {
        const double t = (-b - std::sqrt(b * b - a * c)) / a;
        keep(t, { (o[0] + t * to[0]) / 0.7, (o[1] + t * to[1]) / 0.7, (o[2] + t * to[2]) / 0.7 }, true);
    }
    return nearest;
}

inline ao::temporal_camera camera_of(const stage& s)
{
    ao::temporal_camera c;
    // The first row in memory is the highest.
    c.projection =
        ao::make_projection({ -0.6, 0.6, -0.4, 0.4, 0.4 * s.scale, 200 * s.scale }, { .rows = ao::first_row::at_ndc_plus_one });
    const auto cosine = static_cast<float>(std::cos(s.yaw));
    const auto sine = static_cast<float>(std::sin(s.yaw));
    c.world_to_view[0][0] = c.world_to_view[2][2] = cosine;
    c.world_to_view[2][0] = -sine;
    c.world_to_view[0][2] = sine;
    for (std::size_t i = 0; i < 3; ++i) {
        c.eye[i] = s.origin[i] + s.scale * s.eye[i];
    }
    return c;
}

} // namespace detail

// `before`: the last frame's stage, for motion in pixels with the eye depth of then; it has the same size.
inline scene_frame make_frame(const stage& now, const stage& before)
{
    scene_frame f;
    f.camera = detail::camera_of(now);
    const ao::temporal_camera then = detail::camera_of(before);
    const auto p = ao::fold_projection(f.camera.projection, now.width, now.height)->projection;
    const auto old = ao::fold_projection(then.projection, now.width, now.height)->projection;
    std::vector<float> depth;
    std::vector<glm::vec3> normals;
    f.inputs.motion = ao::picture(ao::pixel_format::rgba32f, now.width, now.height);
    for (int y = 0; y < now.height; ++y) {
        for (int x = 0; x < now.width; ++x) {
            const std::array<double, 3> ray{ (x + 0.5) * static_cast<double>(p.slope_x) + static_cast<double>(p.offset_x),
                                             (y + 0.5) * static_cast<double>(p.slope_y) + static_cast<double>(p.offset_y), -1 };
            std::array<double, 3> to{};
            const auto& turn = f.camera.world_to_view;
            for (int i = 0; i < 3; ++i) {
                for (int k = 0; k < 3; ++k) {
                    to[static_cast<std::size_t>(i)] += static_cast<double>(turn[i][k]) * ray[static_cast<std::size_t>(k)];
                }
            }
            const detail::hit seen = detail::cast(now.eye, to, now.ball);
            depth.push_back(static_cast<float>(seen.t * now.scale));
            glm::vec3 normal(0.0F);
            std::array<double, 3> was{};
            for (int i = 0; i < 3; ++i) {
                for (int k = 0; k < 3; ++k) {
                    const auto axis = static_cast<std::size_t>(k);
                    const double moved = seen.ball && k == 0 ? before.ball - now.ball : 0;
                    normal[i] += turn[k][i] * static_cast<float>(seen.normal[axis]);
                    was[static_cast<std::size_t>(i)] += static_cast<double>(then.world_to_view[k][i]) *
                                                        (now.eye[axis] + seen.t * to[axis] + moved - before.eye[axis]) *
                                                        now.scale;
                }
            }
            normals.push_back(normal);
            const double column = static_cast<double>(old.scale_x) * was[0] / -was[2] + static_cast<double>(old.centre_x);
            const double row = static_cast<double>(old.scale_y) * was[1] / -was[2] + static_cast<double>(old.centre_y);
            f.inputs.motion.set_texel(static_cast<std::size_t>(y * now.width + x),
                                      glm::vec4(static_cast<float>(column - x - 0.5), static_cast<float>(row - y - 0.5),
                                                static_cast<float>(-was[2]), 0.0F));
        }
    }
    f.inputs.depth =
        ao::pack_depth(depth, now.width, now.height, ao::depth_source::linear, ao::pixel_format::r32f, f.camera.projection);
    f.inputs.normal = ao::pack_normals(normals, now.width, now.height, ao::normal_source::vector, ao::pixel_format::rgba32f);
    return f;
}

inline ao::temporal_facts facts_of(const stage& s, bool motion)
{
    ao::temporal_facts f;
    f.frame.width = s.width;
    f.frame.height = s.height;
    f.frame.normal_format = ao::pixel_format::rgba32f;
    f.motion = motion;
    f.motion_format = ao::pixel_format::rgba32f;
    return f;
}

using executor = ao::conformance::temporal_executor<float>;
using picture = ao::conformance::values<float>;

inline executor make_executor(const ao::temporal_settings& s, const ao::temporal_facts& f)
{
    return executor(*ao::make_temporal_plan(s, f));
}

// The whole sequence in one frame: the integral that samples approach.
inline picture integral_of(const scene_frame& frame, ao::temporal_settings s, const ao::temporal_facts& f)
{
    s.first_samples = s.later_samples = s.period;
    s.most_weight = 4095;
    s.filter = 1;
    executor e = make_executor(s, f);
    return e.run(frame.inputs, frame.camera);
}

inline double rmse(const picture& a, const picture& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        const double difference = static_cast<double>(a.texels[i].x) - static_cast<double>(b.texels[i].x);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(a.texels.size()));
}

inline std::size_t differing(const picture& a, const picture& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        count += a.texels[i].x == b.texels[i].x ? 0 : 1;
    }
    return count;
}

} // namespace temporal_test
