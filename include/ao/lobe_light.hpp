// Glossy light from a picture of the surroundings by a weighted design (ao/shared/lobe_light.h).
#pragma once

#include "ao/light_picture.hpp"
#include "ao/sphere_rule.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace ao {

// What ao_load_lobe returns, the same words on every backend: x_k and l_k. Precondition: a rule of lobe_rule.
inline std::vector<glm::vec4> pack_lobe(const sphere_rule& rule)
{
    assert(rule.domain == rule_domain::lobe);
    std::vector<glm::vec4> packed;
    for (std::size_t k = 0; k < rule.size(); ++k) {
        const direction3& d = rule.directions[k];
        packed.emplace_back(static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2]),
                            static_cast<float>(rule.weights[k]));
    }
    return packed;
}

// Linear RGB that a surface of normal n reflects towards the eye: both of unit length and in the picture's space. Preconditions:
// a valid picture; lobe is not empty.
template <class Real>
glm::vec<3, Real> light_of_lobe(const light_picture& picture, std::span<const glm::vec4> lobe, const glm::vec<3, Real>& n,
                                const glm::vec<3, Real>& to_eye)
{
    detail::picture_pass<Real> pass{ { &picture, lobe } };
    return pass.ao_lobe_light(static_cast<int>(lobe.size()), Real(picture.width), Real(picture.height), n, to_eye);
}

} // namespace ao
