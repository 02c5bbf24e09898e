// Radical inverses against exact rationals, in every base (numerics.md H1, H3, H7).
#include "static/support.hpp"

#include <cstdint>

namespace {

using namespace static_test;

// The radical inverse by its definition: digits mirrored about the point, as one fraction of 64-bit integers.
constexpr double exact(std::uint64_t base, std::uint64_t index)
{
    std::uint64_t numerator = 0;
    std::uint64_t denominator = 1;
    for (; index != 0; index /= base) {
        numerator = numerator * base + index % base;
        denominator *= base;
    }
    return static_cast<double>(numerator) / static_cast<double>(denominator);
}
static_assert(exact(2, 1) == 0.5 && exact(2, 6) == 0.375 && exact(10, 1234) == 0.4321);

template <class Real>
struct suite {
    using m = ao::math<Real>;

    static constexpr bool bases_agree()
    {
        constexpr int primes[6] = { 2, 3, 5, 7, 11, 13 };
        for (int dimension = 0; dimension < 6; ++dimension) {
            if (m::ao_halton_base(dimension) != primes[dimension]) {
                return false;
            }
        }
        return true;
    }
    static_assert(bases_agree());

    // The most digits that 32 bits hold, and base^-digits.
    static constexpr bool digits_fit(int base)
    {
        std::uint64_t power = 1;
        for (int i = 0; i < m::ao_halton_digits(base); ++i) {
            power *= static_cast<std::uint64_t>(base);
        }
        return power <= 0xffffffffU && (base == 2 || power * static_cast<std::uint64_t>(base) > 0xffffffffU) &&
               m::ao_halton_scale(base) == Real(1.0 / static_cast<double>(power));
    }
    static_assert(digits_fit(2) && digits_fit(3) && digits_fit(5) && digits_fit(7) && digits_fit(11) && digits_fit(13));

    static constexpr bool accurate(int base)
    {
        // Three roundings: of the reversed digits, of the scale and of the product.
        const double most = 1.5 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        const auto close = [&](std::uint32_t index) {
            const double x = static_cast<double>(m::ao_radical_inverse(base, index));
            return near(x, exact(static_cast<std::uint64_t>(base), index), most) && x >= 0 && x < 1;
        };
        for (std::uint32_t i = 0; i < 40; ++i) {
            if (!close(i)) {
                return false;
            }
        }
        // Multiples of the base and their neighbours: the division must be exact.
        std::uint32_t power = 1;
        for (int i = 0; i < 5; ++i) {
            power *= static_cast<std::uint32_t>(base);
            if (!close(power) || !close(power + 1) || !close(5 * power) || !close(4194303U / power * power)) {
                return false;
            }
        }
        return close(4194303U);
    }
    static_assert(accurate(2));
    static_assert(accurate(3));
    static_assert(accurate(5));
    static_assert(accurate(7));
    static_assert(accurate(11));
    static_assert(accurate(13));

    // All digits maximal: a running float sum would round to 1.
    static constexpr bool below_one(int base)
    {
        std::uint64_t power = 1;
        for (int digits = 1; digits <= m::ao_halton_digits(base); ++digits) {
            power *= static_cast<std::uint64_t>(base);
            const Real x = m::ao_radical_inverse(base, static_cast<std::uint32_t>(power - 1));
            if (!(x < 1) || x < Real(0.49)) {
                return false;
            }
        }
        return m::ao_radical_inverse(base, 0xffffffffU) < 1 && m::ao_radical_inverse(base, 0) == 0;
    }
    static_assert(below_one(2) && below_one(3) && below_one(5) && below_one(7) && below_one(11) && below_one(13));
};

template struct suite<float>;
template struct suite<double>;

} // namespace
