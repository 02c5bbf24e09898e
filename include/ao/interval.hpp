// Bounds on what any conforming implementation may compute, as a Real type: math<interval> and the passes over it turn the
// shared source into acceptance limits for hardware whose / and sqrt are not correctly rounded (numerics.md 3.1, 3.4).
//
// Assumed of an implementation (Vulkan's precision of SPIR-V instructions; GLSL 4.60 section 4.7.1 says the same):
//   + - * and conversions round to nearest, no contraction; floor, min, max, abs and comparisons are exact
//   a / b            within 2.5 units in the last place where 2^-126 <= |b| <= 2^126, and 0 / b is 0; beyond 2^126 the
//                    quotient may also be 0, as a reciprocal that is flushed makes it
//   sqrt             1 / inversesqrt: 2 units for the root's inverse, 2.5 for the division, composed as they stand (6.5 at most)
//   denormals        may become 0, as operands and as results
//   NaN              comparisons may say anything
// Compile with -ffp-contract=off (ao::strict_fp).
#pragma once

#include "ao/detail/bits.hpp"
#include "ao/real.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace ao {

// No, yes, or either: what a comparison of intervals may say.
struct verdict {
    bool may_hold = false;
    bool may_fail = true;

    constexpr verdict() = default;
    constexpr verdict(bool b) : may_hold(b), may_fail(!b) {}
    constexpr verdict(bool hold, bool fail) : may_hold(hold), may_fail(fail) {}
    static constexpr verdict either() { return { true, true }; }
    constexpr bool certain() const { return may_hold != may_fail; }

    friend constexpr verdict operator&&(verdict a, verdict b) { return { a.may_hold && b.may_hold, a.may_fail || b.may_fail }; }
    friend constexpr verdict operator||(verdict a, verdict b) { return { a.may_hold || b.may_hold, a.may_fail && b.may_fail }; }
    friend constexpr verdict operator!(verdict a) { return { a.may_fail, a.may_hold }; }
};

namespace detail {

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr double largest_float = static_cast<double>(std::numeric_limits<float>::max());

// Distance of the floats about x; 2^-149 from 2^-126 down.
constexpr double float_step(double x)
{
    const double least = 1.40129846432481707e-45;
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(x) >> 52U & 0x7ffU;
    const double step = exponent > 23 ? std::bit_cast<double>((exponent - 23) << 52U) : 0.0;
    return step > least ? step : least;
}

// `units` in the last place of a float near x; none for 0 and infinity.
constexpr double slack(double x, double units)
{
    return x == 0 || x - x != 0 ? 0.0 : units * float_step(x);
}

constexpr float next_float(float x, bool up)
{
    if (x == 0) {
        return up ? std::numeric_limits<float>::denorm_min() : -std::numeric_limits<float>::denorm_min();
    }
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>((x > 0) == up ? bits + 1 : bits - 1);
}

// The least float >= x; for finite x beyond the floats the largest of them, or minus infinity.
constexpr float float_from(double x)
{
    if (x > largest_float) {
        return x > std::numeric_limits<double>::max() ? infinity : std::numeric_limits<float>::max();
    }
    if (x < -largest_float) {
        return -infinity;
    }
    const auto nearest = static_cast<float>(x);
    return static_cast<double>(nearest) < x ? next_float(nearest, true) : nearest;
}

// The greatest float <= x, likewise.
constexpr float float_up_to(double x)
{
    return -float_from(-x);
}

// Four products or quotients of end points.
struct corners {
    double low;
    double high;
    bool defined = true;

    constexpr corners(double a, double b, double c, double d)
        : low(least(least(a, b), least(c, d))),
          high(-least(least(-a, -b), least(-c, -d))),
          defined(a == a && b == b && c == c && d == d)
    {
    }

private:
    static constexpr double least(double a, double b) { return b < a ? b : a; }
};

} // namespace detail

// Every float from lo to hi; the whole line stands for NaN as well. Always holds 0 where it holds a denormal.
struct interval {
    float lo;
    float hi;

    interval() = default;
    template <class S>
        requires std::is_arithmetic_v<S>
    constexpr interval(S x) : interval(static_cast<float>(x), static_cast<float>(x)) {}
    // NaN for an end makes the interval unknown. Precondition: low <= high otherwise.
    constexpr interval(float low, float high) : lo(low), hi(high)
    {
        constexpr float normal = std::numeric_limits<float>::min();
        if (!(low <= high)) {
            lo = -detail::infinity;
            hi = detail::infinity;
        }
        if (lo > 0 && lo < normal) {
            lo = 0;
        }
        if (hi < 0 && hi > -normal) {
            hi = 0;
        }
    }
    // Nothing is known: any value or NaN.
    static constexpr interval unknown() { return { -detail::infinity, detail::infinity }; }

    constexpr bool is_unknown() const { return lo == -detail::infinity && hi == detail::infinity; }
    constexpr bool is_point() const { return lo == hi; }
    // NaN only where nothing is known.
    constexpr bool contains(float x) const { return is_unknown() || (x >= lo && x <= hi); }

