// Half turns for one Real type (ao/shared/half_turn.h).
#pragma once

#include "ao/math.hpp"

#include "ao/detail/shared_begin.inc"

namespace ao {

template <class Real>
struct half_turn {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"
#include "ao/shared/half_turn.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"
