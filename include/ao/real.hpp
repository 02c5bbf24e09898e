// What math<Real> needs to know of a Real type. Lanes and intervals specialise this in their own headers.
#pragma once

#include "ao/detail/elementary.hpp"

#include <cstdint>

namespace ao {

template <class Real>
struct real_traits;

// Common to float and double: one value, one verdict.
template <class Real>
struct scalar_traits {
    using uint = std::uint32_t;
    using integer = std::int32_t;
    using mask = bool;

    static constexpr Real select(Real a, Real b, bool m) { return m ? b : a; }
    static constexpr integer select(integer a, integer b, bool m) { return m ? b : a; }
    static constexpr uint select(uint a, uint b, bool m) { return m ? b : a; }
    static constexpr Real sqrt(Real x) { return detail::sqrt(x); }
    static constexpr Real floor(Real x) { return detail::floor(x); }
    static constexpr Real abs(Real x) { return x < Real(0) ? -x : x + Real(0); }
    static constexpr Real min(Real a, Real b) { return b < a ? b : a; }
    static constexpr Real max(Real a, Real b) { return a < b ? b : a; }
};

template <>
struct real_traits<float> : scalar_traits<float> {
};

template <>
struct real_traits<double> : scalar_traits<double> {
};

} // namespace ao