    friend constexpr interval hull(interval a, interval b) { return { a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi }; }
    // Rounding is monotone, so the rounded ends bound every rounded sum; inf - inf is NaN and so unknown.
    friend constexpr interval operator+(interval a, interval b) { return { a.lo + b.lo, a.hi + b.hi }; }
    friend constexpr interval operator-(interval a, interval b) { return { a.lo - b.hi, a.hi - b.lo }; }
    friend constexpr interval operator-(interval a) { return { -a.hi, -a.lo }; }
    friend constexpr interval operator*(interval a, interval b)
    {
        // Products of floats are exact in double: one rounding, to float.
        const auto at = [](float x, float y) { return static_cast<double>(x) * static_cast<double>(y); };
        const detail::corners c(at(a.lo, b.lo), at(a.lo, b.hi), at(a.hi, b.lo), at(a.hi, b.hi));
        return c.defined ? interval(static_cast<float>(c.low), static_cast<float>(c.high)) : unknown();
    }
    friend constexpr interval operator/(interval a, interval b)
    {
        if (b.lo <= 0 && b.hi >= 0) {
            return unknown();
        }
        const auto at = [](float x, float y) { return static_cast<double>(x) / static_cast<double>(y); };
        const detail::corners c(at(a.lo, b.lo), at(a.lo, b.hi), at(a.hi, b.lo), at(a.hi, b.hi));
        if (!c.defined) {
            return unknown();
        }
        const interval quotient(detail::float_from(c.low - detail::slack(c.low, 2.5)),
                                detail::float_up_to(c.high + detail::slack(c.high, 2.5)));
        const bool far = b.lo < -0x1p126F || b.hi > 0x1p126F;
        return far ? hull(quotient, interval(0)) : quotient;
    }
    constexpr interval& operator+=(interval b) { return *this = *this + b; }
    constexpr interval& operator-=(interval b) { return *this = *this - b; }
    constexpr interval& operator*=(interval b) { return *this = *this * b; }
    constexpr interval& operator/=(interval b) { return *this = *this / b; }
};

constexpr bool known(interval a, interval b)
{
    return !a.is_unknown() && !b.is_unknown();
}
constexpr verdict operator<(interval a, interval b)
{
    return known(a, b) ? verdict(a.lo < b.hi, a.hi >= b.lo) : verdict::either();
}
constexpr verdict operator<=(interval a, interval b)
{
    return known(a, b) ? verdict(a.lo <= b.hi, a.hi > b.lo) : verdict::either();
}
constexpr verdict operator>(interval a, interval b)
{
    return b < a;
}
constexpr verdict operator>=(interval a, interval b)
{
    return b <= a;
}
constexpr verdict operator==(interval a, interval b)
{
    const bool apart = a.hi < b.lo || b.hi < a.lo;
    return known(a, b) ? verdict(!apart, !(a.is_point() && b.is_point() && !apart)) : verdict::either();
}
constexpr verdict operator!=(interval a, interval b)
{
    return !(a == b);
}

// Every T from lo to hi, held in 64 bits. Results that wrap are exact for points, else anything.
template <class T>
struct integer_interval {
    std::int64_t lo;
    std::int64_t hi;

    integer_interval() = default;
    template <class S>
        requires std::is_integral_v<S>
    constexpr integer_interval(S x) : lo(static_cast<T>(x)), hi(static_cast<T>(x)) {}
    // Truncates; anything for what does not fit, as conversions of it may give anything.
    constexpr explicit integer_interval(interval x)
    {
        const bool fits = static_cast<double>(x.lo) > static_cast<double>(std::numeric_limits<T>::min()) - 1.0 &&
                          static_cast<double>(x.hi) < static_cast<double>(std::numeric_limits<T>::max()) + 1.0;
        *this = fits ? integer_interval(static_cast<std::int64_t>(x.lo), static_cast<std::int64_t>(x.hi), true) : any();
    }
    static constexpr integer_interval any() { return { std::numeric_limits<T>::min(), std::numeric_limits<T>::max(), true }; }
    static constexpr integer_interval between(std::int64_t low, std::int64_t high) { return { low, high, true }; }
    // Rounds to nearest.
    constexpr explicit operator interval() const { return { static_cast<float>(lo), static_cast<float>(hi) }; }
    constexpr bool is_point() const { return lo == hi; }

