// A verdict may be neither yes nor no, so it is no condition.
#include <ao/interval.hpp>

bool less(ao::interval a, ao::interval b)
{
#ifdef AO_MISUSE
    return (a < b) ? true : false;
#else
    return (a < b).certain() && (a < b).may_hold;
#endif
}
