// Every backend, route and width that this build and machine have.
#pragma once

#include "host/runner.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

// Requires the runner; a failure shows the reason.
inline ao::host::runner_ptr require_runner(ao::result<ao::host::runner_ptr> made)
{
    INFO((made ? std::string() : std::string(made.error().reason())));
    REQUIRE(made);
    return std::move(*made);
}

// One of each backend and route: what tests beyond the suite compare.
inline std::vector<ao::host::runner_ptr> usual_runners()
{
    std::vector<ao::host::runner_ptr> runners;
#ifdef AO_HAS_CPU
    runners.push_back(require_runner(ao::host::make_cpu_runner({ .lanes = ao::cpu::width::scalar })));
    runners.push_back(require_runner(ao::host::make_cpu_runner()));
#endif
#ifdef AO_HAS_GL
    runners.push_back(require_runner(ao::host::make_gl_runner({}, { .route = ao::gl::route::compute })));
    runners.push_back(require_runner(ao::host::make_gl_runner({}, { .route = ao::gl::route::fragment })));
#endif
#ifdef AO_HAS_VK
    runners.push_back(require_runner(ao::host::make_vk_runner()));
#endif
    REQUIRE_FALSE(runners.empty());
    return runners;
}
