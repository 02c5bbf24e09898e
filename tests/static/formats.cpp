// Half floats and stored normals as constant expressions.
#include "ao/format.hpp"
#include "ao/half.hpp"
#include "static/support.hpp"

#include <bit>

namespace {

using namespace static_test;

static_assert(ao::half_to_float(0x3c00) == 1.0F && ao::half_to_float(0xc000) == -2.0F && ao::half_to_float(0x7bff) == 65504.0F);
static_assert(ao::half_to_float(0x0001) == 5.9604644775390625e-8F && ao::half_to_float(0x0400) == 6.103515625e-5F);
static_assert(std::bit_cast<std::uint32_t>(ao::half_to_float(0x8000)) == 0x80000000U);
static_assert(ao::half_to_float(0x7c00) == std::numeric_limits<float>::infinity());
static_assert(ao::half_to_float(0x7e00) != ao::half_to_float(0x7e00));

static_assert(ao::float_to_half(1.0F) == 0x3c00 && ao::float_to_half(-0.0F) == 0x8000 && ao::float_to_half(65504.0F) == 0x7bff);
// Ties to even, and the ends of the range.
static_assert(ao::float_to_half(1.00048828125F) == 0x3c00 && ao::float_to_half(1.00146484375F) == 0x3c02);
static_assert(ao::float_to_half(65519.99F) == 0x7bff && ao::float_to_half(65520.0F) == 0x7c00 &&
              ao::float_to_half(1e30F) == 0x7c00);
static_assert(ao::float_to_half(2.98e-8F) == 0x0000 && ao::float_to_half(2.99e-8F) == 0x0001);
static_assert(ao::float_to_half(6.1e-5F) == 0x03ff && ao::float_to_half(6.1032e-5F) == 0x0400);
static_assert(ao::float_to_half(-std::numeric_limits<float>::infinity()) == 0xfc00);
static_assert((ao::float_to_half(std::numeric_limits<float>::quiet_NaN()) & 0x7fffU) > 0x7c00U);

template <class Real>
struct suite {
    using m = ao::math<Real>;
    using vec3 = typename m::vec3;

    static constexpr bool codes_survive(int top)
    {
        for (int i = 0; i < 16; ++i) {
            const int code = top * i / 15;
            if (m::ao_unorm_code(Real(code) / Real(top), Real(top)) != Real(code)) {
                return false;
            }
        }
        return true;
    }
    static_assert(codes_survive(1023) && codes_survive(65535));
    static_assert(m::ao_signed_from_code(Real(0), Real(1023)) == -1 && m::ao_signed_from_code(Real(1023), Real(1023)) == 1);

    static_assert(equal(m::ao_octahedral_direction(0, 0), vec3(0, 0, 1)));
    static_assert(equal(m::ao_octahedral_direction(1, 0), vec3(1, 0, 0)));
    static_assert(equal(m::ao_octahedral_direction(0, -1), vec3(0, -1, 0)));
    static_assert(equal(m::ao_octahedral_direction(1, 1), vec3(0, 0, -1)));
    static_assert(equal(m::ao_octahedral_direction(-1, 1), vec3(0, 0, -1)));
    static_assert(equal(m::ao_octahedral_direction(Real(0.75), Real(-0.75)), vec3(Real(0.25), Real(-0.25), Real(-0.5))));
};

template struct suite<float>;
template struct suite<double>;

static_assert(ao::bytes_per_pixel(ao::pixel_format::rgba32f) == 16 && ao::bytes_per_pixel(ao::pixel_format::rgba16f) == 8);
static_assert(ao::bytes_per_pixel(ao::pixel_format::rg32f) == 8 && ao::bytes_per_pixel(ao::pixel_format::r8) == 1);
static_assert(ao::bytes_per_pixel(ao::pixel_format::d24) == 4 && ao::bytes_per_pixel(ao::pixel_format::rgb10a2) == 4);

} // namespace
