// The table of shared functions: for each a name, its exactness class and the inputs it is tried with.
#pragma once

#include "ao/kernel.hpp"
#include "ao/math.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "ao/detail/shared_begin.inc"

namespace ao::conformance {

// The shared functions behind one entry, for one Real type: evaluator<Real>::ao_evaluate(function, a, b).
template <class Real>
struct evaluator {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

#include "ao/shared/evaluate.h"
};

} // namespace ao::conformance

#include "ao/detail/shared_end.inc"

namespace ao::conformance {

inline constexpr int function_count = evaluator<float>::ao_function_count;

// Which numbers a function is defined for.
enum class domain {
    any,         // finite, of every magnitude
    moderate,    // finite, products of three stay finite and normal
    nonzero,     // moderate, and b not 0
    nonnegative, // a >= 0
    integral,    // a and b convert to integers: a in +-2^24, b in 0 ... 2^16
    vectors,     // any vectors: zero, denormal, huge, infinite, NaN
    frames,      // a a unit vector; b any helper, parallel ones among them
    indices,     // 16-bit halves of an index
    unorms,      // a in [0, 1] at codes and between; b the top code
    codes,       // a whole numbers up to the top code b
    squares,     // a in [-1, 1]
    rays,        // a projection's four constants; b a pixel and a depth, or a point in front of the eye
    depths,      // a depth decode; b a stored depth, 0, 1, NaN and infinity among them
};

struct function_info {
    int function;
    std::string_view name;
    domain inputs;
    bool exact; // class E: one answer on every conforming implementation; else class Q
};

namespace detail {

using ids = evaluator<float>;

} // namespace detail

inline constexpr std::array<function_info, function_count> functions{ {
    { detail::ids::ao_of_sum, "sum", domain::any, true },
    { detail::ids::ao_of_product, "product", domain::moderate, true },
    { detail::ids::ao_of_quotient, "quotient", domain::nonzero, false },
    { detail::ids::ao_of_sqrt, "sqrt", domain::nonnegative, false },
    { detail::ids::ao_of_floor, "floor", domain::any, true },
    { detail::ids::ao_of_bounds, "min, max, abs, clamp", domain::any, true },
    { detail::ids::ao_of_conversion, "conversions", domain::integral, true },
    { detail::ids::ao_of_select, "select", domain::any, true },
    { detail::ids::ao_of_dot, "dot", domain::moderate, true },
    { detail::ids::ao_of_cross, "cross", domain::moderate, true },
    { detail::ids::ao_of_normalize_or, "normalize_or", domain::vectors, false },
    { detail::ids::ao_of_rotate, "rotate", domain::moderate, true },
    { detail::ids::ao_of_any_tangent, "any_tangent", domain::frames, false },
    { detail::ids::ao_of_tangent, "gram_schmidt.tangent", domain::frames, false },
    { detail::ids::ao_of_bitangent, "gram_schmidt.bitangent", domain::frames, false },
    { detail::ids::ao_of_radical_inverse_2, "radical_inverse(2)", domain::indices, true },
    { detail::ids::ao_of_radical_inverse_3, "radical_inverse(3)", domain::indices, true },
    { detail::ids::ao_of_radical_inverse_5, "radical_inverse(5)", domain::indices, true },
    { detail::ids::ao_of_radical_inverse_7, "radical_inverse(7)", domain::indices, true },
    { detail::ids::ao_of_radical_inverse_11, "radical_inverse(11)", domain::indices, true },
    { detail::ids::ao_of_radical_inverse_13, "radical_inverse(13)", domain::indices, true },
    { detail::ids::ao_of_unorm_code, "unorm_code", domain::unorms, true },
    { detail::ids::ao_of_signed_from_code, "signed_from_code", domain::codes, false },
    { detail::ids::ao_of_octahedral_direction, "octahedral_direction", domain::squares, true },
    { detail::ids::ao_of_view_point, "view_point", domain::rays, true },
    { detail::ids::ao_of_view_point_parallel, "view_point, parallel", domain::rays, true },
    { detail::ids::ao_of_to_pixel, "to_pixel", domain::rays, false },
    { detail::ids::ao_of_to_pixel_parallel, "to_pixel, parallel", domain::rays, true },
    { detail::ids::ao_of_eye_depth, "eye_depth", domain::depths, false },
    { detail::ids::ao_of_eye_depth_affine, "eye_depth, affine", domain::depths, true },
    { detail::ids::ao_of_tile_texel, "tile_texel", domain::integral, true },
    { detail::ids::ao_of_log2, "log2", domain::nonnegative, true },
    { detail::ids::ao_of_exp2, "exp2", domain::moderate, true },
    { detail::ids::ao_of_power, "power", domain::squares, true },
    { detail::ids::ao_of_srgb, "srgb_of_linear", domain::squares, true },
    { detail::ids::ao_of_turns, "turns", domain::moderate, false },
    { detail::ids::ao_of_mapped_normal, "mapped_normal", domain::frames, false },
    { detail::ids::ao_of_packed_frame, "packed_frame", domain::frames, false },
    { detail::ids::ao_of_transform_normal, "transform_normal", domain::moderate, true },
    { detail::ids::ao_of_blend, "blend", domain::moderate, true },
    { detail::ids::ao_of_highlight, "highlight", domain::frames, false },
} };

struct function_inputs {
    std::vector<glm::vec4> a;
    std::vector<glm::vec4> b;
};

namespace detail {

// Signed, 2^-range ... 2^range in magnitude.
inline float scattered(random_stream& random, int range)
{
    const int exponent = static_cast<int>(random.next() % static_cast<std::uint32_t>(2 * range)) - range;
    const float size = std::ldexp(1.0F + random.uniform(), exponent);
    return (random.next() & 1U) != 0 ? size : -size;
}

inline glm::vec3 unit_vector(random_stream& random)
{
    const float z = 2.0F * random.uniform() - 1.0F;
    const float turn = 6.2831853F * random.uniform();
    const float across = std::sqrt(1.0F - z * z);
    return { across * std::cos(turn), across * std::sin(turn), z };
}

// Awkward numbers of a domain; the grid takes every pair of them.
inline std::vector<float> special_values(domain d)
{
    constexpr float infinite = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    switch (d) {
    case domain::any:
        return { 0.0F,        -0.0F,  1.0F, -1.0F,   0.5F,       -0.5F,       1e-30F,     -1e-30F,
                 1e30F,       -1e30F, 0.1F, 3.0e38F, 8388607.5F, -8388607.5F, 8388608.0F, 16777216.0F,
                 16777217.0F, 1e-37F, 2.5F, -2.5F,   -3.0F,      0.99999994F, 1.0000001F, -0.99999994F };
    case domain::nonnegative:
        return { 0.0F, 1.0F, 2.0F, 0.25F, 1e-30F, 1e30F, 1.1754944e-38F, 3.0e38F, 0.99999994F, 1.0000001F, 16777215.0F };
    case domain::vectors:
        return { 0.0F,  1.0F,   -1.0F, 1e-15F, 1.1e-15F, 1e-16F, -1e-15F,  1e15F,
                 1e16F, -1e30F, 1e30F, 1e-40F, 0.6F,     nan,    infinite, -infinite };
    case domain::depths:
        return { 0.0F, 1.0F, 0.5F, 0.99999994F, 1e-7F, -1.0F, 1e30F, -1e30F, nan, infinite, -infinite };
    default:
        return { 1.0F, -1.0F, 0.5F, 2.0F, 3.0F, 1e-6F, -1e6F, 0.99999994F, 1.0000001F, 1024.5F };
    }
}

inline void push_special(function_inputs& in, domain d)
{
    const std::vector<float> values = special_values(d);
    const auto at = [&](std::size_t i) { return values[i % values.size()]; };
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t j = 0; j < values.size(); ++j) {
            if (d == domain::depths) {
                in.a.emplace_back(0.1F, j % 2 == 0 ? -1.0F : 1.0F, j % 3 == 0 ? 0.0F : 1.0F, 0.0F);
                in.b.emplace_back(at(i), at(j) < 2.0F ? 7.5F : 0.5F, 3.5F, 0.0F);
                continue;
            }
            in.a.emplace_back(at(i), at(j), at(i + j), at(2 * i + j));
            in.b.emplace_back(at(j), at(i), at(i + 2 * j + 1), at(j + 3));
        }
    }
}

