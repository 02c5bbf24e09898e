// Bent normals on every view of the levels at full size: no backend's differ from another's in any bit, and they are nearer to
// the ray-traced mean unoccluded direction than the normals are.
#include "conformance/runners.hpp"
#include "sweep/level_views.hpp"

#include "ao/half.hpp"
#include "scene/load.hpp"
#include "scene/truth.hpp"

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

constexpr int width = 1280;
constexpr int height = 720;
constexpr int apart = 8; // pixels that are compared with rays
constexpr unsigned rays = 256;

struct opening {
    std::size_t pixel = 0;
    glm::dvec3 mean{ 0.0 }; // of the open directions in view space, as a share of all rays
    double visibility = 0;
};

// Cosine-distributed rays about the shading normal, stratified in their sine and by the golden ratio in azimuth.
opening trace(const ao::tools::scene& s, const ao::tools::ray_tree& tree, const level_view& view, const ao::tools::gbuffer& g,
              std::size_t pixel)
{
    const glm::dmat3 to_world = ao::tools::view_axes(view.camera);
    const glm::dvec3 n = glm::normalize(to_world * glm::dvec3(g.normal[pixel]));
    const glm::dvec3 x = glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 y = glm::cross(n, x);
    const glm::vec3 up(to_world * glm::dvec3(g.geometric_normal[pixel]));
    const glm::vec3 origin =
        g.world[pixel] + ao::tools::ray_offset(s, g.triangle[pixel], g.world[pixel], g.depth[pixel], view.radius) * up;
    opening seen{ pixel, glm::dvec3(0.0), 0 };
    for (unsigned k = 0; k < rays; ++k) {
        const double share = (k + 0.5) / rays;
        const double turn = 2 * std::numbers::pi * k / std::numbers::phi;
        const glm::dvec3 d =
            x * (std::sqrt(share) * std::cos(turn)) + y * (std::sqrt(share) * std::sin(turn)) + n * std::sqrt(1 - share);
        RTCRay ray{};
        ray.org_x = origin.x;
        ray.org_y = origin.y;
        ray.org_z = origin.z;
        ray.dir_x = static_cast<float>(d.x);
        ray.dir_y = static_cast<float>(d.y);
        ray.dir_z = static_cast<float>(d.z);
        ray.tfar = view.radius;
        ray.mask = 0xffffffffu;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(tree.handle(), &context, &ray);
        if (ray.tfar >= 0.0f) { // Embree answers a hit with -inf
            seen.mean += d / static_cast<double>(rays);
            seen.visibility += 1.0 / rays;
        }
    }
    seen.mean = glm::transpose(to_world) * seen.mean;
    return seen;
}

double degrees(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

} // namespace

TEST_CASE("all backends agree on bent normals on every view, and these lead to where it is open")
{
    std::vector<ao::host::runner_ptr> runners = usual_runners();
    for (const level& l : levels()) {
        const ao::tools::scene s = ao::tools::load_model(l.model.string());
        const ao::tools::ray_tree tree(s);
        for (const level_view& view : l.views) {
            INFO(view.name);
            level_inputs in = inputs_of(s, tree, view, width, height);
            in.facts.output_format = ao::pixel_format::rgba16f;
            std::vector<opening> truth;
            for (int y = apart / 2; y < height; y += apart)
                for (int x = apart / 2; x < width; x += apart) {
                    const auto pixel = static_cast<std::size_t>(y * width + x);
                    if (in.surfaces.hit[pixel] != 0)
                        truth.push_back({ pixel, glm::dvec3(0.0), 0 });
                }
            tbb::parallel_for(std::size_t{ 0 }, truth.size(),
                              [&](std::size_t i) { truth[i] = trace(s, tree, view, in.surfaces, truth[i].pixel); });
            for (const auto preset : { ao::preset::low, ao::preset::medium, ao::preset::high, ao::preset::ultra }) {
                ao::settings settings = ao::settings_of(preset, view.radius);
                settings.bent_normal = true;
                ao::picture first;
                for (const ao::host::runner_ptr& r : runners) {
                    if (r->route() == "scalar")
                        continue;
                    auto drawn = r->run(settings, in.facts, in.camera, in.depth, in.normal);
                    REQUIRE(drawn);
                    INFO(r->name());
                    if (first.bytes.empty())
                        first = *drawn;
                    const bool same = drawn->bytes == first.bytes;
                    CHECK(same);
                }
                // Light of 1 + d . x averaged over all d: the error of v (1 + 2/3 d . n) against what the rays let through.
                double normals = 0;
                double bent = 0;
                double light_by_normals = 0;
                double light_by_bent = 0;
                std::size_t open = 0;
                for (const opening& o : truth) {
                    const auto halves = first.texel<std::array<std::uint16_t, 4>>(o.pixel);
                    const glm::dvec3 n = glm::normalize(glm::dvec3(in.surfaces.normal[o.pixel]));
                    const glm::dvec3 b(ao::half_to_float(halves[1]), ao::half_to_float(halves[2]), ao::half_to_float(halves[3]));
                    const double v = static_cast<double>(ao::half_to_float(halves[0])) * 2 / 3;
                    light_by_normals += glm::dot(o.mean - v * n, o.mean - v * n) / 3;
                    light_by_bent += glm::dot(o.mean - v * b, o.mean - v * b) / 3;
                    if (o.visibility >= 0.02 && glm::length(o.mean) > 1e-3) {
                        normals += degrees(n, o.mean);
                        bent += degrees(b, o.mean);
                        ++open;
                    }
                }
                const auto root = [&](double sum) { return std::sqrt(sum / static_cast<double>(truth.size())); };
                const auto count = static_cast<double>(open);
                std::printf("%-8s %d: mean angle to truth, degrees: normal %.2f bent %.2f; light that differs from side to side, "
                            "RMSE: normal %.4f bent %.4f\n",
                            view.name.c_str(), static_cast<int>(preset), normals / count, bent / count, root(light_by_normals),
                            root(light_by_bent));
                std::fflush(stdout);
                CHECK(bent < 0.7 * normals);
                CHECK(light_by_bent < 0.6 * light_by_normals);
            }
        }
    }
}
