// What `--backend` names, for any kind of runner.
#pragma once

#include "ao/result.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ao::host {

// make(name) -> std::optional<result<Pointer>>: nothing where the program was built without the backend. `all` takes those that
// there are.
template <class Pointer, class Make>
ao::result<std::vector<Pointer>> make_each(std::string_view backend, const Make& make)
{
    std::vector<Pointer> runners;
    bool known = backend == "all";
    for (const std::string_view each : { "cpu", "gl", "vk" }) {
        if (backend != "all" && backend != each) {
            continue;
        }
        known = true;
        auto next = make(each);
        if (!next && backend == "all") {
            continue;
        }
        if (!next) {
            return error(errc::invalid_settings, "this program was built without the backend " + std::string(backend));
        }
        if (!*next) {
            return next->error();
        }
        runners.push_back(std::move(**next));
    }
    if (!known) {
        return error(errc::invalid_settings, "unknown backend \"" + std::string(backend) + "\": cpu, gl, vk or all");
    }
    return runners;
}

} // namespace ao::host
