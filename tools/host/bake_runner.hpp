// What finds visibility per vertex on a backend, with a device of its own.
#pragma once

#include "ao/bake.hpp"
#include "ao/result.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace ao::host {

class bake_runner {
public:
    bake_runner() = default;
    bake_runner(const bake_runner&) = delete;
    bake_runner& operator=(const bake_runner&) = delete;
    virtual ~bake_runner() = default;

    virtual std::string_view backend() const = 0;
    virtual std::string device() const = 0;
    // As every baker's: whole, or its first part where progress ended it.
    virtual ao::result<bake_sums> run(const bake_job& job, const bake_request& request) = 0;
};

using bake_runner_ptr = std::unique_ptr<bake_runner>;

struct bake_runner_options {
    std::string device; // part of a name; empty: the software drivers
    int lanes = 0;      // of the cpu: 0 the widest, 1 scalar, 4, 8, 16
    int threads = 0;    // of the cpu: 0 all
};

#ifdef AO_HAS_CPU
ao::result<bake_runner_ptr> make_cpu_bake_runner(const bake_runner_options& o = {});
#endif
#ifdef AO_HAS_GL
ao::result<bake_runner_ptr> make_gl_bake_runner(const bake_runner_options& o = {});
#endif
#ifdef AO_HAS_VK
ao::result<bake_runner_ptr> make_vk_bake_runner(const bake_runner_options& o = {});
#endif

// cpu, gl or vk. Fails where the program was built without the backend.
ao::result<bake_runner_ptr> make_bake_runner(std::string_view backend, const bake_runner_options& o = {});

} // namespace ao::host
