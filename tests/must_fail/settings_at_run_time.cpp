// checked() is for settings known while compiling; validate() is for the others.
#include <ao/settings.hpp>

bool chosen(int taps)
{
    ao::settings s;
    s.taps = taps;
#ifdef AO_MISUSE
    return ao::checked(s).taps == taps;
#else
    return !ao::validate(s);
#endif
}
