// Eight lanes: AVX2 and F16C, for units that alone are compiled for it.
// Not to be included by others: each such unit has a Tag of its own.
#pragma once

#include "memory.hpp"

#include "ao/lanes.hpp"

#include <immintrin.h>

namespace {

struct avx2;

} // namespace

template <>
struct ao::lane_instructions<8, avx2> {
    using floats = ao::detail::native_vector<float, 8>::type;
    using words = ao::detail::native_vector<std::int32_t, 8>::type;
    using mask_bits = words;

    static mask_bits all(bool b) { return mask_bits{} - (b ? 1 : 0); }
    static bool test(mask_bits m, int i) { return m[i] != 0; }
    static floats least(floats a, floats b) { return _mm256_min_ps(a, b); }
    static floats greatest(floats a, floats b) { return _mm256_max_ps(a, b); }
    static unsigned packed(mask_bits m) { return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<floats>(m))); }
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
        return reinterpret_cast<Vector>(
            _mm256_blendv_ps(reinterpret_cast<floats>(a), reinterpret_cast<floats>(b), reinterpret_cast<floats>(m)));
    }
    static floats sqrt(floats x) { return _mm256_sqrt_ps(x); }
};

template <>
struct ao::cpu::detail::memory_instructions<8, avx2> {
    using floats = ao::detail::native_vector<float, 8>::type;
    using words = ao::detail::native_vector<std::int32_t, 8>::type;

    static words gather(const std::byte* data, words index)
    {
        return reinterpret_cast<words>(
            _mm256_i32gather_epi32(reinterpret_cast<const int*>(data), reinterpret_cast<__m256i>(index), 4));
    }
    static bool equal(words a, words b)
    {
        const words differing = a ^ b;
        return _mm256_testz_si256(reinterpret_cast<__m256i>(differing), reinterpret_cast<__m256i>(differing)) != 0;
    }
    static floats half(words codes)
    {
        const __m256i low = reinterpret_cast<__m256i>(codes & 0xffff);
        return _mm256_cvtph_ps(_mm_packus_epi32(_mm256_castsi256_si128(low), _mm256_extracti128_si256(low, 1)));
    }
};
