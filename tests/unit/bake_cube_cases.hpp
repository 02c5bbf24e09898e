// The cube maps of the route `cube`, written plainly: every triangle in every face. GPUs must look up the same in them.
#pragma once

#include "bake_gpu_cases.hpp"

#include "ao/bake_passes.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace bake_test {

class cube_map {
public:
    using pass = ao::bake_cube_pass<float>;

    cube_map(const ao::bake_job& job, std::size_t vertex, int texels)
        : texels_(texels),
          distances_(static_cast<std::size_t>(6 * texels * texels), 1e30F)
    {
        const ao::bake_ray_reference ray{ job, vertex };
        const glm::vec3 start = job.mesh.vertices[vertex].start;
        for (std::size_t i = 0; i < job.mesh.triangles.size(); ++i) {
            const ao::bake_triangle& t = job.mesh.triangles[i];
            const glm::vec3 a = job.mesh.points[t[0]] - start;
            const glm::vec3 b = job.mesh.points[t[1]] - start;
            const glm::vec3 c = job.mesh.points[t[2]] - start;
            const bool front = pass::ao_dot(a, pass::ao_cross(b, c)) < 0;
            if (ray.occludes(i) && (front || job.settings.sides == ao::bake_sides::both)) {
                for (int face = 0; face < 6; ++face) {
                    draw(face, pass::ao_cube_seen(face, a), pass::ao_cube_seen(face, b), pass::ao_cube_seen(face, c));
                }
            }
        }
    }

    float distance(const glm::vec3& direction) const
    {
        const int face = pass::ao_cube_face_of(direction);
        const glm::vec3 seen = pass::ao_cube_seen(face, direction);
        return distances_[at(face, column(seen), row(seen))];
    }

    // Through the middle of its texel.
    glm::dvec3 middle(const glm::vec3& direction) const
    {
        const int face = pass::ao_cube_face_of(direction);
        const glm::vec3 seen = pass::ao_cube_seen(face, direction);
        const glm::dvec3 m(pass::ao_cube_middle(column(seen), texels_), pass::ao_cube_middle(row(seen), texels_),
                           face % 2 == 0 ? 1.0 : -1.0);
        return glm::normalize(face < 2 ? glm::dvec3(m.z, m.x, m.y) : face < 4 ? glm::dvec3(m.y, m.z, m.x) : m);
    }

private:
    int column(const glm::vec3& seen) const { return pass::ao_cube_texel(seen.x / seen.z, texels_); }
    int row(const glm::vec3& seen) const { return pass::ao_cube_texel(seen.y / seen.z, texels_); }
    std::size_t at(int face, int x, int y) const { return static_cast<std::size_t>((face * texels_ + y) * texels_ + x); }

    void draw(int face, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
    {
        const auto box = pass::ao_cube_box_of(a, b, c, texels_);
        const auto triangle = pass::ao_cube_triangle_of(a, b, c);
        for (int y = box.first_y; y <= box.last_y; ++y) {
            for (int x = box.first_x; x <= box.last_x; ++x) {
                const float found =
                    pass::ao_cube_distance(triangle, pass::ao_cube_middle(x, texels_), pass::ao_cube_middle(y, texels_));
                float& nearest = distances_[at(face, x, y)];
                nearest = found >= 0 ? std::min(nearest, found) : nearest;
            }
        }
    }

    int texels_;
    std::vector<float> distances_;
};

// bake_sum::open of a vertex.
inline std::int32_t open_by_cube(const ao::bake_job& job, std::size_t vertex, int texels)
{
    using shared = ao::bake_pass<float>;
    if ((job.mesh.flags[vertex] & ao::bake_unbaked) != 0) {
        return 0;
    }
    const cube_map cube(job, vertex, texels);
    const ao::bake_ray_reference ray{ job, vertex };
    const ao::bake_vertex& v = job.mesh.vertices[vertex];
    std::int32_t open = 0;
    for (std::size_t i = 0; i < job.lines.size(); ++i) {
        const ao::bake_line line = ray.line(i);
        const float cosine = shared::ao_bake_cosine(line, v.normal);
        for (const float sign : { 1.0F, -1.0F }) {
            if (sign * cosine < 0 || (sign < 0 && !(line.opposite > 0))) {
                continue;
            }
            float nearest = cube.distance(glm::vec3(line.dx * sign, line.dy * sign, line.dz * sign));
            if (job.settings.ground) {
                const float ground = shared::ao_bake_ground(job.ground, line, v.start, sign);
                nearest = ground >= 0 ? std::min(nearest, ground) : nearest;
            }
            const int falloff = static_cast<int>(job.settings.falloff);
            const float part = nearest <= job.reach ? shared::ao_bake_openness(nearest, job.reach, falloff) : 1.0F;
            open += static_cast<std::int32_t>(
                shared::ao_bake_part(shared::ao_bake_weight(line.weight, cosine * sign, job.by_cosine), part));
        }
    }
    return open;
}

// `run` has faces of so many texels.
template <class Run>
void check_cube(const Run& run, int texels)
{
    const auto check = [&](const ao::bake_job& job) {
        const auto sums = run(job, ao::bake_request{ .route = ao::bake_route::cube });
        INFO((sums ? std::string() : std::string(sums.error().reason())));
        REQUIRE(sums);
        REQUIRE(sums->holds(job));
        CHECK(sums->route == ao::bake_route::cube);
        std::size_t differing = 0;
        for (std::size_t i = 0; i < job.vertices(); ++i) {
            differing += sums->sums[i].open == open_by_cube(job, i, texels) ? 0 : 1;
        }
        CHECK(differing == 0);
    };
    for (const setting_case& each : setting_cases()) {
        INFO(each.name);
        check(job_of(sphere_on_floor(), *ao::lebedev_rule(50), each.settings));
    }
    check(job_of(broken(120, 3), *ao::fibonacci_rule(51), {}));
    check(job_of(box({ 0, 0, 0 }, { 1, 2, 1 }, 3, true), *ao::lebedev_rule(26, ao::no_rotation), {}));
}

// Cube maps that are as small as they can be, one after another; ends as other routes do.
template <class Run>
void check_cube_progress(const Run& run)
{
    const auto job = job_of(sphere_on_floor(), *ao::lebedev_rule(26), {});
    const ao::bake_request whole{ .route = ao::bake_route::cube };
    const auto expected = run(job, whole);
    REQUIRE(expected);
    ao::bake_request request = whole;
    double last = 0;
    bool grows = true;
    request.progress = [&](double share) {
        grows = grows && share >= last;
        last = share;
        return share < 0.5;
    };
    auto some = run(job, request);
    REQUIRE(some);
    CHECK(grows);
    CHECK(some->last_line == job.lines.size());
    REQUIRE(some->last_vertex > 0);
    REQUIRE(some->last_vertex < job.vertices());
    const auto rest = run(job, ao::bake_request{ .first_vertex = some->last_vertex, .route = ao::bake_route::cube });
    REQUIRE(rest);
    REQUIRE(ao::merge_bake_sums(*some, *rest));
    CHECK(differing_sums(*some, *expected) == 0);
}

} // namespace bake_test
