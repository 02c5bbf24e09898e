#include "truth.hpp"

#include "sequence.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>

namespace ao::tools {
namespace {

constexpr unsigned packet = 16;
constexpr std::size_t chunk = 256; // pixels between two looks at the cancel flag

float largest(const glm::vec3& v)
{
    const glm::vec3 size = glm::abs(v);
    return std::max(size.x, std::max(size.y, size.z));
}

struct basis {
    glm::vec3 x;
    glm::vec3 y;
    glm::vec3 z;
};

// Duff et al., Building an Orthonormal Basis, Revisited (2017).
basis basis_around(const glm::vec3& n)
{
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return { { 1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x }, { b, sign + n.y * n.y * a, -n.y }, n };
}

struct tracer {
    const ray_tree& tree;
    float radius;
    unsigned rays; // of one half
    std::vector<std::uint32_t> second_dimension;

    float visibility(const glm::vec3& origin, const basis& around, std::uint32_t seed) const;
};

float tracer::visibility(const glm::vec3& origin, const basis& around, std::uint32_t seed) const
{
    const std::uint32_t seed_0 = mix_bits(seed ^ 0x5bd1e995u);
    const std::uint32_t seed_1 = mix_bits(seed ^ 0xa511e9b3u);
    unsigned open = 0;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;

    for (unsigned first = 0; first < rays; first += packet) {
        const unsigned count = std::min(packet, rays - first);
        RTCRay16 r;
        alignas(64) std::array<int, packet> valid;
        for (unsigned k = 0; k < packet; ++k) {
            const unsigned i = std::min(first + k, rays - 1);
            const float u = unit_float(owen_scramble(i, seed_0));
            const float v = unit_float(owen_scramble(second_dimension[i], seed_1));
            const float sine = std::sqrt(u);
            const float angle = 2.0f * std::numbers::pi_v<float> * v;
            const glm::vec3 d =
                sine * std::cos(angle) * around.x + sine * std::sin(angle) * around.y + std::sqrt(1.0f - u) * around.z;
            r.org_x[k] = origin.x;
            r.org_y[k] = origin.y;
            r.org_z[k] = origin.z;
            r.dir_x[k] = d.x;
            r.dir_y[k] = d.y;
            r.dir_z[k] = d.z;
            r.tnear[k] = 0.0f;
            r.tfar[k] = radius;
            r.time[k] = 0.0f;
            r.mask[k] = 0xffffffffu;
            r.id[k] = k;
            r.flags[k] = 0;
            valid[k] = k < count ? -1 : 0;
        }
        rtcOccluded16(valid.data(), tree.handle(), &context, &r);
        for (unsigned k = 0; k < count; ++k)
            open += r.tfar[k] >= 0.0f ? 1u : 0u; // Embree answers a hit with -inf
    }
    return static_cast<float>(open) / static_cast<float>(rays);
}

} // namespace

float ray_offset(const scene& s, std::uint32_t triangle, const glm::vec3& world, float depth, float radius)
{
    float size = largest(world);
    for (int corner = 0; corner < 3; ++corner)
        size = std::max(size, largest(s.positions[s.triangles[triangle][corner]]));
    return 0x1p-19f * size + 0x1p-13f * std::min(radius, depth);
}

std::optional<truth_halves> trace_truth(const scene& s, const ray_tree& tree, const camera& c, const gbuffer& g,
                                        const truth_settings& settings, const std::atomic<bool>* cancel,
                                        const std::function<void(double)>& progress)
{
    tracer t{ tree, settings.radius, settings.rays / 2, {} };
    for (std::uint32_t i = 0; i < t.rays; ++i)
        t.second_dimension.push_back(sobol_1_reversed(i));

    const glm::dmat3 to_world = view_axes(c);
    truth_halves result{ std::vector<float>(g.size(), 1.0f), std::vector<float>(g.size(), 1.0f) };
    const auto cancelled = [&] { return cancel != nullptr && cancel->load(std::memory_order_relaxed); };
    std::mutex reporting;
    std::size_t done = 0;

    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, (g.size() + chunk - 1) / chunk), [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t block = range.begin(); block != range.end() && !cancelled(); ++block) {
                const std::size_t end = std::min(g.size(), (block + 1) * chunk);
                for (std::size_t i = block * chunk; i < end; ++i) {
                    if (g.hit[i] == 0)
                        continue;
                    const glm::vec3 up(to_world * glm::dvec3(g.geometric_normal[i]));
                    const basis around = basis_around(glm::normalize(glm::vec3(to_world * glm::dvec3(g.normal[i]))));
                    const glm::vec3 origin =
                        g.world[i] + ray_offset(s, g.triangle[i], g.world[i], g.depth[i], settings.radius) * up;
                    const std::uint32_t seed = combine(mix_bits(settings.seed), static_cast<std::uint32_t>(i));
                    result.a[i] = t.visibility(origin, around, combine(seed, 0));
                    result.b[i] = t.visibility(origin, around, combine(seed, 1));
                }
                const std::lock_guard lock(reporting);
                done += end - block * chunk;
                if (progress)
                    progress(static_cast<double>(done) / static_cast<double>(g.size()));
            }
        });
    if (cancelled())
        return std::nullopt;
    return result;
}

std::vector<float> mean(const truth_halves& t)
{
    std::vector<float> m(t.a.size());
    for (std::size_t i = 0; i < m.size(); ++i)
        m[i] = (t.a[i] + t.b[i]) / 2.0f;
    return m;
}

} // namespace ao::tools
