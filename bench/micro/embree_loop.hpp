// The rival: the best loop over Embree's any-hit rays that was found, with nothing around it.
#pragma once

#include "micro/measure.hpp"

#include "ao/bake.hpp"

#include <embree3/rtcore.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace ao::bench {

class embree_loop {
public:
    embree_loop(const bake_job& job, int threads) : job_(job), arena_(threads), device_(rtcNewDevice(nullptr))
    {
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                   3 * sizeof(float), job.mesh.points.size()));
        for (std::size_t i = 0; i < job.mesh.points.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                points[3 * i + static_cast<std::size_t>(axis)] = job.mesh.points[i][axis];
            }
        }
        auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), job.mesh.triangles.size()));
        for (std::size_t i = 0; i < job.mesh.triangles.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                corners[3 * i + k] = job.mesh.triangles[i][k];
            }
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    embree_loop(const embree_loop&) = delete;
    embree_loop& operator=(const embree_loop&) = delete;
    ~embree_loop()
    {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    std::vector<float> bake()
    {
        std::vector<float> coefficients(job_.vertices(), 1.0F);
        using range = oneapi::tbb::blocked_range<std::size_t>;
        arena_.execute([&] {
            oneapi::tbb::parallel_for(range(0, job_.vertices(), 16), [&](const range& r) {
                for (std::size_t v = r.begin(); v < r.end(); ++v) {
                    if ((job_.mesh.flags[v] & bake_unbaked) == 0) {
                        coefficients[v] = vertex(v);
                    }
                }
            });
        });
        return coefficients;
    }

private:
    static constexpr unsigned wide = 16;

    float vertex(std::size_t v) const
    {
        const glm::vec3& start = job_.mesh.vertices[v].start;
        const glm::vec3& n = job_.mesh.vertices[v].normal;
        RTCRay16 rays;
        float weights[wide];
        for (unsigned i = 0; i < wide; ++i) {
            rays.org_x[i] = start.x;
            rays.org_y[i] = start.y;
            rays.org_z[i] = start.z;
            rays.time[i] = 0;
            rays.mask[i] = 0xffffffffU;
            rays.flags[i] = 0;
        }
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        float all = 0;
        float open = 0;
        unsigned filled = 0;
        const auto shoot = [&] {
            alignas(64) int valid[wide];
            for (unsigned i = 0; i < wide; ++i) {
                valid[i] = i < filled ? -1 : 0;
                rays.tnear[i] = 0;
                rays.tfar[i] = std::numeric_limits<float>::infinity();
            }
            rtcOccluded16(valid, scene_, &context, &rays);
            for (unsigned i = 0; i < filled; ++i) {
                all += weights[i];
                open += rays.tfar[i] >= 0 ? weights[i] : 0; // Embree answers a hit with -inf
            }
            filled = 0;
        };
        for (const bake_line& l : job_.lines) {
            const float cosine = n.x * l.dx + n.y * l.dy + n.z * l.dz;
            const float sign = cosine < 0 ? -1.0F : 1.0F;
            rays.dir_x[filled] = l.dx * sign;
            rays.dir_y[filled] = l.dy * sign;
            rays.dir_z[filled] = l.dz * sign;
            weights[filled] = l.weight;
            if (++filled == wide) {
                shoot();
            }
        }
        shoot();
        return open / all;
    }

    const bake_job& job_;
    oneapi::tbb::task_arena arena_;
    RTCDevice device_;
    RTCScene scene_ = nullptr;
};

} // namespace ao::bench
