#include "ray_tree.hpp"

#include "error.hpp"

#include <algorithm>

namespace ao::tools {
namespace {

void throw_on_failure(RTCDevice device)
{
    const RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_NONE)
        return;
    throw error(code == RTC_ERROR_OUT_OF_MEMORY ? std::string("Embree: out of memory")
                                                : "Embree: error " + std::to_string(static_cast<int>(code)));
}

} // namespace

ray_tree::ray_tree(const scene& s) : device(rtcNewDevice(nullptr))
{
    throw_on_failure(device.get());

    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        if (!degenerate(s, t))
            triangles.push_back(t);
    left_out = s.triangles.size() - triangles.size();
    if (triangles.empty())
        throw error(s.name + ": no triangle has an area");

    tree.reset(rtcNewScene(device.get()));
    throw_on_failure(device.get());
    rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(tree.get(), RTC_BUILD_QUALITY_HIGH);

    const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), s.positions.size());
    void* const indices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), triangles.size());
    if (vertices != nullptr && indices != nullptr) {
        std::copy(s.positions.begin(), s.positions.end(), static_cast<glm::vec3*>(vertices));
        std::transform(triangles.begin(), triangles.end(), static_cast<glm::uvec3*>(indices),
                       [&](std::uint32_t t) { return s.triangles[t]; });
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(tree.get(), geometry);
    }
    rtcReleaseGeometry(geometry);
    rtcCommitScene(tree.get());
    throw_on_failure(device.get());
}

} // namespace ao::tools
