#include <ao/settings.hpp>

#ifdef AO_MISUSE
constexpr ao::settings chosen = ao::checked({ .filter = 4 });
#else
constexpr ao::settings chosen = ao::checked({ .filter = 5 });
#endif
static_assert(chosen.taps == 32);
