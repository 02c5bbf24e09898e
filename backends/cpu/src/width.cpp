#include "width.hpp"

namespace ao::cpu {

std::string_view name_of(width w)
{
    switch (w) {
    case width::automatic:
        return "automatic";
    case width::scalar:
        return "scalar";
    case width::lanes4:
#if defined(__SSE2__)
        return "4 lanes (SSE2)";
#elif defined(__ARM_NEON)
        return "4 lanes (NEON)";
#else
        return "4 lanes";
#endif
    case width::lanes8:
        return "8 lanes (AVX2)";
    case width::lanes16:
        return "16 lanes (AVX-512)";
    }
    return "unknown width";
}

// The compiler's own detection rather than xsimd 8.1's: that one asks neither for AVX-512 VL nor whether the operating system
// saves the wide registers.
bool is_available(width w)
{
    switch (w) {
    case width::automatic:
    case width::scalar:
    case width::lanes4:
        return true;
#if defined(AO_CPU_X86)
    case width::lanes8: // every processor with AVX2 has F16C
        return __builtin_cpu_supports("avx2") != 0;
    case width::lanes16:
        return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
               __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512vl") != 0;
#endif
    default:
        return false;
    }
}

namespace detail {

width widest()
{
    for (const width w : { width::lanes16, width::lanes8 }) {
        if (is_available(w)) {
            return w;
        }
    }
    return width::lanes4;
}

const kernel_table& kernels_of(width w)
{
    switch (w) {
#if defined(AO_CPU_X86)
    case width::lanes16:
        return lanes16_kernels();
    case width::lanes8:
        return lanes8_kernels();
#endif
    case width::lanes4:
        return lanes4_kernels();
    default:
        return scalar_kernels();
    }
}

} // namespace detail

} // namespace ao::cpu
