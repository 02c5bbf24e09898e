#include "ao/bake_results.hpp"
#include "ao/harmonic_light.hpp"
#include "ao/lobe_light.hpp"
#include "ao/lobe_rule.hpp"
#include "ao/outcome.hpp"
#include "scene/environment.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace ao::tools {
namespace {

constexpr int light_rule = 5810;

// Up to which a lobe lets harmonics through: the factor of order l is about exp(-l^2 / 2 a).
int lobe_order(double exponent)
{
    return std::clamp(static_cast<int>(4.0 * std::sqrt(exponent + 1.0)), 8, max_lobe_order);
}

} // namespace

std::vector<glm::vec3> light_at(const bake_light& light, const bake_work& work)
{
    const ao::light_picture picture = load_light_picture(light.file);
    stop_if_interrupted();
    const bake_model& m = work.baked();
    std::vector<glm::vec3> at;
    at.reserve(m.positions.size());
    std::vector<glm::vec4> lobe;
    packed_harmonics diffuse;
    if (light.exponent)
        lobe = pack_lobe(take("--shininess", lobe_rule(*light.exponent, lobe_order(*light.exponent))));
    else
        diffuse =
            pack_harmonics(averaged(harmonics_of(picture, take("--light", lebedev_rule(light_rule)), max_harmonic_order), 1.0));
    for (std::size_t v = 0; v < m.positions.size(); ++v) {
        const glm::vec3& own = work.job.mesh.vertices[v].normal;
        const glm::vec3 normal = own == glm::vec3(0.0f) ? glm::vec3(0.0f, 1.0f, 0.0f) : own;
        if (!light.exponent) {
            // Eight orders ring below 0 where light is harsh.
            at.push_back(glm::max(light_of_harmonics(diffuse, normal), glm::vec3(0.0f)));
            continue;
        }
        const glm::dvec3 way = light.eye ? *light.eye - m.positions[v] : glm::dvec3(normal);
        const double length = glm::length(way);
        const bool seen = std::isfinite(length) && length > 0.0;
        at.push_back(light_of_lobe<float>(picture, lobe, normal, seen ? glm::vec3(way / length) : normal));
    }
    return at;
}

} // namespace ao::tools
