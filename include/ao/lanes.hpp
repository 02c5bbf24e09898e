// N values side by side as one Real type, on the vector extensions of g++ and clang: math<lanes<float, 8>> computes eight
// pixels with the same operations, in the same order, as math<float> computes one, and so the same bits.
// Tag separates instantiations that are compiled for different instruction sets in one program: with the same name the linker
// would keep any one of them.
#pragma once

#include "ao/real.hpp"

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace ao {

template <class T, int N, class Tag = void>
struct lanes;

namespace detail {

template <class T, int N>
struct native_vector {
    typedef T type __attribute__((vector_size(N * sizeof(T))));
};

} // namespace detail

// What N lanes of a Tag are made of. This default needs nothing but the compiler's vector extensions; a backend specialises it
// for a Tag of its own to name the instructions of one instruction set. Every specialisation must give the same bits.
template <int N, class Tag>
struct lane_instructions {
    using floats = typename detail::native_vector<float, N>::type;
    using mask_bits = typename detail::native_vector<std::int32_t, N>::type; // a lane holds 0 or all bits set

    static constexpr mask_bits all(bool b) { return mask_bits{} - (b ? 1 : 0); }
    static constexpr bool test(mask_bits m, int i) { return m[i] != 0; }
    static constexpr mask_bits both(mask_bits a, mask_bits b) { return a & b; }
    static constexpr mask_bits either(mask_bits a, mask_bits b) { return a | b; }
    static constexpr mask_bits inverse(mask_bits a) { return ~a; }
    template <class Vector>
    static constexpr mask_bits less(Vector a, Vector b)
    {
        return a < b;
    }
    template <class Vector>
    static constexpr mask_bits less_equal(Vector a, Vector b)
    {
        return a <= b;
    }
    template <class Vector>
    static constexpr mask_bits equal(Vector a, Vector b)
    {
        return a == b;
    }
    // b where m holds, a elsewhere.
    template <class Vector>
    static constexpr Vector select(Vector a, Vector b, mask_bits m)
    {
        return m ? b : a;
    }
    static floats sqrt(floats x)
    {
        floats root = x;
        for (int i = 0; i < N; ++i) {
            root[i] = __builtin_sqrtf(x[i]);
        }
        return root;
    }
};

// N verdicts.
template <int N, class Tag = void>
struct lane_mask {
    static constexpr int width = N;
    using instructions = lane_instructions<N, Tag>;
    using native = typename instructions::mask_bits;
    native bits;

    lane_mask() = default;
    constexpr explicit lane_mask(native b) : bits(b) {}
    template <std::same_as<bool> Bool>
    constexpr lane_mask(Bool b) : bits(instructions::all(b))
    {
    }
    constexpr bool operator[](int i) const { return instructions::test(bits, i); }

    friend constexpr lane_mask operator&&(lane_mask a, lane_mask b) { return lane_mask(instructions::both(a.bits, b.bits)); }
    friend constexpr lane_mask operator||(lane_mask a, lane_mask b) { return lane_mask(instructions::either(a.bits, b.bits)); }
    friend constexpr lane_mask operator!(lane_mask a) { return lane_mask(instructions::inverse(a.bits)); }
};

// N values of a 4-byte T: float, std::int32_t or std::uint32_t.
template <class T, int N, class Tag>
struct lanes {
    static_assert(sizeof(T) == 4);
    using instructions = lane_instructions<N, Tag>;
    static constexpr int width = N;
    using native = typename detail::native_vector<T, N>::type;
    using mask = lane_mask<N, Tag>;
    native v;

    lanes() = default;
    constexpr explicit lanes(native x) : v(x) {}
    // Every lane the same. Implicit, as real(0.5) and mixed products in shared code expect.
    template <class S>
        requires std::is_arithmetic_v<S>
    constexpr lanes(S x) : v(static_cast<T>(x) - native{}) // less +0, which keeps the sign of -0
    {
    }
    // Lane-wise conversion; float to integer truncates.
    template <class U>
    constexpr explicit lanes(lanes<U, N, Tag> x) : v(__builtin_convertvector(x.v, native))
    {
    }
    constexpr T operator[](int i) const { return v[i]; }

    friend constexpr lanes operator+(lanes a, lanes b) { return lanes(a.v + b.v); }
    friend constexpr lanes operator-(lanes a, lanes b) { return lanes(a.v - b.v); }
    friend constexpr lanes operator*(lanes a, lanes b) { return lanes(a.v * b.v); }
    friend constexpr lanes operator/(lanes a, lanes b) { return lanes(a.v / b.v); }
    friend constexpr lanes operator&(lanes a, lanes b) requires std::is_integral_v<T> { return lanes(a.v & b.v); }
    friend constexpr lanes operator|(lanes a, lanes b) requires std::is_integral_v<T> { return lanes(a.v | b.v); }
    friend constexpr lanes operator~(lanes a) requires std::is_integral_v<T> { return lanes(~a.v); }
    // Precondition of both: by 0 to 31 bits.
    friend constexpr lanes operator<<(lanes a, lanes b) requires std::is_unsigned_v<T> { return lanes(a.v << b.v); }
    friend constexpr lanes operator>>(lanes a, int b) requires std::is_unsigned_v<T> { return lanes(a.v >> b); }
    friend constexpr lanes operator-(lanes a) { return lanes(-a.v); }
    constexpr lanes& operator+=(lanes b) { return *this = *this + b; }
    constexpr lanes& operator-=(lanes b) { return *this = *this - b; }
    constexpr lanes& operator*=(lanes b) { return *this = *this * b; }
    constexpr lanes& operator/=(lanes b) { return *this = *this / b; }
    friend constexpr mask operator<(lanes a, lanes b) { return mask(instructions::less(a.v, b.v)); }
    friend constexpr mask operator<=(lanes a, lanes b) { return mask(instructions::less_equal(a.v, b.v)); }
    friend constexpr mask operator>(lanes a, lanes b) { return mask(instructions::less(b.v, a.v)); }
    friend constexpr mask operator>=(lanes a, lanes b) { return mask(instructions::less_equal(b.v, a.v)); }
    friend constexpr mask operator==(lanes a, lanes b) { return mask(instructions::equal(a.v, b.v)); }
    friend constexpr mask operator!=(lanes a, lanes b) { return !(a == b); }
};

template <class T, int N, class Tag>
constexpr lanes<T, N, Tag> select(lanes<T, N, Tag> a, lanes<T, N, Tag> b, lane_mask<N, Tag> m)
{
    return lanes<T, N, Tag>(lane_instructions<N, Tag>::select(a.v, b.v, m.bits));
}

template <int N, class Tag>
struct real_traits<lanes<float, N, Tag>> {
    using real = lanes<float, N, Tag>;
    using uint = lanes<std::uint32_t, N, Tag>;
    using integer = lanes<std::int32_t, N, Tag>;
    using mask = lane_mask<N, Tag>;

    template <class T>
    static constexpr lanes<T, N, Tag> select(lanes<T, N, Tag> a, lanes<T, N, Tag> b, mask m)
    {
        return ::ao::select(a, b, m);
    }
    static real sqrt(real x) { return real(lane_instructions<N, Tag>::sqrt(x.v)); }
    static real floor(real x)
    {
        // Whole numbers from 2^23 on are left as they are; below, truncation and one step down for negative fractions.
        const real whole = real(integer(::ao::select(real(0), x, small(x))));
        const real lower = ::ao::select(whole, whole - real(1), whole > x);
        return ::ao::select(x, lower, small(x) && whole != x); // -0 stays -0
    }
    static constexpr real abs(real x) { return ::ao::select(x + real(0), -x, x < real(0)); }
    static constexpr real min(real a, real b) { return ::ao::select(a, b, b < a); }
    static constexpr real max(real a, real b) { return ::ao::select(a, b, a < b); }

private:
    static constexpr mask small(real x) { return x > real(-8388608) && x < real(8388608); }
};

} // namespace ao
