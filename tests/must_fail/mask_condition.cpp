// No `if` on a mask: lanes may disagree. Shared code selects with mix.
#include <ao/lanes.hpp>

using real = ao::lanes<float, 4>;

real larger(real a, real b)
{
#ifdef AO_MISUSE
    return a < b ? b : a;
#else
    return ao::select(a, b, a < b);
#endif
}
