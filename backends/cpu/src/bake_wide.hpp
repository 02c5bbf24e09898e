// Loads, stores and verdicts of N values side by side, for the kernels of ambient occlusion per vertex.
#pragma once

#include "memory.hpp"

#include "ao/bake_passes.hpp"
#include "ao/lanes.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ao::cpu::detail {

template <class Real>
struct wide;

template <>
struct wide<float> {
    static constexpr int width = 1;
    using real = float;
    using integer = std::int32_t;
    using mask = bool;

    static float load(const float* from) { return *from; }
    static integer load(const std::int32_t* from) { return *from; }
    static void store(float* to, float x) { *to = x; }
    static void store(std::int32_t* to, integer x) { *to = x; }
    static float gather(const float* from, integer i) { return from[i]; }
    static integer gather(const std::int32_t* from, integer i) { return from[i]; }
    static unsigned packed(bool m) { return m ? 1U : 0U; }
    static float min(float a, float b) { return b < a ? b : a; }
    static float max(float a, float b) { return a < b ? b : a; }
    static float fused(float a, float b, float c) { return a * b + c; }
    static integer whole(float x) { return static_cast<integer>(x); }
    static float least(float x) { return x; }
    static float greatest(float x) { return x; }
};

template <int N, class Tag>
struct wide<lanes<float, N, Tag>> {
    static constexpr int width = N;
    using real = lanes<float, N, Tag>;
    using integer = lanes<std::int32_t, N, Tag>;
    using mask = lane_mask<N, Tag>;
    using instructions = lane_instructions<N, Tag>;

    static real load(const float* from)
    {
        real x;
        std::memcpy(&x.v, from, sizeof(x.v));
        return x;
    }
    static integer load(const std::int32_t* from)
    {
        integer x;
        std::memcpy(&x.v, from, sizeof(x.v));
        return x;
    }
    static void store(float* to, real x) { std::memcpy(to, &x.v, sizeof(x.v)); }
    static void store(std::int32_t* to, integer x) { std::memcpy(to, &x.v, sizeof(x.v)); }
    static real gather(const float* from, integer i)
    {
        const auto words = memory_instructions<N, Tag>::gather(reinterpret_cast<const std::byte*>(from), i.v);
        real x;
        std::memcpy(&x.v, &words, sizeof(x.v));
        return x;
    }
    static integer gather(const std::int32_t* from, integer i)
    {
        return integer(memory_instructions<N, Tag>::gather(reinterpret_cast<const std::byte*>(from), i.v));
    }
    static unsigned packed(mask m)
    {
        if constexpr (requires { instructions::packed(m.bits); }) {
            return instructions::packed(m.bits);
        }
        else {
            unsigned bits = 0;
            for (int i = 0; i < N; ++i) {
                bits |= m[i] ? 1U << i : 0U;
            }
            return bits;
        }
    }
    // Of numbers; of zeros either, in one instruction where there is one.
    static real min(real a, real b)
    {
        if constexpr (requires { instructions::least(a.v, b.v); }) {
            return real(instructions::least(a.v, b.v));
        }
        else {
            return real_traits<real>::min(a, b);
        }
    }
    static real max(real a, real b)
    {
        if constexpr (requires { instructions::greatest(a.v, b.v); }) {
            return real(instructions::greatest(a.v, b.v));
        }
        else {
            return real_traits<real>::max(a, b);
        }
    }
    // a b + c, rounded once or twice: only for what an exact test follows.
    static real fused(real a, real b, real c)
    {
        if constexpr (requires { instructions::fused(a.v, b.v, c.v); }) {
            return real(instructions::fused(a.v, b.v, c.v));
        }
        else {
            return a * b + c;
        }
    }
    static integer whole(real x) { return integer(x); }
    static float least(real x)
    {
        float least = x[0];
        for (int i = 1; i < N; ++i) {
            least = x[i] < least ? x[i] : least;
        }
        return least;
    }
    static float greatest(real x)
    {
        float greatest = x[0];
        for (int i = 1; i < N; ++i) {
            greatest = x[i] > greatest ? x[i] : greatest;
        }
        return greatest;
    }
};

// A line for N lanes.
template <class Real>
typename bake_pass<Real>::ao_bake_line wide_line(const bake_pass<float>::ao_bake_line& l)
{
    return { Real(l.ux), Real(l.uy), Real(l.uz), Real(l.wx),     Real(l.wy),       Real(l.wz),
             Real(l.dx), Real(l.dy), Real(l.dz), Real(l.weight), Real(l.opposite), Real(l.reserved) };
}

} // namespace ao::cpu::detail
