#include <ao/settings.hpp>

#ifdef AO_MISUSE
ao::settings chosen = ao::checked({ .taps = 0 });
#else
ao::settings chosen = ao::checked({ .taps = 1 });
#endif
