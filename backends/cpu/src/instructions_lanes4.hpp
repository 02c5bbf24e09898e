// Four lanes: SSE2 on x86-64, where every machine has it; elsewhere (NEON) what vector extensions become.
// Each unit that includes this has a Tag of its own.
#pragma once

#include "memory.hpp"

#include "ao/lanes.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace {

struct sse2;

} // namespace

#if defined(__SSE2__)

template <>
struct ao::lane_instructions<4, sse2> {
    using floats = ao::detail::native_vector<float, 4>::type;
    using words = ao::detail::native_vector<std::int32_t, 4>::type;
    using mask_bits = words;

    static mask_bits all(bool b) { return mask_bits{} - (b ? 1 : 0); }
    static bool test(mask_bits m, int i) { return m[i] != 0; }
    static floats least(floats a, floats b) { return _mm_min_ps(a, b); }
    static floats greatest(floats a, floats b) { return _mm_max_ps(a, b); }
    static unsigned packed(mask_bits m) { return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<floats>(m))); }
    static mask_bits both(mask_bits a, mask_bits b) { return a & b; }
    static mask_bits either(mask_bits a, mask_bits b) { return a | b; }
    static mask_bits inverse(mask_bits a) { return ~a; }
    template <class Vector>
    static mask_bits less(Vector a, Vector b)
    {
        return a < b;
    }
    template <class Vector>
    static mask_bits less_equal(Vector a, Vector b)
    {
        return a <= b;
    }
    template <class Vector>
    static mask_bits equal(Vector a, Vector b)
    {
        return a == b;
    }
    template <class Vector>
    static Vector select(Vector a, Vector b, mask_bits m)
    {
        const words chosen = (reinterpret_cast<words>(b) & m) | (reinterpret_cast<words>(a) & ~m);
        return reinterpret_cast<Vector>(chosen);
    }
    static floats sqrt(floats x) { return _mm_sqrt_ps(x); }
};

#endif
