// Light from all around as an equirectangular picture: look-up for every Real type, and its spherical harmonics
// (ao/shared/surroundings.h).
#pragma once

#include "ao/harmonic_series.hpp"
#include "ao/math.hpp"
#include "ao/result.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ao {

// Linear RGB, row by row: the middle of the picture is -Z, right of it +X, its first row +Y.
struct light_picture {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> texels;
};

inline constexpr int max_light_side = 16384;

// Fails for sizes outside 1 ... 16384, another number of texels, and light that is negative, not finite or above 1e30.
inline result<success> validate(const light_picture& picture)
{
    if (picture.width < 1 || picture.width > max_light_side || picture.height < 1 || picture.height > max_light_side) {
        return error(errc::invalid_size, "a light picture's sides are 1 to 16384 texels");
    }
    if (picture.texels.size() != static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
        return error(errc::invalid_size, "a light picture has another number of texels than width times height");
    }
    for (const glm::vec3& texel : picture.texels) {
        for (int channel = 0; channel < 3; ++channel) {
            if (!(texel[channel] >= 0.0F && texel[channel] <= 1e30F)) {
                return error(errc::invalid_scene, "light that is negative or not finite");
            }
        }
    }
    return success{};
}

} // namespace ao

#include "ao/detail/shared_begin.inc"

namespace ao {

// Resources: vec3 surroundings(uint index) of the picture's texels, vec4 lobe(int k) of a design (ao/lobe_light.hpp).
template <class Real, class Resources>
struct surroundings_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"
#include "ao/shared/half_turn.h"
#include "ao/shared/texel.h"

    Resources resources;

    constexpr vec3 ao_load_surroundings(uint index)
    {
        return resources.surroundings(index);
    }
    constexpr vec4 ao_load_lobe(int k)
    {
        return resources.lobe(k);
    }

#include "ao/shared/surroundings.h"

#include "ao/shared/lobe_light.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"

namespace ao {

namespace detail {

// Over one Real that is not lanes.
template <class Real>
struct picture_resources {
    const light_picture* picture;
    std::span<const glm::vec4> lobes;

    glm::vec<3, Real> surroundings(std::uint32_t index) const
    {
        const glm::vec3& texel = picture->texels[index];
        return { Real(texel.x), Real(texel.y), Real(texel.z) };
    }
    glm::vec<4, Real> lobe(int k) const
    {
        const glm::vec4& x = lobes[static_cast<std::size_t>(k)];
        return { Real(x.x), Real(x.y), Real(x.z), Real(x.w) };
    }
};

template <class Real>
using picture_pass = surroundings_pass<Real, picture_resources<Real>>;

} // namespace detail

// Bilinear, towards d. Preconditions: a valid picture; d is of unit length.
template <class Real>
glm::vec<3, Real> light_towards(const light_picture& picture, const glm::vec<3, Real>& d)
{
    detail::picture_pass<Real> pass{ { &picture, {} } };
    return pass.ao_surroundings(Real(picture.width), Real(picture.height), d);
}

// Coefficients of the picture's light by a rule over the sphere. Detail finer than the rule's directions are apart is sampled,
// not averaged. Preconditions: as light_towards and project.
inline harmonic_series<glm::dvec3> harmonics_of(const light_picture& picture, const sphere_rule& rule, int order)
{
    return project<glm::dvec3>(rule, order,
                               [&](const direction3& d) { return light_towards(picture, glm::dvec3(d[0], d[1], d[2])); });
}

} // namespace ao
