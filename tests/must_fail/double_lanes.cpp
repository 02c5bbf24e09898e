// Lanes hold 4-byte values: a mask has one width for all of them.
#include <ao/lanes.hpp>

#ifdef AO_MISUSE
ao::lanes<double, 4> value(1.0);
#else
ao::lanes<float, 4> value(1.0F);
#endif