inline void push_frames(function_inputs& in)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::array<glm::vec3, 12> normals{ glm::vec3(0, 0, 1),
                                             { 0, 0, -1 },
                                             { 1, 0, 0 },
                                             { -1, 0, 0 },
                                             { 0, 1, 0 },
                                             { 0, -1, 0 },
                                             { 0, 0, 0 },
                                             { 0.6F, 0, -0.8F },
                                             { 0.6F, -0.8F, -0.0F },
                                             { 0.6F, 0.8F, 0.0F },
                                             { 0.6F, 0.8F, -1e-7F },
                                             { 3e-4F, 0, -0.99999994F } };
    for (const glm::vec3& n : normals) {
        for (const glm::vec3& helper : normals) {
            for (const float scale : { 1.0F, -1.0F, 1e-20F, 1e20F, 0.05F }) {
                in.a.emplace_back(n, 0.0F);
                in.b.emplace_back(helper.x * scale, helper.y * scale, helper.z * scale, 0.0F);
            }
        }
        in.a.emplace_back(n, 0.0F);
        in.b.emplace_back(nan, nan, 0.0F, 0.0F);
    }
}

inline void push_random(function_inputs& in, domain d, random_stream& random)
{
    const auto any = [&](int range) { return scattered(random, range); };
    const auto number = [&](std::uint32_t below) { return static_cast<float>(random.next() % below); };
    const auto uniform = [&](float low, float high) { return low + (high - low) * random.uniform(); };
    switch (d) {
    case domain::any:
        in.a.emplace_back(any(100), any(8), any(30), any(3));
        in.b.emplace_back(any(100), any(8), any(30), any(3));
        break;
    case domain::nonnegative:
        in.a.emplace_back(std::abs(any(120)), std::abs(any(60)), std::abs(any(8)), uniform(0, 4));
        in.b.emplace_back(0.0F);
        break;
    case domain::integral:
        in.a.emplace_back(any(20), any(22), any(10), any(2));
        in.b.emplace_back(number(65536), number(65536), number(65536), number(65536));
        break;
    case domain::frames: {
        const glm::vec3 n = unit_vector(random);
        const bool close = random.next() % 4 == 0;
        const float spread = close ? 0.1F : 1.0F;
        in.a.emplace_back(n, 0.0F);
        in.b.emplace_back(close ? n.x + uniform(-spread, spread) : uniform(-1, 1),
                          close ? n.y + uniform(-spread, spread) : uniform(-1, 1), close ? n.z : 0.0F, 0.0F);
        break;
    }
    case domain::indices: {
        const std::uint32_t index = random.next() >> random.next() % 32;
        in.a.emplace_back(static_cast<float>(index >> 16U), static_cast<float>(index & 65535U), 0.0F, 0.0F);
        in.b.emplace_back(0.0F);
        break;
    }
    case domain::unorms:
    case domain::codes: {
        const std::uint32_t top = random.next() % 2 != 0 ? 1023 : 65535;
        const auto high = static_cast<float>(top);
        const float scale = d == domain::unorms ? high : 1.0F;
        in.a.emplace_back(number(top + 1) / scale, number(top + 1) / scale, d == domain::unorms ? random.uniform() : high, 0.0F);
        in.b.emplace_back(high, 0.0F, 0.0F, 0.0F);
        break;
    }
    case domain::squares:
        in.a.emplace_back(uniform(-1, 1), uniform(-1, 1), 0.0F, 0.0F);
        in.b.emplace_back(0.0F);
        break;
    case domain::rays:
        in.a.emplace_back(any(10), any(10), any(10), any(10));
        in.b.emplace_back(number(4096) + 0.5F, number(4096) + 0.5F, -std::abs(any(12)), 0.0F);
        break;
    case domain::depths: {
        const float near = std::abs(any(4));
        in.a.emplace_back(near, random.next() % 2 != 0 ? -1.0F : 1.0F, random.next() % 2 != 0 ? 0.0F : 1.0F, any(20) * 1e-7F);
        in.b.emplace_back(random.uniform(), number(4096) + 0.5F, number(4096) + 0.5F, any(20) * 1e-7F);
        break;
    }
    default:
        in.a.emplace_back(any(20), any(20), any(20), any(20));
        in.b.emplace_back(any(20), any(20), any(20), any(20));
        break;
    }
}

} // namespace detail

