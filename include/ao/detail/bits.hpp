// Exponents and bits of reals: what ao/shared/elementary.h and ao/shared/texture.h need beyond arithmetic.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace ao::detail {

// Real is float, double or lanes of floats.
template <class Real, class Integer, class Uint>
struct bits_of {
    static Integer exponent(Real x)
    {
        const auto bits = copy<typename Integer::native>(x.v);
        return Integer(typename Integer::native((bits >> 23 & 255) - 127));
    }
    static Real power_of_two(Integer n) { return Real(copy<typename Real::native>(typename Integer::native((n.v + 127) << 23))); }
    static Real real(Uint bits) { return Real(copy<typename Real::native>(bits.v)); }
    static Uint word(Real x) { return Uint(copy<typename Uint::native>(x.v)); }
    static Real inverse_root_guess(Real x)
    {
        const auto bits = copy<typename Uint::native>(x.v);
        return Real(copy<typename Real::native>(typename Uint::native(0x5f1ffff9U - (bits >> 1))));
    }

private:
    template <class To, class From>
    static To copy(const From& from)
    {
        static_assert(sizeof(To) == sizeof(From));
        To to;
        std::memcpy(&to, &from, sizeof(to));
        return to;
    }
};

template <>
struct bits_of<float, std::int32_t, std::uint32_t> {
    static constexpr std::int32_t exponent(float x)
    {
        return static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(x) >> 23U & 255U) - 127;
    }
    static constexpr float power_of_two(std::int32_t n)
    {
        return std::bit_cast<float>(static_cast<std::uint32_t>(n + 127) << 23U);
    }
    static constexpr float real(std::uint32_t bits) { return std::bit_cast<float>(bits); }
    static constexpr std::uint32_t word(float x) { return std::bit_cast<std::uint32_t>(x); }
    static constexpr float inverse_root_guess(float x) { return real(0x5f1ffff9U - (word(x) >> 1U)); }
};

template <>
struct bits_of<double, std::int32_t, std::uint32_t> {
    static constexpr std::int32_t exponent(double x)
    {
        return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(x) >> 52U & 2047U) - 1023;
    }
    static constexpr double power_of_two(std::int32_t n)
    {
        return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U);
    }
    static constexpr double real(std::uint32_t bits) { return static_cast<double>(std::bit_cast<float>(bits)); }
    static constexpr std::uint32_t word(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }
    static constexpr double inverse_root_guess(double x) { return real(0x5f1ffff9U - (word(x) >> 1U)); }
};

// Whether a verdict holds anywhere.
constexpr bool any(bool m)
{
    return m;
}
template <class Mask>
    requires requires(Mask m)
    {
        m.bits;
    }
constexpr bool any(const Mask& m)
{
    if constexpr (requires { Mask::instructions::packed(m.bits); }) {
        return Mask::instructions::packed(m.bits) != 0;
    }
    for (int i = 0; i < Mask::width; ++i) {
        if (m[i]) {
            return true;
        }
    }
    return false;
}
template <class Mask>
    requires requires(Mask m)
    {
        m.may_hold;
    }
constexpr bool any(const Mask& m)
{
    return m.may_hold;
}

} // namespace ao::detail
