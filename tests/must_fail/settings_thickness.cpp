#include <ao/settings.hpp>

#ifdef AO_MISUSE
ao::settings chosen = ao::checked({ .thickness = 0.0F });
#else
ao::settings chosen = ao::checked({ .thickness = 1.0F });
#endif
