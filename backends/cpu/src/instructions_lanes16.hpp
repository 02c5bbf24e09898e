// Sixteen lanes: AVX-512 F, DQ, BW and VL, for units that alone are compiled for it. Verdicts live in mask registers.
// Not to be included by others: each such unit has a Tag of its own.
#pragma once

#include "memory.hpp"

#include "ao/lanes.hpp"

#include <immintrin.h>

#include <array>

namespace {

struct avx512;

} // namespace

template <>
struct ao::lane_instructions<16, avx512> {
    using floats = ao::detail::native_vector<float, 16>::type;
    using words = ao::detail::native_vector<std::int32_t, 16>::type;
    using unsigned_words = ao::detail::native_vector<std::uint32_t, 16>::type;
    using mask_bits = __mmask16;

    static mask_bits all(bool b) { return b ? 0xffff : 0; }
    static bool test(mask_bits m, int i) { return (m >> i & 1) != 0; }
    static floats least(floats a, floats b) { return _mm512_maskz_min_ps(0xffff, a, b); }
    static floats greatest(floats a, floats b) { return _mm512_maskz_max_ps(0xffff, a, b); }
    static floats fused(floats a, floats b, floats c) { return _mm512_fmadd_ps(a, b, c); }
    static unsigned packed(mask_bits m) { return m; }
    static mask_bits both(mask_bits a, mask_bits b) { return _kand_mask16(a, b); }
    static mask_bits either(mask_bits a, mask_bits b) { return _kor_mask16(a, b); }
    static mask_bits inverse(mask_bits a) { return _knot_mask16(a); }
    static mask_bits less(floats a, floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
    static mask_bits less_equal(floats a, floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
    static mask_bits equal(floats a, floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
    static mask_bits less(words a, words b) { return _mm512_cmplt_epi32_mask(bits(a), bits(b)); }
    static mask_bits less_equal(words a, words b) { return _mm512_cmple_epi32_mask(bits(a), bits(b)); }
    static mask_bits equal(words a, words b) { return _mm512_cmpeq_epi32_mask(bits(a), bits(b)); }
    static mask_bits less(unsigned_words a, unsigned_words b) { return _mm512_cmplt_epu32_mask(bits(a), bits(b)); }
    static mask_bits less_equal(unsigned_words a, unsigned_words b) { return _mm512_cmple_epu32_mask(bits(a), bits(b)); }
    static mask_bits equal(unsigned_words a, unsigned_words b) { return _mm512_cmpeq_epi32_mask(bits(a), bits(b)); }
    static floats select(floats a, floats b, mask_bits m) { return _mm512_mask_blend_ps(m, a, b); }
    static words select(words a, words b, mask_bits m)
    {
        return reinterpret_cast<words>(_mm512_mask_blend_epi32(m, bits(a), bits(b)));
    }
    static unsigned_words select(unsigned_words a, unsigned_words b, mask_bits m)
    {
        return reinterpret_cast<unsigned_words>(_mm512_mask_blend_epi32(m, bits(a), bits(b)));
    }
    static floats sqrt(floats x) { return _mm512_maskz_sqrt_ps(0xffff, x); }

private:
    template <class Vector>
    static __m512i bits(Vector x)
    {
        return reinterpret_cast<__m512i>(x);
    }
};

template <>
struct ao::cpu::detail::memory_instructions<16, avx512> {
    using floats = ao::detail::native_vector<float, 16>::type;
    using words = ao::detail::native_vector<std::int32_t, 16>::type;

    static words gather(const std::byte* data, words index)
    {
        // The unmasked forms of these intrinsics start from an undefined value, of which g++ 12 warns.
        return reinterpret_cast<words>(
            _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, reinterpret_cast<__m512i>(index), data, 4));
    }
    // Words i, i + 4, i + 8 ... of the 64 from there on.
    static words every_fourth(const std::byte* data, int i)
    {
        const auto load = [&](int part) { return _mm512_loadu_si512(data + 64 * part); };
        const __m512i low = _mm512_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28, 0, 4, 8, 12, 16, 20, 24, 28);
        const __m512i from = _mm512_add_epi32(low, _mm512_set1_epi32(i));
        const __m512i first = _mm512_permutex2var_epi32(load(0), from, load(1));
        const __m512i second = _mm512_permutex2var_epi32(load(2), from, load(3));
        return reinterpret_cast<words>(_mm512_mask_blend_epi64(0xf0, first, second));
    }
    // The words at data + 4 * index and the two behind each: one load of four words a lane, a third of those of three gathers.
    static std::array<words, 3> gather_triples(const std::byte* data, words index)
    {
        alignas(64) std::int32_t at[16];
        std::memcpy(at, &index, sizeof(words));
        const auto lane = [&](int i) {
            return _mm_loadu_si128(reinterpret_cast<const __m128i*>(data + std::size_t{ 4 } * static_cast<std::uint32_t>(at[i])));
        };
        const auto every_fourth_lane = [&](int i) {
            __m512i all = _mm512_castsi128_si512(lane(i));
            all = _mm512_maskz_inserti32x4(0xffff, all, lane(i + 4), 1);
            all = _mm512_maskz_inserti32x4(0xffff, all, lane(i + 8), 2);
            return _mm512_maskz_inserti32x4(0xffff, all, lane(i + 12), 3);
        };
        const __m512i a = every_fourth_lane(0);
        const __m512i b = every_fourth_lane(1);
        const __m512i c = every_fourth_lane(2);
        const __m512i d = every_fourth_lane(3);
        const __m512i low_ab = _mm512_maskz_unpacklo_epi32(0xffff, a, b);
        const __m512i low_cd = _mm512_maskz_unpacklo_epi32(0xffff, c, d);
        const __m512i high_ab = _mm512_maskz_unpackhi_epi32(0xffff, a, b);
        const __m512i high_cd = _mm512_maskz_unpackhi_epi32(0xffff, c, d);
        return { reinterpret_cast<words>(_mm512_maskz_unpacklo_epi64(0xff, low_ab, low_cd)),
                 reinterpret_cast<words>(_mm512_maskz_unpackhi_epi64(0xff, low_ab, low_cd)),
                 reinterpret_cast<words>(_mm512_maskz_unpacklo_epi64(0xff, high_ab, high_cd)) };
    }
    static bool equal(words a, words b)
    {
        return _mm512_cmpneq_epi32_mask(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)) == 0;
    }
    static floats half(words codes)
    {
        return _mm512_maskz_cvtph_ps(0xffff, _mm512_maskz_cvtepi32_epi16(0xffff, reinterpret_cast<__m512i>(codes)));
    }
};
