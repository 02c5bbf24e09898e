// Diffuse and glossy light from spherical harmonics for every Real type and as what shaders read (ao/shared/harmonic_light.h).
#pragma once

#include "ao/harmonic_series.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>

#include "ao/detail/shared_begin.inc"

namespace ao {

// Resources: vec4 harmonic(int index).
template <class Real, class Resources>
struct harmonic_light_pass {
#include "ao/detail/scope.inc"
#include "ao/shared/harmonics.h"

    Resources resources;

    constexpr vec4 ao_load_harmonic(int index)
    {
        return resources.harmonic(index);
    }

#include "ao/shared/harmonic_light.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"

namespace ao {

// What ao_harmonic_light reads, the same words on every backend.
struct packed_harmonics {
    int order = 0;
    std::array<glm::vec4, max_harmonics> coefficients{};
};

// Of linear RGB light by direction, e.g. averaged(light, 1) for diffuse light.
constexpr packed_harmonics pack_harmonics(const harmonic_series<glm::dvec3>& light)
{
    packed_harmonics packed{ .order = light.order, .coefficients = {} };
    for (std::size_t i = 0; i < harmonic_count(light.order); ++i) {
        const glm::dvec3& c = light.coefficients[i];
        const double norm = harmonic_table.norm[i];
        packed.coefficients[i] = { static_cast<float>(c.x * norm), static_cast<float>(c.y * norm), static_cast<float>(c.z * norm),
                                   static_cast<float>(harmonic_table.step[i]) };
    }
    return packed;
}

namespace detail {

template <class Real>
struct harmonic_reader {
    const packed_harmonics* light;

    constexpr glm::vec<4, Real> harmonic(int index) const
    {
        const glm::vec4& c = light->coefficients[static_cast<std::size_t>(index)];
        return { Real(c.x), Real(c.y), Real(c.z), Real(c.w) };
    }
};

} // namespace detail

// Linear RGB for a direction n, one or lanes of them. Real: float, double or lanes.
template <class Real>
constexpr glm::vec<3, Real> light_of_harmonics(const packed_harmonics& light, const glm::vec<3, Real>& n)
{
    harmonic_light_pass<Real, detail::harmonic_reader<Real>> pass{ { &light } };
    return pass.ao_harmonic_light(light.order, n);
}

// The same under ambient occlusion: `bent` is the mean unoccluded direction, in the light's space.
template <class Real>
constexpr glm::vec<3, Real> light_of_harmonics(const packed_harmonics& light, const glm::vec<3, Real>& bent, Real visibility)
{
    harmonic_light_pass<Real, detail::harmonic_reader<Real>> pass{ { &light } };
    return pass.ao_harmonic_light_through(light.order, bent, visibility);
}

} // namespace ao
