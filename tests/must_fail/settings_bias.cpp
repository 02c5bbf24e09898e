#include <ao/settings.hpp>

#ifdef AO_MISUSE
ao::settings chosen = ao::checked({ .bias = -0.1F });
#else
ao::settings chosen = ao::checked({ .bias = 0.0F });
#endif
