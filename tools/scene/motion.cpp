#include "motion.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ao::tools {
namespace {

// Corners of the triangles of one object, which become its own: vertices that another object uses too are doubled.
std::vector<std::uint32_t> own_vertices(scene& s, std::size_t object)
{
    constexpr std::uint32_t unseen = 0xffffffffu;
    std::vector<std::uint8_t> shared(s.positions.size());
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
        if (s.object[t] != object)
            for (int corner = 0; corner < 3; ++corner)
                shared[s.triangles[t][corner]] = 1;
    std::vector<std::uint32_t> place(s.positions.size(), unseen), own;
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        if (s.object[t] != object)
            continue;
        for (int corner = 0; corner < 3; ++corner) {
            std::uint32_t& vertex = s.triangles[t][corner];
            const std::uint32_t from = vertex;
            if (place[from] == unseen) {
                place[from] = from;
                if (shared[from] != 0) {
                    place[from] = static_cast<std::uint32_t>(s.positions.size());
                    s.positions.push_back(glm::vec3(s.positions[from]));
                    s.normals.push_back(glm::vec3(s.normals[from]));
                    if (!s.uvs.empty())
                        s.uvs.push_back(glm::vec2(s.uvs[from]));
                    if (!s.tangents.empty())
                        s.tangents.push_back(glm::vec4(s.tangents[from]));
                }
                own.push_back(place[from]);
            }
            vertex = place[from];
        }
    }
    return own;
}

} // namespace

motion::motion(const camera& stands, std::vector<moving_object> objects)
    : camera_([stands](int) { return stands; }),
      objects_(std::move(objects)),
      moves_camera_(false)
{
}

motion::motion(camera_path path, std::vector<moving_object> objects, std::function<bool(int)> cuts)
    : camera_(std::move(path)),
      objects_(std::move(objects)),
      cuts_(std::move(cuts))
{
}

camera motion::camera_at(int frame) const
{
    assert(frame >= 0);
    return camera_(frame);
}

bool motion::cut_at(int frame) const
{
    return frame > 0 && cuts_ && cuts_(frame);
}

void motion::move(std::vector<ao::object>& objects, int frame) const
{
    for (const moving_object& each : objects_) {
        ao::object& o = objects[each.object];
        o.model = ao::matrix4(glm::mat4(each.at(frame)));
        o.previous_model = ao::matrix4(glm::mat4(each.at(before(frame))));
    }
}

scene motion::moved(const scene& rest, int frame) const
{
    scene s = rest;
    for (const moving_object& each : objects_) {
        const glm::dmat4 transform = each.at(frame);
        const glm::dmat3 directions(transform);
        const glm::dmat3 normals = glm::transpose(glm::inverse(directions));
        for (const std::uint32_t i : own_vertices(s, each.object)) {
            s.positions[i] = glm::vec3(transform * glm::dvec4(s.positions[i], 1.0));
            s.normals[i] = glm::vec3(glm::normalize(normals * glm::dvec3(s.normals[i])));
            if (!s.tangents.empty()) {
                const glm::dvec3 along = directions * glm::dvec3(s.tangents[i]);
                s.tangents[i] = glm::vec4(glm::vec3(glm::normalize(along)), s.tangents[i].w);
            }
        }
    }
    return s;
}

glm::dmat4 motion::transform(std::size_t object, int frame) const
{
    const auto found =
        std::find_if(objects_.begin(), objects_.end(), [&](const moving_object& each) { return each.object == object; });
    return found != objects_.end() ? found->at(frame) : glm::dmat4(1.0);
}

bool motion::moves(std::size_t object) const
{
    return std::any_of(objects_.begin(), objects_.end(), [&](const moving_object& each) { return each.object == object; });
}

std::optional<bounds> bounds_of(const scene& s, std::size_t object)
{
    std::optional<bounds> all;
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
        for (int corner = 0; s.object[t] == object && corner < 3; ++corner) {
            const glm::vec3& p = s.positions[s.triangles[t][corner]];
            if (!all)
                all = bounds{ p, p };
            all->low = glm::min(all->low, p);
            all->high = glm::max(all->high, p);
        }
    return all;
}

} // namespace ao::tools
