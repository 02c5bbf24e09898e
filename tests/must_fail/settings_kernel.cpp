#include <ao/settings.hpp>

#ifdef AO_MISUSE
ao::settings chosen = ao::checked({ .kernel = static_cast<ao::kernel_type>(3) });
#else
ao::settings chosen = ao::checked({ .kernel = ao::kernel_type::halton });
#endif
