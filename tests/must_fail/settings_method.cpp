#include <ao/settings.hpp>

#ifdef AO_MISUSE
ao::settings chosen = ao::checked({ .method = static_cast<ao::method>(4) });
#else
ao::settings chosen = ao::checked({ .method = ao::method::halton });
#endif
