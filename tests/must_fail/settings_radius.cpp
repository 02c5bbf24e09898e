#include <ao/settings.hpp>

#ifdef AO_MISUSE
ao::settings chosen = ao::checked({ .radius = -1.0F });
#else
ao::settings chosen = ao::checked({ .radius = 1.0F });
#endif
