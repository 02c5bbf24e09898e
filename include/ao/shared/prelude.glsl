// The GLSL side of the shared language: include this first, then the headers of ao/shared.
// The C++ side is ao/detail/scope.inc. See docs/shared-language.md.
#define AO_FN
#define AO_PASS
#define AO_PRECISE precise
#define AO_CONST const
#define real float
#define integer int
#define mask bool
#define ao_exponent(x) (int(floatBitsToUint(x) >> 23 & 255u) - 127)
#define ao_power_of_two(n) uintBitsToFloat(uint((n) + 127) << 23)
#define ao_real_of_bits(n) uintBitsToFloat(n)
#define ao_bits_of_real(x) floatBitsToUint(x)
#define ao_inverse_root_guess(x) uintBitsToFloat(0x5f1ffff9u - (floatBitsToUint(x) >> 1))
#define ao_any(m) (m)
// What stands before the loop over taps: an attribute, where an API's shaders want one.
#ifndef AO_UNROLL
#define AO_UNROLL
#endif
