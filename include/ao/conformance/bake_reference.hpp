// Ambient occlusion per vertex as plainly as it can be said: every vertex, every direction, every triangle. What all routes must
// give bit for bit.
#pragma once

#include "ao/bake.hpp"
#include "ao/bake_passes.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ao {

// One direction of a vertex. Precondition: the vertex is not bake_unbaked.
struct bake_ray_reference {
    using pass = bake_pass<float>;
    const bake_job& job;
    std::size_t vertex;

    bake_line line(std::size_t i) const
    {
        return job.turned() ? pass::ao_bake_turned(vertex_rotation(job, vertex), job.lines[i]) : job.lines[i];
    }
    bool occludes(std::size_t triangle) const
    {
        const bool own = job.mesh.objects[triangle] == job.mesh.vertex_objects[vertex];
        return job.settings.occluders == bake_occluders::all || (job.settings.occluders == bake_occluders::own_object) == own;
    }
    // The distance to the nearest occluder along d (sign 1) or -d (sign -1), units; nothing where there is none within reach.
    std::optional<float> nearest(const bake_line& l, float sign) const
    {
        const bake_mesh& m = job.mesh;
        const glm::vec3& start = m.vertices[vertex].start;
        const auto seen = pass::ao_bake_seen(l, start);
        std::optional<float> least;
        const auto take = [&](float distance) { least = least && *least < distance ? *least : distance; };
        for (std::size_t i = 0; i < m.triangles.size(); ++i) {
            if (!occludes(i)) {
                continue;
            }
            const bake_triangle& t = m.triangles[i];
            const auto crossing =
                pass::ao_bake_crossing_of(seen, pass::ao_bake_seen(l, m.points[t[0]]), pass::ao_bake_seen(l, m.points[t[1]]),
                                          pass::ao_bake_seen(l, m.points[t[2]]));
            const bool front = crossing.turned == (sign > 0);
            const bool hit = sign > 0 ? pass::ao_bake_ahead(crossing, job.reach) : pass::ao_bake_behind(crossing, job.reach);
            if (hit && (front || job.settings.sides == bake_sides::both)) {
                take(pass::ao_bake_distance(crossing));
            }
        }
        if (job.settings.ground) {
            const float distance = pass::ao_bake_ground(job.ground, l, start, sign);
            if (distance >= 0 && distance <= job.reach) {
                take(distance);
            }
        }
        return least;
    }
    float open(const bake_line& l, float sign) const
    {
        const auto distance = nearest(l, sign);
        return distance ? pass::ao_bake_openness(*distance, job.reach, static_cast<int>(job.settings.falloff)) : 1.0F;
    }
};

inline bake_sum bake_vertex_reference(const bake_job& job, std::size_t vertex, std::size_t first_line, std::size_t last_line)
{
    using shared = bake_pass<float>;
    bake_sum sum;
    if ((job.mesh.flags[vertex] & bake_unbaked) != 0) {
        return sum;
    }
    const bake_ray_reference ray{ job, vertex };
    float last_cosine = 0; // of the line before, where it and this one are neighbours
    float last_open = 0;
    for (std::size_t i = first_line; i < last_line; ++i) {
        const bake_line line = ray.line(i);
        const float cosine = shared::ao_bake_cosine(line, job.mesh.vertices[vertex].normal);
        const bool both = line.opposite > 0;
        float seen = 0;
        for (const float sign : { 1.0F, -1.0F }) {
            if (sign * cosine < 0 || (sign < 0 && !both)) {
                continue;
            }
            const float open = ray.open(line, sign);
            const float weight = shared::ao_bake_weight(line.weight, cosine * sign, job.by_cosine);
            const float part = shared::ao_bake_part(weight, open);
            sum.all += static_cast<std::int32_t>(weight);
            sum.open += static_cast<std::int32_t>(part);
            sum.count += cosine != 0 ? 1 : 0;
            if (job.settings.bent_normals) {
                sum.x += static_cast<std::int32_t>(shared::ao_bake_part(part, line.dx * sign));
                sum.y += static_cast<std::int32_t>(shared::ao_bake_part(part, line.dy * sign));
                sum.z += static_cast<std::int32_t>(shared::ao_bake_part(part, line.dz * sign));
            }
            seen = open;
        }
        const float counted = both || cosine > 0 ? cosine : 0.0F;
        if (i % 2 == 1 && last_cosine * counted > 0) {
            sum.changes += static_cast<std::int32_t>(shared::ao_bake_change(last_open, seen, counted, job.by_cosine));
        }
        last_cosine = counted;
        last_open = seen;
    }
    return sum;
}

inline result<bake_sums> bake_reference(const bake_job& job, const bake_request& wanted = {})
{
    const auto request = checked_request(job, wanted);
    if (!request) {
        return request.error();
    }
    bake_sums sums{ request->first_vertex, request->last_vertex, request->first_line, request->last_line, {},
                    bake_route::brute,     "reference" };
    for (std::size_t v = request->first_vertex; v < request->last_vertex; ++v) {
        sums.sums.push_back(bake_vertex_reference(job, v, request->first_line, request->last_line));
    }
    return sums;
}

} // namespace ao
