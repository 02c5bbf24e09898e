#include "gbuffer.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace ao::tools {
namespace {

constexpr int tile = 16;

struct tracer {
    const scene& s;
    const ray_tree& tree;
    const frustum& f;
    const std::vector<int>& materials; // by object
    glm::dvec3 eye;
    glm::dmat3 to_world; // of directions
    gbuffer& g;

    void pixel(int x, int y) const;
};

// Embree's own distance comes from float arithmetic; what it found is kept unless the plane contradicts it, as it can
// on slivers seen edge on.
double refine(double found, const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& corner,
              const glm::dvec3& normal)
{
    const double t = glm::dot(normal, corner - origin) / glm::dot(normal, direction);
    return std::abs(t - found) <= 1.0e-4 * found ? t : found;
}

glm::vec3 shading_normal(const scene& s, const glm::uvec3& corners, double u, double v, const glm::dvec3& geometric)
{
    const glm::dvec3 n = (1.0 - u - v) * glm::dvec3(s.normals[corners.x]) + u * glm::dvec3(s.normals[corners.y]) +
                         v * glm::dvec3(s.normals[corners.z]);
    const double length = glm::length(n);
    return length > 1.0e-6 ? glm::vec3(n / length) : glm::vec3(geometric);
}

void tracer::pixel(int x, int y) const
{
    const pixel_ray ray = ray_through(f, x, y, g.width, g.height);
    const glm::dvec3 origin = eye + to_world * glm::dvec3(ray.origin_x, ray.origin_y, 0.0);
    const glm::dvec3 direction = to_world * glm::dvec3(ray.x, ray.y, -1.0);

    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(origin.x);
    query.ray.org_y = static_cast<float>(origin.y);
    query.ray.org_z = static_cast<float>(origin.z);
    query.ray.dir_x = static_cast<float>(direction.x);
    query.ray.dir_y = static_cast<float>(direction.y);
    query.ray.dir_z = static_cast<float>(direction.z);
    query.ray.tnear = f.near;
    query.ray.tfar = f.far;
    query.ray.mask = 0xffffffffu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(tree.handle(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return;

    const std::uint32_t triangle = tree.triangle_of(query.hit.geomID, query.hit.primID);
    const glm::uvec3 corners = s.triangles[triangle];
    const glm::dvec3 a = s.positions[corners.x], b = s.positions[corners.y], c = s.positions[corners.z];
    glm::dvec3 geometric = glm::normalize(glm::cross(b - a, c - a));
    glm::vec3 shading = shading_normal(s, corners, static_cast<double>(query.hit.u), static_cast<double>(query.hit.v), geometric);
    const double t = refine(static_cast<double>(query.ray.tfar), origin, direction, a, geometric);

    // The file's winding and the file's normals need not agree, so each is turned by itself.
    if (glm::dot(geometric, direction) > 0.0)
        geometric = -geometric;
    if (glm::dot(glm::dvec3(shading), geometric) < 0.0)
        shading = -shading;

    const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(g.width) + static_cast<std::size_t>(x);
    const glm::dmat3 to_view = glm::transpose(to_world);
    g.position[i] = glm::vec3(ray.origin_x + ray.x * t, ray.origin_y + ray.y * t, -t);
    g.depth[i] = static_cast<float>(t);
    g.normal[i] = glm::vec3(glm::normalize(to_view * glm::dvec3(shading)));
    g.geometric_normal[i] = glm::vec3(glm::normalize(to_view * geometric));
    g.world[i] = glm::vec3(origin + direction * t);
    g.triangle[i] = triangle;
    g.object[i] = s.object[triangle];
    g.material[i] = static_cast<std::uint32_t>(materials[s.object[triangle]]);
    g.hit[i] = 1;
}

} // namespace

gbuffer trace_gbuffer(const scene& s, const ray_tree& tree, const camera& c, const frustum& f, int width, int height)
{
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    gbuffer g;
    g.width = width;
    g.height = height;
    g.position.resize(pixels);
    g.depth.resize(pixels);
    g.normal.resize(pixels);
    g.geometric_normal.resize(pixels);
    g.world.resize(pixels);
    g.triangle.resize(pixels, nothing);
    g.object.resize(pixels, nothing);
    g.material.resize(pixels, nothing);
    g.hit.resize(pixels);

    const std::vector<int> materials = materials_of_objects(s);
    const tracer t{ s, tree, f, materials, c.eye, view_axes(c), g };
    tbb::parallel_for(tbb::blocked_range2d<int>(0, height, tile, 0, width, tile), [&](const tbb::blocked_range2d<int>& r) {
        for (int y = r.rows().begin(); y != r.rows().end(); ++y)
            for (int x = r.cols().begin(); x != r.cols().end(); ++x)
                t.pixel(x, y);
    });
    return g;
}

} // namespace ao::tools
