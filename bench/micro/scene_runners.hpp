// The backends that draw and shade scenes.
#pragma once

#include "host/scene_runner.hpp"
#include "micro/measure.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ao::bench {

inline std::vector<std::string> names_of_scene_runners()
{
    std::vector<std::string> names;
    for (const host::scene_runner_ptr& each : take(host::make_scene_runners("all"))) {
        names.emplace_back(each->backend());
    }
    return names;
}

inline std::shared_ptr<host::scene_runner> scene_runner_of(std::string_view backend)
{
    return std::move(take(host::make_scene_runners(backend)).front());
}

} // namespace ao::bench
