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

constexpr unsigned solid = 0, cut = 1;

// The hits that are in holes are none.
void pass_through_holes(const RTCFilterFunctionNArguments* hits)
{
    const auto& holes = *static_cast<const alpha_cut*>(hits->geometryUserPtr);
    for (unsigned i = 0; i < hits->N; ++i) {
        if (hits->valid[i] != 0 &&
            holes.hole(RTCHitN_primID(hits->hit, hits->N, i), RTCHitN_u(hits->hit, hits->N, i), RTCHitN_v(hits->hit, hits->N, i)))
            hits->valid[i] = 0;
    }
}

} // namespace

ray_tree::ray_tree(const scene& s) : holes(std::make_unique<alpha_cut>(s)), device(rtcNewDevice(nullptr))
{
    throw_on_failure(device.get());

    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        if (!degenerate(s, t)) {
            const bool has_holes = holes->cuts(s.object[t]);
            triangles[has_holes ? cut : solid].push_back(t);
            if (has_holes)
                holes->add(s, t);
        }
    left_out = s.triangles.size() - triangles[solid].size() - triangles[cut].size();
    if (left_out == s.triangles.size())
        throw error(s.name + ": no triangle has an area");

    tree.reset(rtcNewScene(device.get()));
    throw_on_failure(device.get());
    rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(tree.get(), RTC_BUILD_QUALITY_HIGH);
    add(s, solid);
    add(s, cut);
    rtcCommitScene(tree.get());
    throw_on_failure(device.get());
}

void ray_tree::add(const scene& s, unsigned number)
{
    if (triangles[number].empty())
        return;
    const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), s.positions.size());
    void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                                  triangles[number].size());
    if (vertices != nullptr && indices != nullptr) {
        std::copy(s.positions.begin(), s.positions.end(), static_cast<glm::vec3*>(vertices));
        std::transform(triangles[number].begin(), triangles[number].end(), static_cast<glm::uvec3*>(indices),
                       [&](std::uint32_t t) { return s.triangles[t]; });
        if (number == cut) {
            rtcSetGeometryUserData(geometry, holes.get());
            rtcSetGeometryIntersectFilterFunction(geometry, pass_through_holes);
            rtcSetGeometryOccludedFilterFunction(geometry, pass_through_holes);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(tree.get(), geometry, number);
    }
    rtcReleaseGeometry(geometry);
}

} // namespace ao::tools
