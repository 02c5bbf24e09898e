// Every method of the library; a new one joins here.
#pragma once

#include "ao/settings.hpp"

#include <array>

namespace stability {

inline constexpr std::array methods{ ao::method::box, ao::method::hemisphere, ao::method::halton, ao::method::bitmask };

} // namespace stability
