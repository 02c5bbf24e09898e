// Divisions of work on which no result may depend.
#pragma once

#include "ao/cpu/backend.hpp"

#include <oneapi/tbb/global_control.h>

#include <array>

namespace cpu_test {

// Keeps oneTBB from refusing more threads than the machine has.
inline void allow_threads()
{
    static oneapi::tbb::global_control more(oneapi::tbb::global_control::max_allowed_parallelism, 4);
}

inline std::array<ao::cpu::options, 4> divisions()
{
    allow_threads();
    using ao::cpu::width;
    return { { { width::automatic, 1, 0, 0 },
               { width::automatic, 2, 64, 1 },
               { width::automatic, 3, 7, 5 },
               { width::automatic, 4, 1, 1 } } };
}

} // namespace cpu_test
