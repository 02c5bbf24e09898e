#include "bake_embree.hpp"

#include "ao/bake_passes.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ao::cpu::detail {

namespace {

using pass = bake_pass<float>;

class embree_scene final : public bake_ray_shooter {
public:
    explicit embree_scene(const bake_task& task) : task_(task), device_(rtcNewDevice(nullptr)) {}
    embree_scene(const embree_scene&) = delete;
    embree_scene& operator=(const embree_scene&) = delete;
    ~embree_scene() override
    {
        if (scene_ != nullptr) {
            rtcReleaseScene(scene_);
        }
        if (device_ != nullptr) {
            rtcReleaseDevice(device_);
        }
    }

    RTCError build()
    {
        if (device_ == nullptr) {
            return rtcGetDeviceError(nullptr);
        }
        const bake_occluder_arrays& o = task_.occluders;
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                   3 * sizeof(float), std::max<std::size_t>(1, o.point_count)));
        auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                            3 * sizeof(std::uint32_t),
                                                                            std::max<std::size_t>(1, o.triangle_count)));
        if (points != nullptr && corners != nullptr) {
            for (std::size_t i = 0; i < o.point_count; ++i) {
                points[3 * i] = o.points.x[i];
                points[3 * i + 1] = o.points.y[i];
                points[3 * i + 2] = o.points.z[i];
            }
            for (std::size_t i = 0; i < o.triangle_count; ++i) {
                for (std::size_t k = 0; k < 3; ++k) {
                    corners[3 * i + k] = static_cast<std::uint32_t>(o.corners[k][i]);
                }
            }
            if (o.triangle_count == 0) {
                std::fill(corners, corners + 3, 0U);
            }
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene_, geometry);
        }
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
        return rtcGetDeviceError(device_);
    }

    void shoot(const bake_ray_task& rays, std::size_t receiver, std::size_t first, std::size_t last, const bake_view& view,
               float* seconds) const override
    {
        packet p(task_, receiver);
        const auto flush = [&] {
            trace(p);
            for (unsigned i = 0; i < p.filled; ++i) {
                *p.targets[i] = p.open[i];
            }
            p.filled = 0;
        };
        for (std::size_t i = first; i < last; ++i) {
            const bake_line l = line(rays, i);
            const float cosine = pass::ao_bake_cosine(l, p.normal);
            view.cosine[i] = cosine;
            view.open[i] = 1;
            const bool both = l.opposite > 0;
            if (cosine >= 0 || both) {
                p.add(l, cosine < 0 ? -1.0F : 1.0F, view.open + i);
            }
            if (p.filled == wide) {
                flush();
            }
            if (cosine == 0 && both) {
                p.add(l, -1.0F, seconds + i);
            }
            if (p.filled == wide) {
                flush();
            }
        }
        flush();
    }

private:
    static constexpr unsigned wide = 16;

    struct packet {
        glm::vec3 start;
        glm::vec3 normal;
        unsigned filled = 0;
        RTCRayHit16 rays;
        bake_line lines[wide];
        float signs[wide];
        float open[wide];
        float* targets[wide];

        packet(const bake_task& task, std::size_t receiver)
        {
            const bake_receiver_arrays& r = task.receivers;
            start = { r.starts.x[receiver], r.starts.y[receiver], r.starts.z[receiver] };
            normal = { r.normals.x[receiver], r.normals.y[receiver], r.normals.z[receiver] };
            for (unsigned i = 0; i < wide; ++i) {
                rays.ray.org_x[i] = start.x;
                rays.ray.org_y[i] = start.y;
                rays.ray.org_z[i] = start.z;
                rays.ray.dir_x[i] = 1;
                rays.ray.dir_y[i] = 0;
                rays.ray.dir_z[i] = 0;
                rays.ray.time[i] = 0;
                rays.ray.mask[i] = 0xffffffffU;
                rays.ray.flags[i] = 0;
            }
        }
        void add(const bake_line& l, float sign, float* target)
        {
            rays.ray.dir_x[filled] = l.dx * sign;
            rays.ray.dir_y[filled] = l.dy * sign;
            rays.ray.dir_z[filled] = l.dz * sign;
            lines[filled] = l;
            signs[filled] = sign;
            targets[filled] = target;
            ++filled;
        }
    };

    static bake_line line(const bake_ray_task& rays, std::size_t i)
    {
        const auto& f = rays.lines;
        const bake_line l{
            f[0][i], f[1][i], f[2][i], f[3][i], f[4][i], f[5][i], f[6][i], f[7][i], f[8][i], f[9][i], f[10][i], 0
        };
        if (rays.turn == nullptr) {
            return l;
        }
        const float* t = rays.turn;
        return pass::ao_bake_turned({ t[0], t[1], t[2], 0, t[3], t[4], t[5], 0, t[6], t[7], t[8], 0 }, l);
    }

    void trace(packet& p) const
    {
        const bake_options& o = task_.options;
        alignas(64) int valid[wide];
        for (unsigned i = 0; i < wide; ++i) {
            valid[i] = i < p.filled ? -1 : 0;
            p.rays.ray.tnear[i] = 0;
            p.rays.ray.tfar[i] = o.reach;
            p.rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        if (o.falloff == 0) {
            rtcOccluded16(valid, scene_, &context, &p.rays.ray);
        }
        else {
            rtcIntersect16(valid, scene_, &context, &p.rays);
        }
        for (unsigned i = 0; i < p.filled; ++i) {
            p.open[i] = 1;
            if (o.falloff == 0 && p.rays.ray.tfar[i] < 0) { // Embree answers a hit with -inf
                p.open[i] = 0;
            }
            else if (o.falloff != 0 && p.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
                p.open[i] = pass::ao_bake_openness(p.rays.ray.tfar[i], o.reach, o.falloff);
            }
            if (o.ground) {
                const glm::vec4 plane(o.ground_plane[0], o.ground_plane[1], o.ground_plane[2], o.ground_plane[3]);
                const float distance = pass::ao_bake_ground(plane, p.lines[i], p.start, p.signs[i]);
                if (distance >= 0 && distance <= o.reach) {
                    p.open[i] = std::min(p.open[i], pass::ao_bake_openness(distance, o.reach, o.falloff));
                }
            }
        }
    }

    const bake_task& task_;
    RTCDevice device_;
    RTCScene scene_ = nullptr;
};

} // namespace

make_bake_shooter embree_shooter()
{
    return [](const bake_group& group) -> result<std::unique_ptr<bake_ray_shooter>> {
        if (group.task.options.front) {
            return error(errc::unsupported_format, "the route embree has no one-sided occluders");
        }
        auto scene = std::make_unique<embree_scene>(group.task);
        const RTCError code = scene->build();
        if (code != RTC_ERROR_NONE) {
            return error(code == RTC_ERROR_OUT_OF_MEMORY ? errc::out_of_memory : errc::device, "Embree could not build its tree",
                         static_cast<int>(code));
        }
        return std::unique_ptr<bake_ray_shooter>(std::move(scene));
    };
}

} // namespace ao::cpu::detail