    friend constexpr integer_interval operator+(integer_interval a, integer_interval b)
    {
        return wrapped(a.lo + b.lo, a.hi + b.hi);
    }
    friend constexpr integer_interval operator-(integer_interval a, integer_interval b)
    {
        return wrapped(a.lo - b.hi, a.hi - b.lo);
    }
    friend constexpr integer_interval operator-(integer_interval a) { return integer_interval(0) - a; }
    friend constexpr integer_interval operator*(integer_interval a, integer_interval b)
    {
        if (a.is_point() && b.is_point()) {
            return static_cast<T>(static_cast<std::uint64_t>(a.lo) * static_cast<std::uint64_t>(b.lo));
        }
        return any();
    }
    friend constexpr integer_interval operator/(integer_interval a, integer_interval b)
    {
        return a.is_point() && b.is_point() && b.lo != 0 ? integer_interval(static_cast<T>(a.lo / b.lo)) : any();
    }
    // Exact for points; else for masks of low bits, the use there is: exact within one period of the mask.
    friend constexpr integer_interval operator&(integer_interval a, integer_interval b)
    {
        if (a.is_point() && b.is_point()) {
            return static_cast<T>(a.lo & b.lo);
        }
        const bool low_bits = b.is_point() && b.lo >= 0 && (b.lo & (b.lo + 1)) == 0;
        if (!low_bits) {
            return any();
        }
        return (a.lo & ~b.lo) == (a.hi & ~b.lo) ? between(a.lo & b.lo, a.hi & b.lo) : between(0, b.lo);
    }

    friend constexpr verdict operator<(integer_interval a, integer_interval b) { return { a.lo < b.hi, a.hi >= b.lo }; }
    friend constexpr verdict operator<=(integer_interval a, integer_interval b) { return { a.lo <= b.hi, a.hi > b.lo }; }
    friend constexpr verdict operator>(integer_interval a, integer_interval b) { return b < a; }
    friend constexpr verdict operator>=(integer_interval a, integer_interval b) { return b <= a; }

private:
    constexpr integer_interval(std::int64_t low, std::int64_t high, bool) : lo(low), hi(high) {}
    static constexpr integer_interval wrapped(std::int64_t low, std::int64_t high)
    {
        if (low == high) {
            return static_cast<T>(low);
        }
        const bool fits = low >= std::numeric_limits<T>::min() && high <= std::numeric_limits<T>::max();
        return fits ? between(low, high) : any();
    }
};

template <>
struct real_traits<interval> {
    using uint = integer_interval<std::uint32_t>;
    using integer = integer_interval<std::int32_t>;
    using mask = verdict;

    static constexpr interval select(interval a, interval b, verdict m)
    {
        return m.certain() ? (m.may_hold ? b : a) : hull(a, b);
    }
    template <class T>
    static constexpr integer_interval<T> select(integer_interval<T> a, integer_interval<T> b, verdict m)
    {
        if (m.certain()) {
            return m.may_hold ? b : a;
        }
        return integer_interval<T>::between(a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi);
    }
    static constexpr interval sqrt(interval x)
    {
        if (!(x.lo >= 0)) {
            return interval::unknown();
        }
        return { root(x.lo, true), root(x.hi, false) };
    }
    static constexpr interval floor(interval x) { return { detail::floor(x.lo), detail::floor(x.hi) }; }
    static constexpr interval abs(interval x)
    {
        if (x.is_unknown() || x.lo >= 0) {
            return x;
        }
        return x.hi <= 0 ? -x : interval(0.0F, -x.lo > x.hi ? -x.lo : x.hi);
    }
    static constexpr interval min(interval a, interval b)
    {
        return known(a, b) ? interval(a.lo < b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi) : interval::unknown();
    }
    static constexpr interval max(interval a, interval b) { return -min(-a, -b); }

private:
    // The least or greatest result of 1 / inversesqrt(x).
    static constexpr float root(float x, bool least)
    {
        if (x == 0 || x > std::numeric_limits<float>::max()) {
            return x;
        }
        const double inverse = 1 / detail::sqrt(static_cast<double>(x));
        const double root = 1 / (inverse + (least ? 1 : -1) * detail::slack(inverse, 2.0));
        return least ? detail::float_from(root - detail::slack(root, 2.5)) : detail::float_up_to(root + detail::slack(root, 2.5));
    }
};

template <>
struct detail::bits_of<interval, integer_interval<std::int32_t>, integer_interval<std::uint32_t>> {
    using integer = integer_interval<std::int32_t>;

    static constexpr integer exponent(interval x)
    {
        return x.lo > 0 && !x.is_unknown() ? integer::between(of(x.lo), of(x.hi)) : integer::between(-127, 128);
    }
    static constexpr interval power_of_two(integer n)
    {
        using single = bits_of<float, std::int32_t, std::uint32_t>;
        const auto at = [](std::int64_t i) { return single::power_of_two(static_cast<std::int32_t>(i)); };
        return n.lo >= -126 && n.hi <= 127 ? interval(at(n.lo), at(n.hi)) : interval::unknown();
    }
    static constexpr interval real(integer_interval<std::uint32_t> bits)
    {
        return bits.is_point() ? interval(std::bit_cast<float>(static_cast<std::uint32_t>(bits.lo))) : interval::unknown();
    }
    // Falls as x grows.
    static constexpr interval inverse_root_guess(interval x)
    {
        using single = bits_of<float, std::int32_t, std::uint32_t>;
        const bool usable = x.lo >= 0 && !x.is_unknown();
        return usable ? interval(single::inverse_root_guess(x.hi), single::inverse_root_guess(x.lo)) : interval::unknown();
    }

private:
    static constexpr std::int64_t of(float x) { return bits_of<float, std::int32_t, std::uint32_t>::exponent(x); }
};

} // namespace ao
