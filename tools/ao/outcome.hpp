#pragma once

#include "ao/result.hpp"
#include "scene/error.hpp"
#include "scene/signals.hpp"

#include <string>
#include <utility>

namespace ao::tools {

// The value, or `error` with where it was missing and why.
template <class T>
T take(const std::string& where, ao::result<T> result)
{
    if (!result)
        throw error(where + ": " + one_line(std::string(result.error().reason())));
    return std::move(*result);
}

inline void stop_if_interrupted()
{
    if (interrupted())
        throw error("interrupted");
}

} // namespace ao::tools
