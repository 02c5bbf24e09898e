#include "ao/ray_motion.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <vector>

namespace ao::tools {
namespace {

using real = ao::math<double>;

glm::dvec2 pixel_of(const ao::projection_constants& p, const glm::dvec3& point)
{
    const auto c = convert_constants<real::ao_projection, double, decltype(p.projection), float>(p.projection);
    return real::ao_to_pixel(c, point, p.parallel);
}

// This frame's view space to the last one's, by object.
class way_back {
public:
    way_back(const ray_view& now, const ray_view& before, const motion& moves, int frame)
        : to_world_(view_axes(now.camera)),
          to_view_(glm::transpose(view_axes(before.camera))),
          eye_(now.camera.eye),
          eye_before_(before.camera.eye),
          moves_(moves),
          frame_(frame)
    {
    }

    glm::dvec3 operator()(const glm::dvec3& position, std::size_t object)
    {
        const glm::dvec4 world(eye_ + to_world_ * position, 1.0);
        return to_view_ * (glm::dvec3(of(object) * world) - eye_before_);
    }

private:
    const glm::dmat4& of(std::size_t object)
    {
        while (object >= moved_.size()) {
            const std::size_t next = moved_.size();
            moved_.push_back(moves_.transform(next, motion::before(frame_)) * glm::inverse(moves_.transform(next, frame_)));
        }
        return moved_[object];
    }

    glm::dmat3 to_world_, to_view_;
    glm::dvec3 eye_, eye_before_;
    const motion& moves_;
    int frame_;
    std::vector<glm::dmat4> moved_;
};

} // namespace

ao::picture motion_of_rays(const tools::gbuffer& g, const ray_view& now, const ray_view& before, const motion& moves, int frame)
{
    ao::picture picture(pixel_format::rgba32f, g.width, g.height);
    way_back back(now, before, moves, frame);
    for (std::size_t i = 0; i < g.size(); ++i) {
        if (g.hit[i] == 0)
            continue;
        const glm::dvec3 is(g.position[i]);
        const glm::dvec3 was = back(is, g.object[i]);
        const bool ahead = was.z < 0.0;
        // Behind the eye there is no pixel; a host's division by w gives one all the same.
        const glm::dvec2 moved = pixel_of(before.projection, was) - pixel_of(now.projection, is);
        picture.set_texel(i, glm::vec4(moved, ahead ? -was.z : 0.0, 0.0));
    }
    return picture;
}

} // namespace ao::tools