// Awkward values first, then random ones; the same for every call.
inline function_inputs make_inputs(const function_info& f, std::size_t random_count)
{
    function_inputs in;
    switch (f.inputs) {
    case domain::any:
    case domain::moderate:
    case domain::nonzero:
    case domain::nonnegative:
    case domain::vectors:
    case domain::depths:
        detail::push_special(in, f.inputs);
        break;
    case domain::frames:
        detail::push_frames(in);
        break;
    case domain::indices:
        // Every digit at its greatest, and its neighbours.
        for (std::uint32_t base = 2; base <= 13; ++base) {
            for (std::uint64_t power = base; power < 0x100000000ULL; power *= base) {
                for (const std::uint64_t index : { power - 1, power, power + 1 }) {
                    in.a.emplace_back(static_cast<float>(index >> 16U & 65535U), static_cast<float>(index & 65535U), 0.0F, 0.0F);
                    in.b.emplace_back(0.0F);
                }
            }
        }
        in.a.emplace_back(65535.0F, 65535.0F, 0.0F, 0.0F);
        in.b.emplace_back(0.0F);
        break;
    case domain::unorms:
        // About the middle between codes, where rounding changes its mind.
        for (const float top : { 1023.0F, 65535.0F }) {
            for (const float code : { 0.0F, 1.0F, 2.0F, 5.0F, 31.0F, 511.0F, 1022.0F }) {
                const float middle = (code + 0.5F) / top;
                float below = middle;
                float above = middle;
                for (int i = 0; i < 8; ++i) {
                    below = std::nextafter(below, 0.0F);
                    above = std::nextafter(above, 1.0F);
                    in.a.emplace_back(below, middle, above, 0.0F);
                    in.b.emplace_back(top, 0.0F, 0.0F, 0.0F);
                }
            }
        }
        break;
    default:
        for (const float x : { 0.0F, 1.0F, 0.5F }) {
            in.a.emplace_back(f.inputs == domain::codes ? 2 * std::floor(511.5F * x) : x, f.inputs == domain::squares ? -1.0F : x,
                              -0.0F, 0.0F);
            in.b.emplace_back(1023.0F, 1023.0F, f.inputs == domain::rays ? -1.0F : 1.0F, 0.0F);
        }
        break;
    }
    random_stream random(static_cast<std::uint32_t>(f.function) + 1U);
    for (std::size_t i = 0; i < random_count; ++i) {
        detail::push_random(in, f.inputs, random);
    }
    return in;
}

} // namespace ao::conformance
