// The mathematics is over real types only.
#include <ao/math.hpp>

#ifdef AO_MISUSE
using chosen = ao::math<int>;
#else
using chosen = ao::math<float>;
#endif
chosen::real zero{};
